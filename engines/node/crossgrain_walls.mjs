// Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp, for those that stay rigid.

/// A rigid body of wall disks and planes at any time. Vectors are [x, y].
export class Body {
  constructor(description, diskPosition, diskRadius) {
    this.motion = description.motion;
    this.start = description.centre;
    this.diskRadius = diskRadius;
    this.planes = description.planes;
    /// Of the wall disks, from the centre, at t = 0.
    this.offset = Array.from(diskRadius, (_, k) => this.fromCentre([diskPosition[2 * k], diskPosition[2 * k + 1]]));
  }

  fromCentre(point) { return [point[0] - this.start[0], point[1] - this.start[1]]; }

  get moves() { return this.motion.kind !== 'fixed'; }

  /// Centre, velocity of the centre, angle and angular velocity at time t.
  state(t) {
    const {kind, velocity, amplitude, frequency, angular_velocity: spin} = this.motion, [x, y] = this.start;
    if (kind === 'rotating') return {centre: [x, y], velocity: [0, 0], angle: spin * t, spin};
    if (kind === 'translating')
      return {centre: [x + velocity[0] * t, y + velocity[1] * t], velocity, angle: 0, spin: 0};
    if (kind === 'oscillating') {
      const s = Math.sin(frequency * t), c = frequency * Math.cos(frequency * t);
      return {centre: [x + amplitude[0] * s, y + amplitude[1] * s], velocity: [amplitude[0] * c, amplitude[1] * c],
              angle: 0, spin: 0};
    }
    return {centre: [x, y], velocity: [0, 0], angle: 0, spin: 0};
  }

  /// Where something is at time t that lies there, seen from the centre, at t = 0.
  placed(offset, {centre, angle}) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [centre[0] + c * offset[0] - s * offset[1], centre[1] + s * offset[0] + c * offset[1]];
  }
}
