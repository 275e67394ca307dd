// A worker of crossgrain that runs scenes on PhysX:  node worker.mjs
//
// README.md of this folder says what PhysX makes of a scene.

import {serve} from '../node/crossgrain_worker.mjs';
import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {PhysxWorld, version} from './world.mjs';

const iterations = {unit: '-', choices: [], least: 1, most: 255, whole: true, role: 'iterations'};
serve(new ImpulseEngine({
  name: 'physx',
  version,
  dimensions: [2, 3],
  shapes: ['polygon', 'capsule', 'box', 'polyhedron'],
  mostVertices: 64,
  integrator: 'semi_implicit_euler with sequential impulses',
  dt: 5e-4,
  settings: [
    {name: 'solver', default: 'pgs', unit: '', choices: ['pgs', 'tgs'],
     doc: 'pgs is exact of two bodies but for friction in space, by two axes each for itself; tgs has one friction, and takes part of e_n'},
    {name: 'position_iterations', default: 10, ...iterations, doc: 'of the impulse solver, with what pushes overlaps apart; of tgs, parts of a step'},
    {name: 'velocity_iterations', default: 1, ...iterations, doc: 'after them, without it'},
    {name: 'correcting_speed', default: 0, unit: 'm/s', choices: [], least: 0, most: 1e6, doc: 'at most of what pushes overlaps apart; 0: no limit'},
  ],
}, PhysxWorld));
