// The scene as Rapier's rigid bodies and colliders, in SI units and single precision.

import {createRequire} from 'node:module';
import {halfSidesOf, quaternionOf, quaternionOfTurn, turnOf as turnOfQuaternion} from '../node/crossgrain_vector.mjs';
import {ballsOf, placeBalls} from '../node/crossgrain_walls.mjs';

const require = createRequire(new URL('../node/', import.meta.url));
const RAPIER = require(process.env.RAPIER ?? '@dimforge/rapier2d-compat');
await RAPIER.init();

export const inSpace = RAPIER.Quaternion !== undefined;

const vectorOf = ([x, y, z]) => (inSpace ? {x, y, z} : {x, y});
const componentsOf = ({x, y, z}) => (inSpace ? [x, y, z] : [x, y]);

/// A turn as Rapier takes it.
function turnOf(angle) { return inSpace ? orientationOf(quaternionOf(angle)) : angle; }
const orientationOf = ([x, y, z, w]) => ({x, y, z, w});

// The turns of Rapier's capsules and cylinders, which are along y.
const ALONG_X = -Math.PI / 2, ALONG_Z = {x: Math.SQRT1_2, y: 0, z: 0, w: Math.SQRT1_2};

/// The collider of a disk, or of a convex body.
function colliderOf({shape, radius}) {
  if (!shape) return RAPIER.ColliderDesc.ball(radius);
  const {kind, vertices, rounding} = shape, half = halfSidesOf(shape);
  if (kind === 'capsule' || kind === 'cylinder')
    return RAPIER.ColliderDesc[kind](Math.hypot(...vertices[0]), rounding).setRotation(inSpace ? ALONG_Z : ALONG_X);
  if (half) return RAPIER.ColliderDesc.cuboid(...half);
  const points = Float32Array.from(vertices.flat());
  if (inSpace) return RAPIER.ColliderDesc.convexHull(points);
  return rounding > 0 ? RAPIER.ColliderDesc.roundConvexPolyline(points, rounding) : RAPIER.ColliderDesc.convexPolyline(points);
}

export const version = RAPIER.version();

/// Of the points of a manifold those that the solver had, in its order: the others, which are too far apart, keep old impulses.
function solvedPoints(manifold) {
  const all = Array.from({length: manifold.numContacts()}, (_, k) => k), solved = manifold.numSolverContacts();
  if (solved === 0 || solved === all.length) return solved === 0 ? [] : all;
  const apart = (k, place) => Math.abs(manifold.contactDist(k) - manifold.solverContactDist(place));
  return Array.from({length: solved}, (_, place) => all.reduce((a, b) => (apart(b, place) < apart(a, place) ? b : a)));
}

export class RapierWorld {
  constructor({disks, bodies, law, gravity, dt, rotation, number}) {
    this.world = new RAPIER.World(vectorOf(gravity));
    this.world.timestep = dt;
    // Rapier's tolerances are fractions of this length.
    this.world.lengthUnit = 2 * Math.min(...disks.map((disk) => disk.radius));
    this.world.integrationParameters.numSolverIterations = number('iterations');
    this.world.integrationParameters.contact_natural_frequency = number('natural_frequency');
    this.law = law;
    this.count = disks.length;
    this.idOf = new Map();  // collider's handle → id
    this.colliders = [];    // by id
    this.setCoefficients(disks, bodies.length > 0);
    this.placeDisks(disks, rotation);
    this.walls = bodies.map((body) => this.wall(body));
    bodies.forEach((body, b) => body.offset.forEach((offset, k) =>
      this.add(RAPIER.ColliderDesc.ball(body.diskRadius[k]).setTranslation(...offset), this.ofWalls, this.walls[b])));
    bodies.forEach((body, b) => body.planes.forEach(({point, normal}) => {
      const at = body.fromCentre(point);
      const plane = new RAPIER.ColliderDesc(new RAPIER.HalfSpace(vectorOf(normal))).setTranslation(...at);
      this.add(plane, this.ofWalls, this.walls[b]);
    }));
    this.balls = ballsOf(bodies, disks).map((ball) => {
      const own = this.world.createRigidBody(
        ball.body.moves ? RAPIER.RigidBodyDesc.kinematicVelocityBased() : RAPIER.RigidBodyDesc.fixed());
      return {...ball, own, collider: this.collider(RAPIER.ColliderDesc.ball(ball.radius), this.ofWalls, own)};
    });
  }

  free() { this.world.free(); }

