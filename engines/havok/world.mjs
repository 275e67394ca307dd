// The scene as bodies of Havok; disks are spheres that keep to a plane. In single precision, and in units in which the smallest disk
// has a radius and a mass of one: Havok's tolerances are made for things of that size, and of 1/m and 1/J it keeps eight binary digits.

import {readFileSync} from 'node:fs';
import {dot, halfSidesOf, minus, plus, prismOf, quaternionOf, quaternionOfTurn, scaled, turned, turnOf} from '../node/crossgrain_vector.mjs';
import {ballsOf, placeBalls} from '../node/crossgrain_walls.mjs';

const home = new URL('../node/node_modules/@babylonjs/havok/', import.meta.url);
const {default: makeHavok} = await import(new URL('lib/esm/HavokPhysics_es.js', home));
const H = await makeHavok({wasmBinary: readFileSync(new URL('lib/esm/HavokPhysics.wasm', home))});

const NO_LIMIT = 1e9;    // of speeds; Havok's own are 200 and 100 /s
const NO_TURN = 1e9;     // inertia; with an infinite one, 0, contacts at rest with walls become NaN
const CONVEX = 16;       // radius of the smallest body where there are convex ones: Havok rounds their edges by 0.015
const FLOOR = 1024;      // half the sides of the boxes that are planes to them, at least: in single precision stacks fall on one of 16384
const CHECK_EVERY = 32;  // steps between two checks of where they are
const ASIDE = 1e-3;      // at most of a convex body from the plane, in units: faces that touch press along the plane to some 1e-9
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
    const convex = disks.some(({shape}) => shape);
    this.unit = smallest.radius / (convex ? CONVEX : 1);
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
      const body = this.body(this.shapeOf(disk), ofEach.get(disk.mass), disk.position, DYNAMIC);
      if (disk.shape) done(H.HP_Body_SetOrientation(body, quaternionOfTurn(disk.turn)));
      const inertia = this.momentsOf(disk).map((j) => (rotation ? j / disk.mass / this.unit ** 2 : NO_TURN));  // of a mass of one
      done(H.HP_Body_SetMassProperties(body, [[0, 0, 0], disk.mass / smallest.mass, inertia, [0, 0, 0, 1]]));
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
    this.aside = convex ? ASIDE : 0;
    this.floors = (convex ? bodies : []).flatMap((body, b) => body.planes.map((plane) => this.floor(b, body, plane, ofWalls)));
    this.steps = 0;
    this.moving = [...wallDisks, ...this.floors].filter(({body}) => body.moves);
    this.balls = ballsOf(bodies, disks, ({planes, cylinders}) => (convex ? cylinders : [...planes, ...cylinders]))
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

  /// In the plane that of a polygon keeps it from turning out of it.
  momentsOf({shape, moments, inertia}) { return moments || (shape ? [NO_TURN, NO_TURN, inertia] : Array(3).fill(inertia)); }

  /// Polygons are prisms, whose thickness is no matter, as nothing pushes out of the plane.
  shapeOf({shape, radius}) {
    if (!shape) return this.sphere(radius);
    const {kind, vertices, rounding} = shape, half = halfSidesOf(shape), ends = vertices.map((vertex) => this.toUnits(vertex));
    if (kind === 'capsule') return done(H.HP_Shape_CreateCapsule(...ends, rounding / this.unit));
    if (kind === 'cylinder') return done(H.HP_Shape_CreateCylinder(...ends, rounding / this.unit));
    if (half) return done(H.HP_Shape_CreateBox([0, 0, 0], [0, 0, 0, 1], scaled(2, this.toUnits([half[0], half[1], half[2] ?? radius]))));
    const corners = prismOf(vertices, radius).flatMap((corner) => this.toUnits(corner)), at = H._malloc(4 * corners.length);
    new Float32Array(H.HEAPU8.buffer, at, corners.length).set(corners);
    const own = H.HP_Shape_CreateConvexHull(at, corners.length / 3);
    H._free(at);
    return done(own);
  }

  /// A plane as convex bodies meet it: a box behind it, which follows them, whatever the way that they or the wall go.
  floor(b, body, {point, normal}, restitution) {
    const at = body.fromCentre(point), floor = {b, body, at, normal, middle: at, half: FLOOR};
    floor.offset = this.behind(floor);
    const motion = body.moves ? H.MotionType.KINEMATIC : H.MotionType.STATIC;
    floor.own = this.body(this.boxBehind(floor), restitution, body.placed(floor.offset, body.state(0)), motion);
    floor.material = done(H.HP_Shape_GetMaterial(done(H.HP_Body_GetShape(floor.own))));
    return floor;
  }

  behind({middle, normal, half}) { return minus(middle, scaled(half * this.unit, normal)); }

  /// Turned so that its z axis is the normal: of all such turns that by the smallest angle, which along an axis has exact components.
  boxBehind({normal: [x, y, z = 0], half}) {
    const turn = z > -0.5 ? [-y, x, 0, 1 + z] : [1 - z, 0, x, y];
    return done(H.HP_Shape_CreateBox([0, 0, 0], scaled(1 / Math.hypot(...turn), turn), Array(3).fill(2 * half)));
  }

  coverFloors(states) {
    if (this.floors.length === 0 || this.steps++ % CHECK_EVERY) return;
    const places = this.disks.map((_, i) => this.disk(i).position);
    for (const floor of this.floors) {
      const {at, normal, own} = floor, {centre, angle} = states[floor.b];
      const along = places.map((place) => {
        const apart = minus(turned(scaled(-1, angle), minus(place, centre)), at);
        return plus(at, minus(apart, scaled(dot(apart, normal), normal)));
      });
      const bound = (f) => at.map((_, k) => along.reduce((most, place) => f(most, place[k]), along[0][k]));
      const low = bound(Math.min), high = bound(Math.max), middle = scaled(0.5, plus(low, high)), spread = Math.hypot(...minus(high, low)) / this.unit;
      if (Math.hypot(...minus(middle, floor.middle)) / this.unit + spread / 2 < floor.half / 2) continue;
      if (2 * spread > floor.half) {
        const old = done(H.HP_Body_GetShape(own));
        floor.half = 4 * spread;
        const grown = this.boxBehind(floor);
        done(H.HP_Shape_SetMaterial(grown, floor.material));
        done(H.HP_Body_SetShape(own, grown));
        done(H.HP_Shape_Release(old));
      }
      floor.middle = middle;
      floor.offset = this.behind(floor);
      done(H.HP_Body_SetPosition(own, this.toUnits(floor.body.placed(floor.offset, states[floor.b]))));
    }
  }

  sphere(radius) { return done(H.HP_Shape_CreateSphere([0, 0, 0], radius / this.unit)); }
  ball(radius, restitution, at, motion) { return this.body(this.sphere(radius), restitution, at, motion); }

  /// Speeds are set afterwards: a body that is in no world yet has Havok's own limits.
  body(shape, restitution, at, motion) {
    const {MAXIMUM, ARITHMETIC_MEAN} = H.MaterialCombine, body = done(H.HP_Body_Create());
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
    this.coverFloors(now);
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
    if (this.dimension === 2 && Math.abs(position[2]) > this.aside) throw new Error(`disk ${i} left the plane`);
    return {
      turn: turnOf(this.dimension, done(H.HP_Body_GetOrientation(this.disks[i]))),
      position: metres(position),
      velocity: metres(done(H.HP_Body_GetLinearVelocity(this.disks[i]))),
      spin: this.dimension === 3 ? spin : spin[2],
    };
  }
}
