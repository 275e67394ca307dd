// The scene as bodies of Jolt Physics; disks keep to a plane. In single precision, and in a unit of length in which the smallest disk
// has a radius of about one, since Jolt's tolerances are made for things of 0.1 to 10 m.

import {readFileSync} from 'node:fs';
import {cross, dot, halfSidesOf, minus, noSpin, plus, prismOf, quaternionOf, quaternionOfTurn, scaled, turnOf, unitOf} from '../node/crossgrain_vector.mjs';
import {ballsOf, placeBalls} from '../node/crossgrain_walls.mjs';
import {Unsupported} from '../node/crossgrain_worker.mjs';

const home = new URL(`../node/node_modules/${process.env.JOLT ?? 'jolt-physics'}/`, import.meta.url);
const {default: makeJolt} = await import(new URL('dist/jolt-physics.wasm-compat.js', home));
const J = await makeJolt();

const MOST_CONTACTS = 10240;  // of a step: for more there is no room in what JoltInterface allocates for a step
const MOST_BODIES = 10240;    // JoltSettings' own
const HALF_PLANE = 1e6;       // units; it bounds a plane's box in the broad phase, nothing else
const FIXED = 0, MOVING = 1;  // layers
const HULL_TOLERANCE = 1e-6;  // units; by Jolt's own, 1e-3, corners of fine polygons are left out

const {version: binding} = JSON.parse(readFileSync(new URL('package.json', home)));
// Until Jolt 5.5, jolt-physics 1.0, each point of a contact had friction of its own; since 5.6 a contact has it once.
const FRICTION_OF_POINTS = binding.startsWith('1.0.');

export const version = `jolt-physics ${binding}`;

/// Destroys an object of the binding after use: it is not garbage-collected.
function once(object, use) {
  const result = use(object);
  J.destroy(object);
  return result;
}

/// Jolt's world with its two layers: what moves meets all, what is fixed meets what moves.
/// @param room  for contacts of a step, beyond which Jolt drops some
function makeWorld(room) {
  const pairs = new J.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(FIXED, MOVING);
  pairs.EnableCollision(MOVING, MOVING);
  const layers = new J.BroadPhaseLayerInterfaceTable(2, 2);
  for (const layer of [FIXED, MOVING]) once(new J.BroadPhaseLayer(layer), (own) => layers.MapObjectToBroadPhaseLayer(layer, own));
  return once(new J.JoltSettings(), (how) => {
    how.mMaxWorkerThreads = 0;
    how.mMaxBodies = MOST_BODIES;
    how.mMaxContactConstraints = room;
    how.mObjectLayerPairFilter = pairs;
    how.mBroadPhaseLayerInterface = layers;
    how.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
    return new J.JoltInterface(how);
  });
}

/// Contacts of the last step with their impulses, out of the stream that PhysicsSystem::SaveState writes of them: the binding has
/// no other way to impulses. The layout is that of ContactConstraintManager.cpp (Jolt 5.6), ManifoldCache::SaveState.
class ContactStream {
  constructor() {
    this.bytes = new DataView(new ArrayBuffer(1 << 12));
    this.recorder = new J.StateRecorderJS();
    this.recorder.WriteBytes = (from, count) => this.write(from, count);
    this.recorder.ReadBytes = () => {};
    this.recorder.IsEOF = this.recorder.IsFailed = () => false;
  }

  write(from, count) {
    if (this.size + count > this.bytes.byteLength) {
      const larger = new Uint8Array(2 * this.bytes.byteLength);
      larger.set(new Uint8Array(this.bytes.buffer));
      this.bytes = new DataView(larger.buffer);
    }
    for (let k = 0; k < count; ++k) this.bytes.setUint8(this.size++, J.HEAPU8[from + k]);
  }