  /// Rapier has a restitution for each collider, and takes the mean of two.
  setCoefficients(disks, walls) {
    const masses = [...new Set(disks.map((disk) => disk.mass))];
    this.ofMass = this.law.restitutionOfEach(masses);
    this.ofWalls = this.ofMass.get(Infinity);
    this.pairs = this.law.pairs(masses, walls, (a, b) => (this.ofMass.get(a) + this.ofMass.get(b)) / 2);
    this.deviations = [];
  }

  placeDisks(disks, rotation) {
    this.disks = disks.map((disk) => {
      const body = RAPIER.RigidBodyDesc.dynamic().setTranslation(...disk.position).setLinvel(...disk.velocity)
                     .setAngvel(inSpace ? vectorOf(disk.spin) : disk.spin).setCanSleep(false);
      if (disk.shape) body.setRotation(inSpace ? orientationOf(quaternionOfTurn(disk.turn)) : disk.turn);
      const own = this.world.createRigidBody(rotation ? body : body.lockRotations());
      this.add(colliderOf(disk), this.ofMass.get(disk.mass), own);
      const inertia = inSpace ? [vectorOf(disk.moments || Array(3).fill(disk.inertia)), turnOf([0, 0, 0])] : [disk.inertia];
      own.setAdditionalMassProperties(disk.mass, vectorOf([0, 0, 0]), ...inertia, true);
      return own;
    });
  }

  wall(body) {
    const {centre} = body.state(0);
    const kind = body.moves ? RAPIER.RigidBodyDesc.kinematicPositionBased() : RAPIER.RigidBodyDesc.fixed();
    return this.world.createRigidBody(kind.setTranslation(...centre));
  }

  collider(shape, restitution, body) {
    return this.world.createCollider(
      shape.setDensity(0).setFriction(this.law.friction).setRestitution(restitution), body);
  }

  add(shape, restitution, body) {
    const collider = this.collider(shape, restitution, body);
    this.idOf.set(collider.handle, this.colliders.length);
    this.colliders.push(collider.handle);
  }

  placeWalls(now, next) {
    this.walls.forEach((wall, b) => {
      if (!wall.isKinematic()) return;
      wall.setNextKinematicTranslation(vectorOf(next[b].centre));
      wall.setNextKinematicRotation(turnOf(next[b].angle));
    });
    const positionOf = (sphere) => componentsOf(this.disks[sphere].translation());
    placeBalls(this.balls, positionOf, now, ({own, collider, body, radius}, _, centre, velocity) => {
      own.setTranslation(vectorOf(centre), true);
      if (body.moves) own.setLinvel(vectorOf(velocity), true);
      // Rapier keeps a contact's normal until the two have turned about each other by a degree or so, unless a shape is new.
      collider.setRadius(radius);
    });
  }

  step() { this.world.step(); }

  disk(i) {
    const spin = this.disks[i].angvel(), turn = this.disks[i].rotation();
    return {
      turn: inSpace ? turnOfQuaternion(3, [turn.x, turn.y, turn.z, turn.w]) : turn,
      position: componentsOf(this.disks[i].translation()),
      velocity: componentsOf(this.disks[i].linvel()),
      spin: inSpace ? componentsOf(spin) : spin,
    };
  }

  /// Of the last step, in the plane: in space Rapier has friction once for each pair, and does not show it. Its normals point from
  /// the first collider to the second, its tangents along −z × normal; its points are where it found them before it moved the disks.
  impulses(visit) {
    const {narrowPhase, bodies} = this.world;
    const before = narrowPhase.contactPair.length < 4;  // 0.19 does not ask for the bodies
    const contactPair = (a, b, f) => before ? narrowPhase.contactPair(a, b, f) : narrowPhase.contactPair(a, b, bodies, f);
    // Rapier drops what its callbacks throw.
    let failure;
    const guarded = (f) => (...given) => {
      try {
        f(...given);
      } catch (error) {
        failure ??= error;
      }
    };
    for (let i = 0; i < this.count; ++i)
      narrowPhase.contactPairsWith(this.colliders[i], guarded((other) => {
        const j = this.idOf.get(other);
        if (j < i) return;
        contactPair(this.colliders[i], other, guarded((manifold, flipped) => {
          solvedPoints(manifold).forEach((k, place) => {
            const pressing = manifold.contactImpulse(k), along = manifold.contactTangentImpulse(k);
            if (pressing === 0 && along === 0) return;
            visit(i, j, pressing, along, () => {
              const normal = manifold.normal(), away = flipped ? 1 : -1, point = manifold.solverContactPoint(place);
              return {normal: [away * normal.x, away * normal.y], point: [point.x, point.y], depth: -manifold.contactDist(k)};
            });
          });
        }));
      }));
    if (failure) throw failure;
  }
}
