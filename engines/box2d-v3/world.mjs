// The scene as bodies and shapes of Box2D 3: in single precision, and in a unit of length that suits Box2D's
// constants, in which the smallest disk has a radius of about five, as for Box2D 2 (engines/box2d).

import {readFileSync} from 'node:fs';
import {unitOf} from '../node/crossgrain_vector.mjs';
import {Unsupported} from '../node/crossgrain_worker.mjs';

const home = new URL('../node/node_modules/box2d3-wasm/', import.meta.url);
const {default: Box2D} = await import(new URL('build/dist/es/compat/Box2D.compat.mjs', home));
const b2 = await Box2D();
const MOST_CONTACTS = 64;    // of one disk at a time
const THICKNESS = 20;        // of planes, in units: what lies behind one comes out in front of it
const FAR = 1e4;             // half a plane's length, in units: it follows the disks
const NEAR = 256;            // the same where there are convex bodies: their corners are clipped to its far ends, in single precision
const CHECK_EVERY = 32;      // steps between two checks of where they are: in these they go less than half of that

export const version = `box2d3-wasm ${JSON.parse(readFileSync(new URL('package.json', home))).version}`;

/// Deletes an object of the binding after use: it is not garbage-collected.
function once(object, use) {
  const result = use(object);
  object.delete();
  return result;
}
const xy = (vector) => once(vector, ({x, y}) => [x, y]);

export class Box2dWorld {
  constructor({disks, bodies, law, gravity, dt, rotation, number}) {
    this.unit = unitOf(disks, 5);
    this.dt = dt;
    this.count = disks.length;
    this.convex = disks.some(({shape}) => shape);
    this.kinds = [...new Set(disks.map((disk) => disk.mass))];  // the walls are one kind more
    this.idOf = new Map();                                      // shape's index → id
    this.makeWorld(gravity, law, number);
    this.disks = disks.map((disk) => this.disk_(disk, rotation));
    this.walls = bodies.map((body) => this.body(body.moves ? 'b2_kinematicBody' : 'b2_staticBody', body.start));
    this.moving = bodies.map((body) => body.moves);
    bodies.forEach((body, b) => body.offset.forEach((at, k) => this.circle(this.walls[b], at, body.diskRadius[k], this.kinds.length)));
    this.planes = bodies.flatMap((body, b) => body.planes.map((plane) => this.plane(b, body.fromCentre(plane.point), plane.normal)));
    this.steps = 0;
    this.pairs = law.pairs(this.kinds, bodies.length > 0);
    this.deviations = [{name: 'slop', value: 0.005 * this.unit, unit: 'm', note: 'largest overlap that is left standing'}];
  }

  free() { b2.b2DestroyWorld(this.world); }

  /// Box2D's own sine and cosine are off by 1e-4: a slanting plane is so much steeper.
  turnOf(angle) {
    return Object.assign(b2.b2MakeRot(angle), this.convex && {c: Math.cos(angle), s: Math.sin(angle)});
  }

  toUnits(metres) { return new b2.b2Vec2(metres[0] / this.unit, metres[1] / this.unit); }

  makeWorld(gravity, law, number) {
    const how = b2.b2DefaultWorldDef();
    how.gravity = this.toUnits(gravity);
    how.enableSleep = how.enableContinuous = false;
    how.maximumLinearSpeed = 1e6;  // its usual limit is 0.3 m/s here
    // Slower impacts do not rebound: with 0 a column of disks under gravity never comes to rest.
    how.restitutionThreshold = 2 * this.dt * Math.hypot(...gravity) / this.unit;
    how.contactHertz = number('contact_hertz');
    how.contactDampingRatio = number('contact_damping');
    this.world = b2.b2CreateWorld(how);
    how.delete();
    const mass = (kind) => this.kinds[Number(kind)] ?? Infinity;
    b2.b2World_SetRestitutionCallback(this.world, (_, a, __, b) => law.restitution(mass(a), mass(b)));
    b2.b2World_SetFrictionCallback(this.world, () => law.friction);
  }

  body(type, at, disk) {
    const how = b2.b2DefaultBodyDef();
    how.type = b2.b2BodyType[type];
    how.position = this.toUnits(at);
    how.enableSleep = false;
    how.allowFastRotation = true;
    if (disk) {
      how.linearVelocity = this.toUnits(disk.velocity);
      how.angularVelocity = disk.spin;
      if (disk.shape) how.rotation = this.turnOf(disk.turn);
      if (disk.locked) how.motionLocks = Object.assign(how.motionLocks, {angularZ: true});
    }
    return once(how, () => b2.b2CreateBody(this.world, how));
  }

  disk_(disk, rotation) {
    const body = this.body('b2_dynamicBody', disk.position, {...disk, locked: !rotation});
    const kind = this.kinds.indexOf(disk.mass);
    if (disk.shape) this.polygon(body, disk.shape, kind);
    else this.circle(body, [0, 0], disk.radius, kind);
    const data = new b2.b2MassData();
    data.mass = disk.mass;
    data.rotationalInertia = disk.inertia / this.unit ** 2;
    data.center = new b2.b2Vec2(0, 0);
    b2.b2Body_SetMassData(body, data);
    data.delete();
    return body;
  }

