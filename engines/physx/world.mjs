// The scene as actors of PhysX; disks keep to a plane. In single precision, and in a unit of length in which the smallest disk has a
// radius of about one.

import {readFileSync} from 'node:fs';
import {dot, halfSidesOf, prismOf, quaternionOf, quaternionOfTurn, scaled, turnOf, unitOf} from '../node/crossgrain_vector.mjs';
import {ballsOf, placeBalls} from '../node/crossgrain_walls.mjs';

const home = new URL('../node/node_modules/physx-js-webidl/', import.meta.url);
const P = await outsideNode(async () => {
  const {default: makePhysx} = await import(new URL('physx-js-webidl.mjs', home));
  return makePhysx({wasmBinary: readFileSync(new URL('physx-js-webidl.wasm', home))});
});

const CONTACT_OFFSET = 1e-6;  // of each body, units: contacts act from a gap of twice that on; PhysX wants more than 0
const NO_LIMIT = 1e9;         // of speeds; PhysX' own of spins is 100 /s
const GYROSCOPIC = 1 << 10;   // PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, Euler's term: the binding has no name for it
// In bytes: PxContactPair, PxContactPatch, PxContact, and PxFrictionPatch with its two anchors.
const PAIR = {size: 44, patches: 8, points: 12, impulses: 16, frictions: 20, count: 28, patchCount: 29};
const PATCH = {size: 64, normal: 16, start: 44, count: 46};
const POINT = {size: 16, separation: 12};
const FRICTION = {size: 52, impulses: 24, anchors: 48, three: 12};

export const version = `physx-js-webidl ${JSON.parse(readFileSync(new URL('package.json', home))).version}`;

const {prototype: top} = P.PxTopLevelFunctions;
const scale = new P.PxTolerancesScale();
scale.length = 1;
const foundation = top.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback());
const physics = top.CreatePhysics(P.PHYSICS_VERSION, foundation, scale);
const dispatcher = top.DefaultCpuDispatcherCreate(0);
const filter = (({eNOTIFY_TOUCH_FOUND: found, eNOTIFY_TOUCH_PERSISTS: persists, eNOTIFY_CONTACT_POINTS: points}) =>
  new P.PxFilterData(1, 1, found | persists | points, 0))(P.PxPairFlagEnum);
const simulated = new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE);
const cooking = new P.PxCookingParams(scale);
const ALONG_Z = [0, -Math.SQRT1_2, 0, Math.SQRT1_2];  // the turn of PhysX' capsules, which are along x
const vector = new P.PxVec3(), pose = new P.PxTransform(P.PxIDENTITYEnum.PxIdentity);

/// The package is built for browsers alone, and refuses Node where it finds one; it runs in it.
async function outsideNode(load) {
  const {process} = globalThis, worker = {WorkerGlobalScope: class {}, self: globalThis, location: {href: ''}};
  Object.assign(globalThis, worker, {process: undefined});
  const loaded = await load();
  for (const name of Object.keys(worker)) delete globalThis[name];
  return Object.assign(globalThis, {process}), loaded;
}

/// Turn of PhysX' plane, whose normal is x, to another normal: of all such quaternions the one whose x is its w, which along an axis
/// has exact components. A stack topples in 0.2 s on a plane that slants by 10⁻⁷.
function turnTo([x, y, z = 0]) {
  if (y === 0 && z === 0) return x > 0 ? [0, 0, 0, 1] : [0, 0, 1, 0];
  const w = Math.sqrt(1 + x) / 2;
  return [w, (y - z) / (4 * w), (y + z) / (4 * w), w];
}

export class PhysxWorld {
  constructor({disks, bodies, law, gravity, dt, rotation, number}) {
    this.dimension = gravity.length;
    this.unit = unitOf(disks);
    this.dt = dt;
    this.count = disks.length;
    this.correctingSpeed = number('correcting_speed');
    this.iterations = [number('position_iterations'), number('velocity_iterations')];
    this.makeScene(gravity, number('solver'));
    const masses = [...new Set(disks.map((disk) => disk.mass))], ofEach = law.restitutionOfEach(masses);
    // Of two materials PhysX takes the means.
    this.materials = new Map([...ofEach].map(([mass, e]) => [mass, physics.createMaterial(law.friction, law.friction, e)]));
    this.actors = [];        // by id
    this.idOf = new Map();   // shape's address → id
    this.disks = disks.map((disk) => this.disk_(disk, rotation));
    this.moving = [];        // {b, body, own, offset} of wall disks and planes that move
    bodies.forEach((body, b) => body.offset.forEach((offset, k) => this.wall(b, body, offset, this.sphere(body.diskRadius[k]))));
    bodies.forEach((body, b) => body.planes.forEach(({point, normal}) =>
      this.wall(b, body, body.fromCentre(point), new P.PxPlaneGeometry(), turnTo(normal))));
    this.firstBall = this.actors.length;  // the id of the first cylinder
    this.balls = ballsOf(bodies, disks).map((ball) =>
      ({...ball, own: this.actor(this.sphere(ball.radius), ball.surface.point, true, Infinity)}));
    this.pairs = law.pairs(masses, bodies.length > 0, (a, b) => (ofEach.get(a) + ofEach.get(b)) / 2);
    this.deviations = [{name: 'contact_offset', value: 2 * CONTACT_OFFSET * this.unit, unit: 'm', note: 'gap from which on contacts act'}];
  }

