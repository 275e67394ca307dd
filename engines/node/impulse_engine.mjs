// A scene on an engine of rigid contacts and impulses: what all such engines do alike. An engine brings a world,
//
//     new World({disks, bodies, law, gravity, dt, rotation, number})    throws Unsupported
//         disks   [{position, velocity, spin, radius, mass, inertia}]; of a convex body also {shape: {kind, vertices, rounding},
//                 turn, moments} as in the protocol, where the engine declares shapes
//         bodies  of crossgrain_walls.mjs
//         number  (name) → a setting's value
//     world.placeWalls(states, next)   where each body is now and after the next step
//     world.step()
//     world.disk(i) → {position, velocity, spin}, and turn in a scene with convex bodies
//     world.impulses(visit)            visit(i, j, normal impulse ≥ 0, tangential, place), i < j, of those that are not 0; what
//                                      is tangential is a number along z × normal, or a vector on i in space;
//                                      place() → {normal towards i, point}, and depth in a scene with convex bodies, where each
//                                      point of a pair is visited
//     world.touching()    in its place, where contacts cannot be read: how many there are, if that is known
//     world.pairs, world.deviations, world.gap   what the engine makes of the law; how far apart it lets disks touch
//
// in SI units, ids as the protocol's: disks, or spheres, then wall disks, then planes, then cylinders. Vectors are those of
// crossgrain_vector.mjs.

import {carriedAlong, cross, dot, isZero, minus, noSpin, plus, scaled} from './crossgrain_vector.mjs';
import {Body, facing} from './crossgrain_walls.mjs';
import {Unsupported} from './crossgrain_worker.mjs';
import {RigidLaw} from './rigid_law.mjs';

const EFFECTS = ['normal_damping', 'friction', 'rotation', 'gravity', 'moving_walls'];
const MOTIONS = ['fixed', 'rotating', 'translating', 'oscillating'];

/// A sum over an interval [s].
const mean = (sum, interval) => (Array.isArray(sum) ? sum.map((x) => x / interval) : sum / interval);

export class ImpulseEngine {
  /// @param about  {name, version, integrator, dt: its usual step [s], settings; dimensions: [2] where absent; contacts: false
  ///                where its contacts cannot be read; ofNow: true where they are forces at the places shown, which impulses() has as
  ///                those of a step; shapes, mostVertices, rounded: of convex bodies, if it has them}
  constructor(about, World) {
    this.about = about;
    this.showsContacts = about.contacts ?? true;
    this.World = World;
  }

  capabilities() {
    const {dimensions, shapes, mostVertices, rounded} = this.about;
    return {
      version: this.about.version,
      ...(dimensions && {dimensions, cylinders: true}),
      ...(shapes && {shapes, most_vertices: mostVertices, rounded: rounded ?? false}),
      effects: Object.fromEntries(EFFECTS.map((name) => [name, 'optional'])),
      law_options: {normal: ['rigid'], lever_arm: ['overlap_middle'], velocity_arm: ['lever_arm'], plane_arm: ['middle']},
      wall_motions: MOTIONS,
      plane_motions: MOTIONS,
      precisions: ['float'],
      instant_contacts: this.showsContacts,
      accumulated_contacts: this.showsContacts,
      warm_handover: false,
      sliding_flags: false,
      tangential_restitution: false,
      settings: [{name: 'dt', default: this.about.dt, unit: 's', doc: "time step; 0: the case's", choices: []},
                 ...this.about.settings],
    };
  }

  load(scene, arrays, settings) {
    if (scene.bottom && scene.bottom.mu > 0) throw new Unsupported('has no bottom_friction');
    const defaults = Object.fromEntries(this.capabilities().settings.map((s) => [s.name, s.default]));
    const number = (name) => settings[name] ?? defaults[name];
    this.dt = number('dt') || scene.dt;
    this.disks = scene.disks;
    const dimension = this.dimension = scene.dimension ?? 2;
    this.law = new RigidLaw(scene.law);
    this.friction = this.law.friction > 0;
    const rotation = (this.friction || Boolean(scene.shapes)) && scene.rotation;
    this.bodies = scene.bodies.map((body, b) =>
      new Body(body, arrays[`bodies.${b}.disk_position`], arrays[`bodies.${b}.disk_radius`]));
    this.surfaces = ['planes', 'cylinders'].flatMap(
      (kind) => this.bodies.flatMap((body, b) => body[kind].map((surface) => ({b, surface}))));
    this.owner = [...this.bodies.flatMap((body, b) => Array.from(body.diskRadius, () => b)),
                  ...this.surfaces.map(({b}) => b)];
    this.radius = [...arrays['disks.radius'], ...this.bodies.flatMap((body) => [...body.diskRadius])];
    const vector = (name, i) => [...arrays[name].slice(dimension * i, dimension * (i + 1))];
    const spinOf = dimension === 3 ? (i) => vector('disks.spin', i) : (i) => arrays['disks.spin'][i];
    const disks = Array.from({length: this.disks}, (_, i) => ({
      position: vector('disks.position', i),
      velocity: vector('disks.velocity', i),
      spin: rotation ? spinOf(i) : noSpin(dimension),
      radius: arrays['disks.radius'][i],
      mass: arrays['disks.mass'][i],
      inertia: arrays['disks.inertia'][i],
      ...(scene.shapes && arrays['disks.shape'][i] >= 0 && {
        shape: scene.shapes[arrays['disks.shape'][i]],
        turn: dimension === 3 ? [...arrays['disks.turn'].slice(4 * i, 4 * i + 4)] : arrays['disks.turn'][i],
        moments: dimension === 3 && vector('disks.moments', i),
      }),
    }));
    this.convex = Boolean(scene.shapes);
    this.world?.free();
    this.world = new this.World(
      {disks, bodies: this.bodies, law: this.law, gravity: scene.gravity, dt: this.dt, rotation, number});
    this.steps = this.evaluations = 0;
    this.seconds = this.cpuSeconds = 0;
    this.clearSums();
    const called = {
      normal_damping: scene.law.normal === 'rigid' ? scene.law.en < 1 : scene.law.gn > 0,
      friction: this.friction,
      rotation,
      gravity: !isZero(scene.gravity),
      moving_walls: this.bodies.some((body) => body.moves),
    };
    const {pairs, deviations} = this.world;
    return {
      engine: this.about.name, version: this.about.version, dt: this.dt, precision: 'float',
      integrator: this.about.integrator, velocity_lag: this.dt / 2,
      effects: EFFECTS.filter((name) => called[name]), pairs,
      deviations: [...this.law.deviations(pairs.map((pair) => pair.en)), ...deviations],
    };
  }