  /// @param visit  (lower body, other body, normal impulses of the points, friction's along Jolt's two tangents, of each point or
  ///                once, friction's about the normal)
  read(system, visit) {
    this.size = 0;
    system.SaveState(this.recorder, J.EStateRecorderState_Contacts);
    let at = 0;
    const integer = () => this.bytes.getUint32((at += 4) - 4, true), real = () => this.bytes.getFloat32((at += 4) - 4, true);
    at += 1;  // which parts of the state follow
    for (let pairs = integer(); pairs > 0; --pairs) {
      at += 8 + 24;  // the bodies; their change of position and rotation
      for (let manifolds = integer(); manifolds > 0; --manifolds) {
        const a = integer(), b = (at += 4, integer());
        at += 4;
        const points = this.bytes.getUint16((at += 2) - 2, true);
        at += 12;  // the normal in the second body's axes
        const pressing = [], along = FRICTION_OF_POINTS ? [] : [[real(), real()]], about = FRICTION_OF_POINTS ? 0 : real();
        for (let k = 0; k < points; ++k) {
          at += 24;  // its places in the two bodies
          pressing.push(real());
          if (FRICTION_OF_POINTS) along.push([real(), real()]);
        }
        visit(a, b, pressing, along, about);
      }
    }
    if (at + 4 !== this.size) throw new Error(`Jolt wrote ${this.size} bytes of contacts where ${at + 4} were expected`);
  }
}

export class JoltWorld {
  constructor({disks, bodies, law, gravity, dt, rotation, number}) {
    this.inSpace = gravity.length === 3;
    this.unturned = noSpin(gravity.length);
    this.unit = unitOf(disks);
    this.dt = dt;
    this.count = disks.length;
    this.convex = disks.some(({shape}) => shape);
    this.law = law;
    this.mass = disks.map((disk) => disk.mass);  // by id; beyond them, walls
    this.room = Math.min(MOST_CONTACTS, 1024 + 8 * this.count);
    this.jolt = makeWorld(this.room);
    this.system = this.jolt.GetPhysicsSystem();
    this.make = this.system.GetBodyInterface();
    this.vector = new J.Vec3();
    this.place = new J.RVec3();
    this.turn = new J.Quat(0, 0, 0, 1);
    this.system.SetGravity(this.vectorOf(gravity));
    this.configure(number, Math.hypot(...gravity));
    this.listen();
    this.stream = new ContactStream();
    this.bodies = [];  // by id
    disks.forEach((disk) => this.disk_(disk, rotation));
    this.moving = [];  // {b, body, id, offset} of wall disks and planes that move
    bodies.forEach((body, b) => body.offset.forEach((offset, k) => this.wall(b, body, offset, new J.SphereShape(body.diskRadius[k] / this.unit))));
    bodies.forEach((body, b) => body.planes.forEach((plane) => this.plane(b, body, plane)));
    this.firstBall = this.bodies.length;  // the id of the first cylinder
    this.balls = ballsOf(bodies, disks);
    this.balls.forEach((ball) => this.ball(ball));
    this.system.OptimizeBroadPhase();
    this.pairs = law.pairs([...new Set(this.mass)], bodies.length > 0);
    this.deviations = [{name: 'slop', value: number('slop') * this.unit, unit: 'm', note: 'largest overlap that is left standing'}];
  }

  /// All of it: a worker loads hundreds of scenes, and what is left behind of each splits the heap, of 128 MB, for the next.
  free() {
    for (const own of [this.jolt, this.listener, this.stream.recorder, this.vector, this.place, this.turn]) J.destroy(own);
  }

  vectorOf([x, y, z = 0]) { return this.vector.Set(x / this.unit, y / this.unit, z / this.unit), this.vector; }
  placeOf([x, y, z = 0]) { return this.place.Set(x / this.unit, y / this.unit, z / this.unit), this.place; }
  spinOf(spin) { return this.vector.Set(...(this.inSpace ? spin : [0, 0, spin])), this.vector; }
  turnOf(angle) { return this.turn.Set(...quaternionOf(angle)), this.turn; }