  makeScene(gravity, solver) {
    const how = new P.PxSceneDesc(scale);
    how.gravity = this.vectorOf(gravity);
    how.cpuDispatcher = dispatcher;
    how.filterShader = top.DefaultFilterShader();
    how.solverType = P.PxSolverTypeEnum[solver === 'tgs' ? 'eTGS' : 'ePGS'];
    how.flags.raise(P.PxSceneFlagEnum.eENABLE_FRICTION_EVERY_ITERATION);
    // Slower impacts do not rebound: with 0, which PhysX does not take, a column of disks under gravity never comes to rest.
    how.bounceThresholdVelocity = Math.max(2 * this.dt * Math.hypot(...gravity) / this.unit, 1e-9);
    this.listener = how.simulationEventCallback = new P.PxSimulationEventCallbackImpl();
    for (const other of ['onConstraintBreak', 'onWake', 'onSleep', 'onTrigger']) this.listener[other] = () => {};
    this.listener.onContact = (_, pairs, count) => {
      for (let k = 0; k < count; ++k) this.contact(pairs + k * PAIR.size);
    };
    this.scene = physics.createScene(how);
    P.destroy(how);
  }

  free() {
    for (const own of [...this.actors, ...this.materials.values(), this.scene]) own.release();
    P.destroy(this.listener);
  }

  vectorOf([x, y, z = 0]) { return vector.set_x(x / this.unit), vector.set_y(y / this.unit), vector.set_z(z / this.unit), vector; }
  spinOf(spin) { return this.vectorOf(scaled(this.unit, this.dimension === 3 ? spin : [0, 0, spin])); }
  poseOf(at, turn = [0, 0, 0, 1]) {
    pose.p = this.vectorOf(at);
    ['x', 'y', 'z', 'w'].forEach((axis, k) => { pose.q[axis] = turn[k]; });
    return pose;
  }
  sphere(radius) { return new P.PxSphereGeometry(radius / this.unit); }

  /// Of a convex body; polygons are prisms, whose thickness is no matter, as bodies keep to the plane.
  geometryOf({shape, radius}) {
    const {kind, vertices, rounding} = shape, half = halfSidesOf(shape), thick = radius / this.unit;
    if (kind === 'capsule') return new P.PxCapsuleGeometry(rounding / this.unit, Math.hypot(...vertices[0]) / this.unit);
    if (half) return new P.PxBoxGeometry(half[0] / this.unit, half[1] / this.unit, half.length === 3 ? half[2] / this.unit : thick);
    const corners = prismOf(vertices, radius), points = new P.PxArray_PxVec3(corners.length);
    corners.forEach((corner, k) => points.set(k, this.vectorOf(corner)));
    const mesh = new P.PxConvexMeshDesc();
    mesh.flags.raise(P.PxConvexFlagEnum.eCOMPUTE_CONVEX);
    mesh.points.count = corners.length;
    mesh.points.stride = 12;
    mesh.points.data = points.begin();
    const made = new P.PxConvexMeshGeometry(top.CreateConvexMesh(cooking, mesh));
    P.destroy(mesh);
    P.destroy(points);
    return made;
  }

  /// @param mass  whose material it has; Infinity: walls'
  actor(geometry, at, moves, mass, turn) {
    const own = moves ? physics.createRigidDynamic(this.poseOf(at)) : physics.createRigidStatic(this.poseOf(at));
    if (moves && mass === Infinity) own.setRigidBodyFlag(P.PxRigidBodyFlagEnum.eKINEMATIC, true);
    const shape = physics.createShape(geometry, this.materials.get(mass), true, simulated);
    shape.setContactOffset(CONTACT_OFFSET);
    shape.setSimulationFilterData(filter);
    if (turn) shape.setLocalPose(this.poseOf([0, 0, 0], turn));
    own.attachShape(shape);
    this.idOf.set(P.getPointer(shape), this.actors.length);
    shape.release();
    P.destroy(geometry);
    this.scene.addActor(own);
    this.actors.push(own);
    return own;
  }