  clearSums() {
    this.sums = new Map();  // i · (number of ids) + j → impulses, pressing and along [N s], and the normal that they are of
    this.onBodies = this.noLoads();
    this.summed = 0;
  }

  noLoads() {
    return this.bodies.map(() => ({force: Array(this.dimension).fill(0), torque: noSpin(this.dimension)}));
  }

  advance(t) {
    const began = performance.now(), before = process.cpuUsage();
    for (const target = Math.round(t / this.dt); this.steps < target; ++this.steps) {
      const now = this.bodies.map((body) => body.state(this.steps * this.dt));
      const next = this.bodies.map((body) => body.state((this.steps + 1) * this.dt));
      this.world.placeWalls(now, next);
      this.world.step();
      if (this.showsContacts) this.add(next);
      else this.evaluations += this.world.touching?.() ?? 0;
    }
    this.seconds += (performance.now() - began) / 1e3;
    const {user, system} = process.cpuUsage(before);
    this.cpuSeconds += (user + system) / 1e6;
    return this.steps * this.dt;
  }

  /// Impulses of the last step to the sums.
  add(states) {
    const ids = this.radius.length + this.owner.length;
    this.last = new Map();
    this.lastOnBodies = this.noLoads();
    const space = this.dimension === 3, add = space ? plus : (a, b) => a + b;
    this.world.impulses((i, j, pressing, along, place) => {
      ++this.evaluations;
      if (this.convex) return this.addPoint(states, i, j, pressing, along, place());
      const key = i * ids + j, wall = j >= this.disks;
      const {normal, point} = space || wall ? place() : {};
      for (const list of [this.last, this.sums]) {
        const sum = list.get(key) ?? {i, j, pressing: 0, along: noSpin(this.dimension), normal};
        sum.pressing += pressing;
        sum.along = add(space ? carriedAlong(sum.along, sum.normal, normal) : sum.along, along);
        sum.normal = normal;
        list.set(key, sum);
      }
      if (!wall) return;
      this.loadWall(states, j, point, space ? scaled(-1, plus(scaled(pressing, normal), along))
        : [-(pressing * normal[0] - along * normal[1]), -(pressing * normal[1] + along * normal[0])]);
    });
    ++this.summed;
  }

  /// An impulse on a wall, by its id.
  loadWall(states, j, point, push) {
    const b = this.owner[j - this.disks], turning = cross(minus(point, states[b].centre), push);
    for (const on of [this.lastOnBodies[b], this.onBodies[b]]) {
      on.force = plus(on.force, push);
      on.torque = this.dimension === 3 ? plus(on.torque, turning) : on.torque + turning;
    }
  }

  /// One of the points in which two bodies touch, to the sums of the pair: its impulse [N s], the moment of that about the origin,
  /// and where it acts, weighed with what presses.
  addPoint(states, i, j, pressing, along, {normal, point, depth}) {
    const key = i * (this.radius.length + this.owner.length) + j, weight = pressing || 1e-200;  // of what only rubs, so that it has a place
    const push = plus(scaled(pressing, normal), this.dimension === 3 ? along : scaled(along, [-normal[1], normal[0]]));
    const moment = cross(point, push);
    for (const list of [this.last, this.sums]) {
      const sum = list.get(key);
      list.set(key, sum ? {
        i, j, weight: sum.weight + weight, push: plus(sum.push, push), normal: plus(sum.normal, scaled(weight, normal)),
        at: plus(sum.at, scaled(weight, point)), depth: Math.max(sum.depth, depth),
        moment: this.dimension === 3 ? plus(sum.moment, moment) : sum.moment + moment,
      } : {i, j, weight, push, normal: scaled(weight, normal), at: scaled(weight, point), depth, moment});
    }
    if (j >= this.disks) this.loadWall(states, j, point, scaled(-1, push));
  }

