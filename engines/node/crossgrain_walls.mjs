// Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp, for those that stay rigid.

import {cross, dot, minus, noSpin, plus, scaled, turned, turning} from './crossgrain_vector.mjs';

/// How a place faces a plane of a body in such a state, or a hollow cylinder, with spheres inside: the normal (of a cylinder to the
/// axis, on the axis itself any across it), and the distance from the surface.
export function facing({point, normal: plane, axis, radius}, place, body, state) {
  if (plane) {
    const normal = turned(state.angle, plane);
    return {normal, distance: dot(minus(place, body.placed(body.fromCentre(point), state)), normal)};
  }
  const apart = minus(place, point), aside = minus(apart, scaled(dot(apart, axis), axis)), s = Math.hypot(...aside);
  return {normal: s > 0 ? scaled(-1 / s, aside) : across(axis), distance: radius - s};
}

/// A direction at right angles to another.
function across(axis) {
  const direction = cross(axis, Math.abs(axis[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]);
  return scaled(1 / Math.hypot(...direction), direction);
}

/// A rigid body of wall disks, planes and cylinders at any time. Cylinders stay where they are: it stands still or turns about
/// their axis.
export class Body {
  constructor(description, diskPosition, diskRadius) {
    this.motion = description.motion;
    this.start = description.centre;
    this.diskRadius = diskRadius;
    this.planes = description.planes;
    this.cylinders = description.cylinders ?? [];
    /// Of the wall disks, from the centre, at t = 0.
    const dimension = this.start.length;
    this.offset = Array.from(diskRadius, (_, k) =>
      this.fromCentre([...diskPosition.slice(dimension * k, dimension * (k + 1))]));
  }

  fromCentre(point) { return minus(point, this.start); }

  get moves() { return this.motion.kind !== 'fixed'; }

  /// Centre, velocity of the centre, angle and angular velocity at time t.
  state(t) {
    const {kind, velocity, amplitude, frequency, angular_velocity: spin} = this.motion;
    const dimension = this.start.length, none = noSpin(dimension);
    const still = {centre: this.start, velocity: Array(dimension).fill(0), angle: none, spin: none};
    if (kind === 'rotating') return {...still, angle: scaled(t, spin), spin};
    if (kind === 'translating') return {...still, centre: plus(this.start, scaled(t, velocity)), velocity};
    if (kind === 'oscillating')
      return {...still, centre: plus(this.start, scaled(Math.sin(frequency * t), amplitude)),
              velocity: scaled(frequency * Math.cos(frequency * t), amplitude)};
    return still;
  }

  /// Velocity of its material at a place, in such a state.
  velocityAt(place, {centre, velocity, spin}) { return plus(velocity, turning(spin, minus(place, centre))); }

  /// Where something is at time t that lies there, seen from the centre, at t = 0.
  placed(offset, {centre, angle}) {
    if (offset.length === 3) return plus(centre, turned(angle, offset));
    const c = Math.cos(angle), s = Math.sin(angle);
    return [centre[0] + c * offset[0] - s * offset[1], centre[1] + s * offset[0] + c * offset[1]];
  }
}

// Hollow cylinders for engines that have solid ones alone, and planes for those without: for each sphere and surface a ball of the
// sphere's size, outside of the wall. Before each step it is put where it touches the wall at the point nearest to the sphere, and gets the wall's velocity there.
// The sphere, s from the axis, meets it with n to the axis and δ = a + b − (R + b − s) = a − (R − s). The ball is behind the plane that
// touches the wall there, and the whole inside is before that: no other sphere comes to it.

/// Surface by surface, those of one kind in the order of their ids, one for each sphere.
export const ballsOf = (bodies, spheres, surfaces = ({cylinders}) => cylinders) =>
  bodies.flatMap((body, b) =>
    surfaces(body).flatMap((surface) => spheres.map(({radius}, sphere) => ({body, b, surface, sphere, radius, follows: true}))));

/// Before a step. Balls of spheres that are far from the wall rest where they were left, outside.
/// @param positionOf  of a sphere by its number  @param states  of the bodies
/// @param place       (ball, its number, centre, velocity)
export function placeBalls(balls, positionOf, states, place) {
  balls.forEach((ball, k) => {
    const {body, b, surface, sphere, radius, follows} = ball;
    const from = positionOf(sphere), {normal, distance} = facing(surface, from, body, states[b]);
    const behind = (by) => from.map((x, c) => x - by * normal[c]);
    ball.follows = distance < 2 * radius;
    if (ball.follows) place(ball, k, behind(distance + radius), body.velocityAt(behind(distance), states[b]));
    else if (follows) place(ball, k, behind(distance + radius), [0, 0, 0]);
  });
}