  disk_(disk, rotation) {
    const {shape} = disk, space = this.dimension === 3;
    const own = this.actor(shape ? this.geometryOf(disk) : this.sphere(disk.radius), disk.position, true, disk.mass,
                           shape?.kind === 'capsule' && space ? ALONG_Z : undefined);
    if (shape) {
      own.setGlobalPose(this.poseOf(disk.position, quaternionOfTurn(disk.turn)));
      own.setRigidBodyFlag(GYROSCOPIC, true);
    }
    const locked = this.dimension === 2 ? ['LINEAR_Z', 'ANGULAR_X', 'ANGULAR_Y'] : [];
    for (const axis of [...locked, ...(rotation ? [] : ['ANGULAR_X', 'ANGULAR_Y', 'ANGULAR_Z'])])
      own.setRigidDynamicLockFlag(P.PxRigidDynamicLockFlagEnum[`eLOCK_${axis}`], true);
    own.setMass(disk.mass);
    own.setMassSpaceInertiaTensor(this.vectorOf(scaled(1 / this.unit, disk.moments || Array(3).fill(disk.inertia))));
    own.setLinearDamping(0);
    own.setAngularDamping(0);
    own.setMaxLinearVelocity(NO_LIMIT);
    own.setMaxAngularVelocity(NO_LIMIT);
    own.setSleepThreshold(0);
    if (this.correctingSpeed > 0) own.setMaxDepenetrationVelocity(this.correctingSpeed / this.unit);
    own.setSolverIterationCounts(...this.iterations);
    own.setLinearVelocity(this.vectorOf(disk.velocity));
    own.setAngularVelocity(this.spinOf(disk.spin));
    return own;
  }

  /// A wall disk or a plane is an actor of its own, which goes with the wall.
  wall(b, body, offset, geometry, turn) {
    const own = this.actor(geometry, body.placed(offset, body.state(0)), body.moves, Infinity, turn);
    if (body.moves) this.moving.push({b, body, own, offset});
  }

  placeWalls(now, next) {
    placeBalls(this.balls, (sphere) => this.disk(sphere).position, now, ({own}, _, centre, velocity) => {
      own.setGlobalPose(this.poseOf(centre));
      own.setKinematicTarget(this.poseOf(centre.map((x, k) => x + this.dt * velocity[k])));
    });
    for (const {b, body, own, offset} of this.moving)
      own.setKinematicTarget(this.poseOf(body.placed(offset, next[b]), quaternionOf(next[b].angle)));
  }

  step() {
    this.contacts = [];
    this.scene.simulate(this.dt);
    this.scene.fetchResults(true);
  }

  /// Of a pair that touches, out of PhysX' memory: the binding does not show its friction. The layouts are those of
  /// PxSimulationEventCallback.h and PxContact.h (5.6.1); normals point to the first shape, impulses act on it. Of two bodies that
  /// touch in one point both are at it; else friction is at up to two anchors of a patch.
  contact(at) {
    const words = P.HEAPU32, word = (address) => words[address >> 2];
    const bytes = new Uint8Array(words.buffer), short = (address) => bytes[address] + 256 * bytes[address + 1];
    const numbers = new Float32Array(words.buffer), number = (address) => numbers[address >> 2];
    const three = (address) => [...numbers.subarray(address >> 2, (address >> 2) + this.dimension)];
    const a = this.idOf.get(word(at)), b = this.idOf.get(word(at + 4)), sense = a < b ? 1 : -1;
    const none = [0, 0, 0].slice(0, this.dimension), single = bytes[at + PAIR.count] === 1;
    const add = (pressing, friction, normal, point, separation) => {
      if (pressing === 0 && friction.every((impulse) => impulse === 0)) return;
      this.contacts.push({i: Math.min(a, b), j: Math.max(a, b), pressing, friction: scaled(sense, friction), normal: scaled(sense, normal),
                          point: scaled(this.unit, three(point)), depth: -separation * this.unit});
    };
    for (let p = 0; p < bytes[at + PAIR.patchCount]; ++p) {
      const patch = word(at + PAIR.patches) + p * PATCH.size, anchors = word(at + PAIR.frictions) + p * FRICTION.size;
      const normal = three(patch + PATCH.normal), first = short(patch + PATCH.start);
      for (let k = first; k < first + bytes[patch + PATCH.count]; ++k) {
        const point = word(at + PAIR.points) + k * POINT.size;
        add(number(word(at + PAIR.impulses) + 4 * k), single ? three(anchors + FRICTION.impulses) : none, normal, point,
            number(point + POINT.separation));
      }
      for (let k = 0; k < (single ? 0 : word(anchors + FRICTION.anchors)); ++k)
        add(0, three(anchors + FRICTION.impulses + k * FRICTION.three), normal, anchors + k * FRICTION.three, Infinity);
    }
  }

  disk(i) {
    const own = this.disks[i], components = ({x, y, z}) => [x, y, z], metres = (v) => scaled(this.unit, components(v).slice(0, this.dimension));
    const spin = components(own.getAngularVelocity()), {x, y, z, w} = own.getGlobalPose().q;
    return {
      turn: turnOf(this.dimension, [x, y, z, w]),
      position: metres(own.getGlobalPose().p),
      velocity: metres(own.getLinearVelocity()),
      spin: this.dimension === 3 ? spin : spin[2],
    };
  }

  /// Of an actor by its number: a ball is its cylinder.
  idOfActor(actor) {
    return actor < this.firstBall ? actor : this.firstBall + Math.floor((actor - this.firstBall) / this.count);
  }

  /// Of the last step.
  impulses(visit) {
    for (const {i, j, pressing, friction, normal, point, depth} of this.contacts) {
      const along = this.dimension === 3 ? friction : dot(friction, [-normal[1], normal[0]]);
      visit(i, this.idOfActor(j), pressing * this.unit, scaled(this.unit, along), () => ({normal, point, depth}));
    }
  }
}