  configure(number, gravity) {
    const how = this.system.GetPhysicsSettings(), radius = 1;
    how.mNumVelocitySteps = number('velocity_iterations');
    how.mNumPositionSteps = number('position_iterations');
    how.mBaumgarte = number('baumgarte');
    how.mPenetrationSlop = number('slop') * radius;
    how.mSpeculativeContactDistance = number('speculative_distance') * radius;
    // Slower impacts do not rebound: with 0 a column of disks under gravity never comes to rest.
    how.mMinVelocityForRestitution = 2 * this.dt * gravity / this.unit;
    // With it contacts of disks that moved by less than a thousandth of a radius are those of the step before.
    how.mUseBodyPairContactCache = false;
    how.mAllowSleeping = false;
    this.system.SetPhysicsSettings(how);
  }

  /// Jolt asks about each contact in each step; it takes what is set there, not its own mixture of two bodies' coefficients.
  listen() {
    this.contacts = new Map();  // lower id · 2^20 + other id → {normal from lower to other, points [m]}
    const set = (a, b, manifold, settings) => {
      const i = J.wrapPointer(a, J.Body).GetID().GetIndex(), j = J.wrapPointer(b, J.Body).GetID().GetIndex();
      const how = J.wrapPointer(settings, J.ContactSettings), found = J.wrapPointer(manifold, J.ContactManifold);
      how.mCombinedFriction = this.law.friction;
      how.mCombinedRestitution = this.law.restitution(this.mass[i] ?? Infinity, this.mass[j] ?? Infinity);
      const contact = {normal: this.components(found.mWorldSpaceNormal)}, points = this.convex ? found.mRelativeContactPointsOn1.size() : 1;
      if (this.convex || j >= this.count)
        contact.points = Array.from({length: points}, (_, p) => {
          const on1 = this.metres(found.GetWorldSpaceContactPointOn1(p)), on2 = this.metres(found.GetWorldSpaceContactPointOn2(p));
          return {point: on1.map((x, k) => (x + on2[k]) / 2), depth: dot(minus(on1, on2), contact.normal)};
        });
      this.contacts.set(i * 2 ** 20 + j, contact);
    };
    this.listener = new J.ContactListenerJS();
    this.listener.OnContactValidate = () => J.ValidateResult_AcceptAllContactsForThisBodyPair;
    this.listener.OnContactAdded = this.listener.OnContactPersisted = set;
    this.listener.OnContactRemoved = () => {};
    this.system.SetContactListener(this.listener);
  }

  /// Jolt numbers bodies in the order in which they come: the protocol's ids.
  body(shape, at, motion, more = () => {}, layer = motion === J.EMotionType_Static ? FIXED : MOVING) {
    if (this.bodies.length === MOST_BODIES)
      throw new Unsupported(`has at most ${MOST_BODIES} disks, wall disks, planes, and spheres times cylinders`);
    const body = once(new J.BodyCreationSettings(shape, this.placeOf(at), this.turnOf(this.unturned), motion, layer), (how) => {
      how.mAllowSleeping = false;
      how.mLinearDamping = how.mAngularDamping = 0;
      how.mMaxLinearVelocity = how.mMaxAngularVelocity = 1e9;  // its own are 500 m/s and 47 /s
      how.mOverrideMassProperties = J.EOverrideMassProperties_MassAndInertiaProvided;
      how.mMassPropertiesOverride.mMass = 1;
      more(how);
      return this.make.CreateBody(how);
    });
    if (body.GetID().GetIndex() !== this.bodies.length) throw new Error('Jolt numbered its bodies otherwise than in their order');
    this.bodies.push(body);
    this.make.AddBody(body.GetID(), J.EActivation_Activate);
    return body;
  }