  shape(kind, make) {
    const how = b2.b2DefaultShapeDef();
    how.updateBodyMass = false;
    how.material.userMaterialId = BigInt(kind);
    const id = once(how, () => make(how));
    this.idOf.set(id.index1, this.idOf.size);
    return id;
  }

  circle(body, at, radius, kind) {
    const circle = new b2.b2Circle();
    circle.center = this.toUnits(at);
    circle.radius = radius / this.unit;
    this.shape(kind, (how) => b2.b2CreateCircleShape(body, how, circle));
    circle.delete();
  }

  polygon(body, {kind, vertices, rounding}, material) {
    const radius = rounding / this.unit, corners = vertices.map((vertex) => this.toUnits(vertex));
    if (kind === 'capsule') {
      const capsule = Object.assign(new b2.b2Capsule(), {center1: corners[0], center2: corners[1], radius});
      return once(capsule, () => this.shape(material, (how) => b2.b2CreateCapsuleShape(body, how, capsule)));
    }
    once(b2.b2ComputeHull(corners), (hull) => {
      if (hull.count !== vertices.length) throw new Unsupported('has no polygons with corners as near, or sides as straight, as in the scene');
      once(b2.b2MakePolygon(hull, radius), (polygon) => this.shape(material, (how) => b2.b2CreatePolygonShape(body, how, polygon)));
    });
  }

  plane(b, at, normal) {
    const plane = {b, at, normal, middle: 0, half: (this.convex ? NEAR : FAR) * this.unit};
    plane.shape = this.shape(this.kinds.length, (how) => b2.b2CreatePolygonShape(this.walls[b], how, this.box(plane)));
    return plane;
  }

  box({at, normal, middle, half}) {
    const deep = THICKNESS * this.unit;
    const centre = [0, 1].map((k) => at[k] - deep * normal[k] + middle * (k ? -normal[0] : normal[1]));
    return b2.b2MakeOffsetBox(half / this.unit, THICKNESS, this.toUnits(centre), this.turnOf(Math.atan2(-normal[0], normal[1])));
  }

  /// Planes are infinite: each reaches as far as the disks which could touch it, whatever the way that they or the wall go.
  coverPlanes(states) {
    if (this.planes.length === 0 || this.steps++ % CHECK_EVERY) return;
    const places = this.disks.map((_, i) => this.disk(i).position);
    for (const plane of this.planes) {
      const {at, normal: [nx, ny]} = plane, {centre, angle} = states[plane.b];
      const c = Math.cos(angle), s = Math.sin(angle);
      let low = Infinity, high = -Infinity;
      places.forEach(([px, py], i) => {
        const dx = px - centre[0], dy = py - centre[1];
        const x = c * dx + s * dy - at[0], y = c * dy - s * dx - at[1], along = x * ny - y * nx;
        if (x * nx + y * ny > 0.25 * plane.half) return;
        low = Math.min(low, along);
        high = Math.max(high, along);
      });
      if (!(Math.max(high - plane.middle, plane.middle - low) > 0.5 * plane.half)) continue;
      plane.middle = (low + high) / 2;
      plane.half = Math.max(plane.half, 2 * (high - low));
      b2.b2Shape_SetPolygon(plane.shape, this.box(plane));
    }
  }

  placeWalls(now, next) {
    this.coverPlanes(now);
    this.walls.forEach((wall, b) => {
      if (!this.moving[b]) return;
      const target = new b2.b2Transform();
      target.p = this.toUnits(next[b].centre);
      target.q = this.turnOf(next[b].angle);
      b2.b2Body_SetTargetTransform(wall, target, this.dt);
      target.delete();
    });
  }

  /// One substep: of tangential impulses Box2D reports those of its last one alone.
  step() { b2.b2World_Step(this.world, this.dt, 1); }

  disk(i) {
    const metres = (vector) => xy(vector).map((x) => x * this.unit);
    return {
      turn: once(b2.b2Body_GetRotation(this.disks[i]), ({c, s}) => Math.atan2(s, c)),
      position: metres(b2.b2Body_GetPosition(this.disks[i])),
      velocity: metres(b2.b2Body_GetLinearVelocity(this.disks[i])),
      spin: b2.b2Body_GetAngularVelocity(this.disks[i]),
    };
  }

  /// Of the last step. Box2D's normals point from A to B, its tangents along −z × normal.
  impulses(visit) {
    for (let n = 0; n < this.count; ++n)
      for (const data of b2.b2Body_GetContactData(this.disks[n], MOST_CONTACTS)) {
        const a = this.idOf.get(data.shapeIdA.index1), b = this.idOf.get(data.shapeIdB.index1);
        if (Math.min(a, b) === n)
          once(data.manifold, (manifold) => {
            const away = a < b ? -1 : 1;
            for (let k = 0; k < manifold.pointCount; ++k)
              once(manifold.GetPoint(k), (at) => {
                const depth = -at.separation * this.unit;
                const pressing = at.normalImpulse * this.unit, along = -at.tangentImpulse * this.unit;
                if (pressing === 0 && along === 0) return;
                visit(n, Math.max(a, b), pressing, along, () => ({
                  normal: xy(manifold.normal).map((x) => away * x),
                  point: xy(at.point).map((x) => x * this.unit),
                  depth,
                }));
              });
          });
        data.delete();
      }
  }
}
