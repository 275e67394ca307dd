// A worker of crossgrain that runs scenes on Rapier:  node worker.mjs
//
// README.md of this folder says what Rapier makes of a scene. RAPIER in the environment is another version's package, or that of
// three dimensions.

import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {serve} from '../node/crossgrain_worker.mjs';
import {inSpace, RapierWorld, version} from './world.mjs';

serve(new ImpulseEngine({
  name: inSpace ? 'rapier3d' : 'rapier',
  version,
  ...(inSpace && {dimensions: [3], contacts: false}),
  shapes: inSpace ? ['capsule', 'box', 'cylinder', 'polyhedron'] : ['polygon', 'capsule'],
  mostVertices: 1000,
  rounded: !inSpace,
  integrator: 'semi_implicit_euler with sequential impulses',
  dt: 5e-4,
  settings: [
    {name: 'iterations', default: 4, unit: '-', doc: 'of the solver, each a part of the step', choices: [], least: 1, most: 1e6, whole: true, role: 'iterations'},
    {name: 'natural_frequency', default: 30, unit: '1/s', doc: 'of what pushes overlaps apart', choices: [], least: 0, most: 1e6},
  ],
}, RapierWorld));