  /// Of a convex body, with sharp edges; polygons are prisms, whose thickness is no matter, as bodies keep to the plane.
  shapeOf({shape, radius}) {
    if (!shape) return new J.SphereShape(radius / this.unit);
    const {kind, vertices, rounding} = shape, half = halfSidesOf(shape), length = Math.hypot(...vertices[0]) / this.unit;
    const turned = (own) => {  // Jolt's capsules and cylinders are along y
      this.turn.Set(...(this.inSpace ? [Math.SQRT1_2, 0, 0, Math.SQRT1_2] : [0, 0, Math.SQRT1_2, Math.SQRT1_2]));
      return this.made(new J.RotatedTranslatedShapeSettings(this.vectorOf([0, 0, 0]), this.turn, own));
    };
    if (kind === 'capsule') return turned(new J.CapsuleShapeSettings(length, rounding / this.unit));
    if (kind === 'cylinder') return turned(new J.CylinderShapeSettings(length, rounding / this.unit, 0));
    if (half) return new J.BoxShape(this.vectorOf([half[0], half[1], half[2] ?? radius]), 0);
    const how = new J.ConvexHullShapeSettings();
    how.mMaxConvexRadius = 0;
    how.mHullTolerance = HULL_TOLERANCE;
    for (const corner of prismOf(vertices, radius)) how.mPoints.push_back(this.vectorOf(corner));
    return this.made(how);
  }

  made(how) {
    return once(how, () => {
      const result = how.Create();
      if (result.HasError()) throw new Unsupported(`refuses a shape: ${result.GetError().c_str()}`);
      const own = result.Get();
      own.AddRef();
      return own;
    });
  }

  disk_(disk, rotation) {
    const body = this.body(this.shapeOf(disk), disk.position, J.EMotionType_Dynamic, (how) => {
      const moves = J.EAllowedDOFs_TranslationX | J.EAllowedDOFs_TranslationY;
      if (this.inSpace) how.mAllowedDOFs = rotation ? J.EAllowedDOFs_All : moves | J.EAllowedDOFs_TranslationZ;
      else how.mAllowedDOFs = rotation ? J.EAllowedDOFs_Plane2D : moves;
      if (!disk.shape) return;
      how.mRotation = (this.turn.Set(...quaternionOfTurn(disk.turn)), this.turn);
      how.mApplyGyroscopicForce = true;  // Euler's term, which Jolt leaves out otherwise
    });
    const own = body.GetMotionProperties(), moments = disk.moments || Array(3).fill(disk.inertia);
    own.SetInverseMass(1 / disk.mass);
    if (rotation)
      own.SetInverseInertia((this.vector.Set(...moments.map((j) => 1 / (j / this.unit ** 2))), this.vector), this.turnOf(this.unturned));
    body.SetLinearVelocity(this.vectorOf(disk.velocity));
    body.SetAngularVelocity(this.spinOf(disk.spin));
  }

  /// A wall disk or a plane is a body of its own, which goes with the wall.
  wall(b, body, offset, shape) {
    if (body.moves) this.moving.push({b, body, id: this.bodies.length, offset});
    this.body(shape, body.placed(offset, body.state(0)), body.moves ? J.EMotionType_Kinematic : J.EMotionType_Static);
  }

  plane(b, body, {point, normal: [x, y, z = 0]}) {
    this.vector.Set(x, y, z);
    const plane = once(new J.Plane(this.vector, 0), (own) => new J.PlaneShape(own, null, HALF_PLANE));
    this.wall(b, body, body.fromCentre(point), plane);
  }

  /// In the layer of what is fixed, since balls meet spheres alone; where it is to be it is put before the first step.
  ball({surface, radius}) {
    this.body(new J.SphereShape(radius / this.unit), surface.point, J.EMotionType_Kinematic, () => {}, FIXED);
  }

  placeWalls(now, next) {
    placeBalls(this.balls, (sphere) => this.metres(this.bodies[sphere].GetPosition()), now, (ball, k, centre, velocity) => {
      const own = this.bodies[this.firstBall + k];
      this.make.SetPosition(own.GetID(), this.placeOf(centre), J.EActivation_Activate);
      own.SetLinearVelocity(this.vectorOf(velocity));
    });
    for (const {b, body, id, offset} of this.moving)
      this.make.MoveKinematic(this.bodies[id].GetID(), this.placeOf(body.placed(offset, next[b])), this.turnOf(next[b].angle), this.dt);
  }