  snapshot(report) {
    const t = this.steps * this.dt, accumulated = report === 'accumulated';
    const states = this.bodies.map((body) => body.state(t));
    const disks = Array.from({length: this.disks}, (_, i) => this.world.disk(i));
    const wallDisks = this.bodies.flatMap((body, b) => body.offset.map((offset) => body.placed(offset, states[b])));
    const arrays = {
      position: ['f64', disks.flatMap((disk) => disk.position)],
      velocity: ['f64', disks.flatMap((disk) => disk.velocity)],
      wall_position: ['f64', wallDisks.flat()],
    };
    if (this.friction || this.convex) arrays.spin = ['f64', disks.flatMap((disk) => disk.spin)];
    if (this.convex) arrays.turn = ['f64', disks.flatMap((disk) => disk.turn)];
    const {ofNow} = this.about;
    const steps = accumulated ? this.summed : ofNow ? 1 : Math.min(this.showsContacts ? 1 : 0, this.steps), interval = steps * this.dt;
    const snapshot = {position_time: t, velocity_time: t, contact_time: t, contact_interval: ofNow ? 0 : interval};
    const onBodies = accumulated ? this.onBodies : this.lastOnBodies;
    snapshot.bodies = states.map(({centre, velocity, angle, spin}, b) => ({
      centre, velocity, angle, angular_velocity: spin,
      ...(steps > 0 && {force: mean(onBodies[b].force, interval), torque: mean(onBodies[b].torque, interval)}),
    }));
    if (steps > 0 && report !== 'none') {
      const positions = [...disks.map((disk) => disk.position), ...wallDisks];
      this.addContacts(arrays, accumulated ? this.sums : this.last, interval, positions, states);
      if (accumulated) this.clearSums();
    }
    return [snapshot, arrays];
  }

  /// Mean forces over an interval, with the geometry of now.
  addContacts(arrays, impulses, interval, positions, states) {
    const list = [...impulses.values()].sort((a, b) => a.i - b.i || a.j - b.j);
    if (this.convex) return this.addSums(arrays, list, interval);
    const geometry = list.map(({i, j}) =>
      j < positions.length ? this.ofDisks(i, j, positions)
                           : this.ofSurface(i, this.surfaces[j - positions.length], positions, states));
    arrays['contacts.i'] = ['i32', list.map((c) => c.i)];
    arrays['contacts.j'] = ['i32', list.map((c) => c.j)];
    arrays['contacts.normal'] = ['f64', geometry.flatMap((g) => g.normal)];
    arrays['contacts.overlap'] = ['f64', geometry.map((g) => g.overlap)];
    arrays['contacts.normal_force'] = ['f64', list.map((c) => c.pressing / interval)];
    const tangential = list.map((c, k) => mean(carriedAlong(c.along, c.normal ?? [0, 0], geometry[k].normal), interval));
    arrays['contacts.tangential_force'] = ['f64', tangential.flat()];
  }

  /// Of pairs that touch in several points: all that pushes, at one of them.
  addSums(arrays, list, interval) {
    const space = this.dimension === 3;
    const each = list.map(({weight, push, normal, at, moment}) => {
      const n = scaled(1 / Math.hypot(...normal), normal), point = scaled(1 / weight, at), pressing = dot(push, n);
      const couple = cross(point, push);
      return {n, point, pressing, along: space ? minus(push, scaled(pressing, n)) : dot(push, [-n[1], n[0]]),
              left: space ? minus(moment, couple) : moment - couple};
    });
    arrays['contacts.i'] = ['i32', list.map((c) => c.i)];
    arrays['contacts.j'] = ['i32', list.map((c) => c.j)];
    arrays['contacts.normal'] = ['f64', each.flatMap((c) => c.n)];
    arrays['contacts.overlap'] = ['f64', list.map(({depth}) => (Number.isFinite(depth) ? depth : 0))];
    arrays['contacts.normal_force'] = ['f64', each.map((c) => c.pressing / interval)];
    arrays['contacts.tangential_force'] = ['f64', each.map((c) => mean(c.along, interval)).flat()];
    arrays['contacts.rolling_torque'] = ['f64', each.map((c) => mean(c.left, interval)).flat()];
    arrays['contacts.point'] = ['f64', each.flatMap((c) => c.point)];
  }

  ofDisks(i, j, positions) {
    const apart = minus(positions[i], positions[j]), distance = Math.hypot(...apart);
    return {normal: apart.map((x) => x / distance), overlap: this.radius[i] + this.radius[j] - distance};
  }

  ofSurface(i, {b, surface}, positions, states) {
    const {normal, distance} = facing(surface, positions[i], this.bodies[b], states[b]);
    return {normal, overlap: this.radius[i] - distance};
  }

  stats() {
    return {steps: this.steps, contact_evaluations: this.evaluations, wall_seconds: this.seconds,
            cpu_seconds: this.cpuSeconds, counters: {}};
  }
}
