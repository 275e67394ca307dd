// A worker of crossgrain that runs scenes on Jolt Physics:  node worker.mjs
//
// README.md of this folder says what Jolt makes of a scene. JOLT in the environment is another version's package.

import {serve} from '../node/crossgrain_worker.mjs';
import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {JoltWorld, version} from './world.mjs';

const share = {unit: '-', choices: []};
serve(new ImpulseEngine({
  name: 'jolt',
  version,
  dimensions: [2, 3],
  shapes: ['polygon', 'capsule', 'box', 'cylinder', 'polyhedron'],
  mostVertices: 128,
  integrator: 'semi_implicit_euler with sequential impulses',
  dt: 5e-4,
  settings: [
    {name: 'velocity_iterations', default: 10, ...share, doc: 'of the impulse solver', least: 2, most: 1e6, whole: true, role: 'iterations'},
    {name: 'position_iterations', default: 2, ...share, doc: 'of what pushes overlaps apart', least: 0, most: 1e6, whole: true, role: 'iterations'},
    {name: 'baumgarte', default: 0.2, ...share, doc: 'share of an overlap that is pushed apart in an iteration', least: 0, most: 1},
    {name: 'slop', default: 1e-3, ...share, doc: 'overlap that is left standing, in smallest radii', least: 0, most: 1},
    {name: 'speculative_distance', default: 0, ...share, doc: 'gap up to which contacts act, in smallest radii', least: 0, most: 1},
  ],
}, JoltWorld));
