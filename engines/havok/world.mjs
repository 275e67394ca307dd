// The scene as bodies of Havok; disks are spheres that keep to a plane. In single precision, and in units in which the smallest disk
// has a radius and a mass of one: Havok's tolerances are made for things of that size, and of 1/m and 1/J it keeps eight binary digits.

import {readFileSync} from 'node:fs';
import {quaternionOf, scaled} from '../node/crossgrain_vector.mjs';
import {ballsOf, placeBalls} from '../node/crossgrain_walls.mjs';

const home = new URL('../node/node_modules/@babylonjs/havok/', import.meta.url);
const {default: makeHavok} = await import(new URL('lib/esm/HavokPhysics_es.js', home));
const H = await makeHavok({wasmBinary: readFileSync(new URL('lib/esm/HavokPhysics.wasm', home))});

const NO_LIMIT = 1e9;    // of speeds; Havok's own are 200 and 100 /s
const NO_TURN = 1e9;     // inertia; with an infinite one, 0, contacts at rest with walls become NaN
const WEIGHTLESS = 1e-9; // in place of no gravity, for which Havok takes restitutions as under 9.81

export const version = `@babylonjs/havok ${JSON.parse(readFileSync(new URL('package.json', home))).version}`;

/// Of a call that answers with a result and a value, or with a result alone.
function done(answer) {
  const [result, value] = Array.isArray(answer) ? answer : [answer];
  if (result !== H.Result.RESULT_OK) throw new Error(`Havok refused a call: ${result.value}`);
  return value;
}

/// A coefficient as Havok keeps it with a contact: eight binary digits, of a number that is larger by 1/256 of itself.
function kept(coefficient) {
  const digit = 2 ** (Math.floor(Math.log2(coefficient)) - 7);
  return coefficient > 0 ? Math.floor(coefficient * (257 / 256) / digit) * digit : 0;
}

export class HavokWorld {
  constructor({disks, bodies, law, gravity, dt, rotation}) {
    this.dimension = gravity.length;
    const smallest = disks.reduce((a, b) => (b.radius < a.radius ? b : a));
    this.unit = smallest.radius;
    this.dt = dt;
    this.friction = law.friction;
    this.world = done(H.HP_World_Create());
    done(H.HP_World_SetIdealStepTime(this.world, dt));
    done(H.HP_World_SetSpeedLimit(this.world, NO_LIMIT, NO_LIMIT));
    const weightless = gravity.every((g) => g === 0);
    done(H.HP_World_SetGravity(this.world, weightless ? [0, -WEIGHTLESS, 0] : this.toUnits(gravity)));
    const masses = [...new Set(disks.map((disk) => disk.mass))], ofEach = law.restitutionOfEach(masses);
    const {DYNAMIC, KINEMATIC, STATIC} = H.MotionType;
    this.owned = [];  // bodies
    const {COLLISION_STARTED, COLLISION_CONTINUED} = H.EventType;
    this.disks = disks.map((disk) => {
      const body = this.ball(disk.radius, ofEach.get(disk.mass), disk.position, DYNAMIC);
      const inertia = rotation ? disk.inertia / disk.mass / this.unit ** 2 : NO_TURN;  // of a mass of one
      done(H.HP_Body_SetMassProperties(body, [[0, 0, 0], disk.mass / smallest.mass, Array(3).fill(inertia), [0, 0, 0, 1]]));
      if (weightless) done(H.HP_Body_SetGravityFactor(body, 0));
      done(H.HP_Body_SetEventMask(body, COLLISION_STARTED.value | COLLISION_CONTINUED.value));
      done(H.HP_Body_SetLinearVelocity(body, this.toUnits(disk.velocity)));
      done(H.HP_Body_SetAngularVelocity(body, this.dimension === 3 ? disk.spin : [0, 0, disk.spin]));
      return body;
    });
    const ofWalls = ofEach.get(Infinity);
    const wallDisks = bodies.flatMap((body, b) => body.offset.map((offset, k) => {
      const radius = body.diskRadius[k], at = body.placed(offset, body.state(0));
      return {b, body, offset, own: this.ball(radius, ofWalls, at, body.moves ? KINEMATIC : STATIC)};
    }));
    this.moving = wallDisks.filter(({body}) => body.moves);
    this.balls = ballsOf(bodies, disks, ({planes, cylinders}) => [...planes, ...cylinders])
                   .map((ball) => ({...ball, own: this.ball(ball.radius, ofWalls, ball.surface.point, KINEMATIC)}));
    const mean = (a, b) => kept((ofEach.get(a) + ofEach.get(b)) / 2);
    this.pairs = law.pairs(masses, bodies.length > 0, mean, kept(law.friction));
    this.deviations = [{
      name: 'rounding', value: 1 / 256, unit: '-',
      note: 'restitution, friction, 1/m and 1/J have eight binary digits, the smallest disk m and J exactly',
    }];
  }