  step() {
    this.contacts.clear();
    this.jolt.Step(this.dt, 1);
    if (this.contacts.size >= this.room) throw new Error(`Jolt has room for ${this.room} contacts, and these are more`);
  }

  components(vector) {
    const inPlane = [vector.GetX(), vector.GetY()];
    return this.inSpace ? [...inPlane, vector.GetZ()] : inPlane;
  }
  metres(vector) { return scaled(this.unit, this.components(vector)); }

  disk(i) {
    const turn = this.convex && this.bodies[i].GetRotation();
    return {
      ...(turn && {turn: turnOf(this.inSpace ? 3 : 2, [turn.GetX(), turn.GetY(), turn.GetZ(), turn.GetW()])}),
      position: this.metres(this.bodies[i].GetPosition()),
      velocity: this.metres(this.bodies[i].GetLinearVelocity()),
      spin: this.inSpace ? this.components(this.bodies[i].GetAngularVelocity()) : this.bodies[i].GetAngularVelocity().GetZ(),
    };
  }

  /// Of a body by its number: a ball is its cylinder.
  idOf(body) {
    return body < this.firstBall ? body : this.firstBall + Math.floor((body - this.firstBall) / this.count);
  }

  /// Of the last step.
  impulses(visit) {
    this.stream.read(this.system, (a, b, pressing, along, about) => {
      const i = a & 0x7fffff, j = b & 0x7fffff;  // without Jolt's count of uses
      if (pressing.every((impulse) => impulse === 0) && along.every((own) => own.every((impulse) => impulse === 0))) return;
      const {normal, points} = this.contacts.get(i * 2 ** 20 + j), id = this.idOf(j);
      const add = (push, friction, place) => visit(i, id, push * this.unit, scaled(this.unit, friction), () => ({normal: scaled(-1, normal), ...place}));
      const tangential = along.map((own) => (this.inSpace ? alongTangents(normal, own) : alongTangentInPlane(normal, own)));
      if (pressing.length === 1) return add(pressing[0], tangential[0], points?.[0]);
      pressing.forEach((push, k) => add(push, FRICTION_OF_POINTS ? tangential[k] : this.unturned, points[k]));
      if (!FRICTION_OF_POINTS) frictionOf(normal, points, tangential[0], about * this.unit).forEach(([friction, point]) => add(0, friction, {point, depth: -Infinity}));
    });
  }
}

/// Friction of a contact of several points [impulse, point]: once, in their middle, and what is about the normal as a couple.
function frictionOf(normal, points, along, about) {
  const middle = scaled(1 / points.length, points.map(({point}) => point).reduce(plus)), arm = minus(points[0].point, middle);
  if (about === 0) return [[along, middle]];
  const aside = scaled(-about / (2 * dot(arm, arm)), cross(normal, arm));
  return [[along, middle], [aside, plus(middle, arm)], [scaled(-1, aside), minus(middle, arm)]];
}

/// On the lower body, in space: Jolt's tangents of a normal n from it to the other are p, n turned in the plane of its larger one of
/// x, y and of z (Vec3::GetNormalizedPerpendicular), and n × p; what acts along them acts on the other.
function alongTangents([x, y, z], [first, second]) {
  const perpendicular = Math.abs(x) > Math.abs(y) ? scaled(1 / Math.hypot(x, z), [z, 0, -x]) : scaled(1 / Math.hypot(y, z), [0, z, -y]);
  return scaled(-1, plus(scaled(first, perpendicular), scaled(second, cross([x, y, z], perpendicular))));
}

/// In the plane p is ∓z and n × p is s z × n, s the sign of the larger of n's components. Both disks of a pair see the same impulse
/// along z × their own normal.
function alongTangentInPlane([x, y], [, second]) {
  return (Math.abs(x) > Math.abs(y) ? Math.sign(x) : Math.sign(y)) * second;
}
