// A worker of crossgrain that runs scenes on MuJoCo 3:  node worker.mjs
//
// README.md of this folder says what MuJoCo makes of a scene; worker.cpp is the same for MuJoCo 2.2.

import {Unsupported, serve} from '../node/crossgrain_worker.mjs';
import {ImpulseEngine} from '../node/impulse_engine.mjs';
import {MujocoWorld, version} from './world.mjs';

const setting = (name, value, doc, more) => ({name, default: value, unit: '-', doc, choices: [], ...more});

/// Forces of the linear law in place of impulses; walls, ids and several points of a pair are as for these.
class MujocoEngine extends ImpulseEngine {
  capabilities() {
    const can = super.capabilities();
    return {
      ...can,
      effects: {...can.effects, tangential_damping: 'optional'},
      law_options: {
        normal: ['linear'], damper: ['constant'], tangential: ['none', 'viscous'], tension: ['cut'], coulomb_bound: ['compression'],
        lever_arm: ['overlap_middle'], velocity_arm: ['lever_arm'], plane_arm: ['middle'],
        damping_velocity: ['lagged'], integrator: ['semi_implicit_euler'],
      },
      plane_motions: ['fixed'],
      precisions: ['double'],
      accumulated_contacts: false,
      settings: this.about.settings,
    };
  }

  load(scene, arrays, settings) {
    const {normal, tangential, mu, gn, gt} = scene.law;
    if (normal !== 'linear') throw new Unsupported('has only normal = linear');
    if (tangential !== 'none' && mu > 0 && !(gt > 0 && gn > 0))
      throw new Unsupported('has friction that brakes with gt, by a ratio to gn: both must be > 0');
    if (scene.shapes && !scene.rotation) throw new Unsupported('has convex bodies that turn');
    const loaded = super.load(scene, arrays, settings);
    return {...loaded, precision: 'double', effects: [...loaded.effects, ...(this.friction ? ['tangential_damping'] : [])],
            deviations: this.world.deviations};
  }

  add() { this.evaluations += this.world.touching(); }

  snapshot(report) {
    const {evaluations} = this;
    super.add(this.bodies.map((body) => body.state(this.steps * this.dt)));
    this.evaluations = evaluations;
    return super.snapshot(report);
  }

  stats() { return {...super.stats(), counters: {solver_iterations: this.world?.iterations ?? 0}}; }
}

serve(new MujocoEngine({
  name: 'mujoco3',
  version,
  ofNow: true,
  shapes: ['polygon', 'capsule'],
  mostVertices: 1000,
  integrator: 'semi_implicit_euler',
  settings: [
    setting('impedance', 1e-4, 'd of its contacts: 1e-4 springs that know nothing of each other, 0.9999 constraints',
            {least: 1e-4, most: 0.9999}),
    setting('solver', 'CG', 'CG or Newton', {choices: ['CG', 'Newton']}),
    setting('iterations', 100, 'most of its solver in a step', {least: 1, most: 1e6, whole: true, role: 'iterations'}),
    setting('tolerance', 1e-14, 'of its solver', {least: 0, most: 1}),
  ],
}, MujocoWorld));