  free() {
    for (const body of this.owned) {
      const shape = done(H.HP_Body_GetShape(body));
      done(H.HP_World_RemoveBody(this.world, body));
      done(H.HP_Body_Release(body));
      done(H.HP_Shape_Release(shape));
    }
    done(H.HP_World_Release(this.world));
  }

  toUnits([x, y, z = 0]) { return [x / this.unit, y / this.unit, z / this.unit]; }

  /// Speeds are set afterwards: a body that is in no world yet has Havok's own limits.
  ball(radius, restitution, at, motion) {
    const {MAXIMUM, ARITHMETIC_MEAN} = H.MaterialCombine;
    const shape = done(H.HP_Shape_CreateSphere([0, 0, 0], radius / this.unit)), body = done(H.HP_Body_Create());
    done(H.HP_Shape_SetMaterial(shape, [this.friction, this.friction, restitution, MAXIMUM, ARITHMETIC_MEAN]));
    done(H.HP_Body_SetShape(body, shape));
    done(H.HP_Body_SetMotionType(body, motion));
    done(H.HP_Body_SetLinearDamping(body, 0));
    done(H.HP_Body_SetAngularDamping(body, 0));
    done(H.HP_Body_SetPosition(body, this.toUnits(at)));
    done(H.HP_Body_SetActivationControl(body, H.ActivationControl.ALWAYS_ACTIVE));
    done(H.HP_World_AddBody(this.world, body, false));
    this.owned.push(body);
    return body;
  }

  placeWalls(now, next) {
    for (const {b, body, offset, own} of this.moving)
      done(H.HP_Body_SetTargetQTransform(own, [this.toUnits(body.placed(offset, next[b])), quaternionOf(next[b].angle)]));
    placeBalls(this.balls, (sphere) => this.disk(sphere).position, now, ({own}, _, centre, velocity) => {
      done(H.HP_Body_SetPosition(own, this.toUnits(centre)));
      done(H.HP_Body_SetLinearVelocity(own, this.toUnits(velocity)));
    });
  }

  /// Where there is no event the first call fails, with 0.
  touching() {
    let count = 0, event = H.HP_World_GetCollisionEvents(this.world)[1];
    for (; event; event = H.HP_World_GetNextCollisionEvent(Number(this.world), event)) ++count;
    return count;
  }

  step() { done(H.HP_World_Step(this.world, this.dt)); }

  disk(i) {
    const metres = (vector) => scaled(this.unit, vector.slice(0, this.dimension));
    const position = done(H.HP_Body_GetPosition(this.disks[i])), spin = done(H.HP_Body_GetAngularVelocity(this.disks[i]));
    // Nothing holds it there but that nothing pushes it: the least that did would let dense disks buckle out of the plane.
    if (this.dimension === 2 && position[2] !== 0) throw new Error(`disk ${i} left the plane`);
    return {
      position: metres(position),
      velocity: metres(done(H.HP_Body_GetLinearVelocity(this.disks[i]))),
      spin: this.dimension === 3 ? spin : spin[2],
    };
  }
}
