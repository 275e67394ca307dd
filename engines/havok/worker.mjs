// A worker of crossgrain that runs scenes on Havok Physics:  node worker.mjs
//
// README.md of this folder says what Havok makes of a scene.

import {serve} from '../node/crossgrain_worker.mjs';
import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {HavokWorld, version} from './world.mjs';

serve(new ImpulseEngine({
  name: 'havok',
  version,
  dimensions: [2, 3],
  contacts: false,
  shapes: ['polygon', 'capsule', 'box', 'cylinder', 'polyhedron'],
  mostVertices: 64,
  integrator: 'semi_implicit_euler with sequential impulses',
  dt: 5e-4,
  settings: [],
}, HavokWorld));
