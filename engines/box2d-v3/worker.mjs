// A worker of crossgrain that runs scenes on Box2D 3:  node worker.mjs
//
// README.md of this folder says what Box2D makes of a scene.

import {serve} from '../node/crossgrain_worker.mjs';
import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {Box2dWorld, version} from './world.mjs';

serve(new ImpulseEngine({
  name: 'box2d-v3',
  version,
  shapes: ['polygon', 'capsule'],
  mostVertices: 8,
  rounded: true,
  integrator: 'semi_implicit_euler with sequential impulses',
  dt: 1.25e-4,
  settings: [
    {name: 'contact_hertz', default: 30, unit: '1/s', doc: 'stiffness of what pushes overlaps apart', choices: [], least: 0, most: 1e6},
    {name: 'contact_damping', default: 10, unit: '-', doc: 'its damping ratio', choices: [], least: 0, most: 1e6},
  ],
}, Box2dWorld));
