// Vectors in the plane, [x, y], or in space, [x, y, z]. What is one number about z in the plane (spin, angle, torque, and what
// acts along z × n) is a vector in space.

export const plus = (a, b) => a.map((x, k) => x + b[k]);
export const minus = (a, b) => a.map((x, k) => x - b[k]);
export const scaled = (s, a) => (Array.isArray(a) ? a.map((x) => s * x) : s * a);
export const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
export const isZero = (a) => (Array.isArray(a) ? a.every((x) => x === 0) : a === 0);
export const noSpin = (dimension) => (dimension === 3 ? [0, 0, 0] : 0);

/// a × b; of vectors in the plane its z component.
export function cross(a, b) {
  if (a.length === 2) return a[0] * b[1] - a[1] * b[0];
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/// Velocity of what spins, at the end of an arm.
export const turning = (spin, arm) => (arm.length === 2 ? [-spin * arm[1], spin * arm[0]] : cross(spin, arm));

/// a turned by an angle; in space by Rodrigues' formula.
export function turned(angle, a) {
  if (a.length === 2) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return [c * a[0] - s * a[1], s * a[0] + c * a[1]];
  }
  const size = Math.hypot(...angle);
  if (size === 0) return a;
  const axis = scaled(1 / size, angle), along = (1 - Math.cos(size)) * dot(axis, a);
  return plus(plus(scaled(Math.cos(size), a), scaled(Math.sin(size), cross(axis, a))), scaled(along, axis));
}

/// A unit of length for engines in single precision: the power of two in which the smallest disk has about that radius.
export const unitOf = (disks, radius = 1) => 2 ** Math.round(Math.log2(Math.min(...disks.map((disk) => disk.radius)) / radius));

/// The unit quaternion [x, y, z, w] of a turn.
export function quaternionOf(angle) {
  const turn = Array.isArray(angle) ? angle : [0, 0, angle], size = Math.hypot(...turn);
  return [...scaled(size > 0 ? Math.sin(size / 2) / size : 0.5, turn), Math.cos(size / 2)];
}

/// A tangential quantity after its normal has turned from n to m by the smallest turn.
export function carriedAlong(along, n, m) {
  if (n.length === 2) return along;
  const w = cross(n, m), across = cross(w, along), share = 1 + dot(n, m);  // 0: any turn by 180° is as small
  return share > 0 ? plus(plus(along, across), scaled(1 / share, cross(w, across))) : along;
}

/// Half the sides of a shape that is a box, also one in the plane; null of others.
export function halfSidesOf({vertices, rounding}) {
  const half = vertices[0].map(Math.abs);
  const isBox = rounding === 0 && vertices.length === 2 ** half.length &&
    vertices.every((vertex) => vertex.every((x, k) => Math.abs(x) === half[k]));
  return isBox ? half : null;
}

/// Corners of a polygon as a prism about its plane, for engines of space; those of a polyhedron as they are.
export const prismOf = (vertices, half) =>
  (vertices[0].length === 3 ? vertices : vertices.flatMap(([x, y]) => [[x, y, -half], [x, y, half]]));

/// An orientation of the protocol as [x, y, z, w], and back.
export const quaternionOfTurn = (turn) => (Array.isArray(turn) ? [...turn.slice(1), turn[0]] : quaternionOf(turn));
export const turnOf = (dimension, [x, y, z, w]) => (dimension === 3 ? [w, x, y, z] : 2 * Math.atan2(z, w));
