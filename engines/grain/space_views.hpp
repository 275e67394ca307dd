#pragma once

#include <cstddef>
#include <cstdint>

#include "engines/grain/law_types.hpp"
#include "engines/grain/space_law.hpp"

namespace grain {

/// A vector of four, of which the last rests: as wide as a register, so that three components move
/// through memory and arithmetic together.
struct alignas(32) Quad {
  double x, y, z, w;
};

struct Lanes {
  typedef double Four __attribute__((vector_size(32)));
  Four v;

  GRAIN_INLINE explicit Lanes(const Quad& quad) { __builtin_memcpy(&v, &quad, sizeof v); }
  GRAIN_INLINE void store(Quad& quad) const { __builtin_memcpy(&quad, &v, sizeof v); }
  GRAIN_INLINE void operator+=(const Lanes& b) { v += b.v; }
  GRAIN_INLINE void operator-=(const Lanes& b) { v -= b.v; }
};

GRAIN_INLINE Vec3<double> vectorOf(const Quad& quad) {
  return {quad.x, quad.y, quad.z};
}
GRAIN_INLINE Quad quadOf(const Vec3<double>& v, double w = 0.0) {
  return {v.x, v.y, v.z, w};
}
GRAIN_INLINE void add(Quad& quad, const Vec3<double>& v, double factor) {
  Lanes sum(quad), part(quadOf(v));
  part.v *= factor;
  sum += part;
  sum.store(quad);
}

/// What contacts read of the spheres (moving, then those of walls) and add to.
struct SpaceView {
  const Quad* position;                        ///< w: the radius
  const Quad *velocity, *spin;                 ///< what dashpots see; spin: null without rotation
  const double *inverseMass, *inverseInertia;  ///< 0 of walls
  Quad *force, *torque;
};

/// Two spheres. @param normal  from j, or its image, to i
template <class L>
GRAIN_INLINE Meeting<double> meetingOf(const L& law, const SpaceView& all, std::size_t i,
                                       std::size_t j, const Vec3<double>& normal, double overlap) {
  const double a = all.position[i].w, b = all.position[j].w;
  Meeting<double> meeting{};
  meeting.normal = normal;
  meeting.velocity = vectorOf(all.velocity[i]) - vectorOf(all.velocity[j]);
  meeting.overlap = overlap;
  meeting.radiusI = a;
  meeting.radiusJ = b;
  meeting.inverseMassI = all.inverseMass[i];
  meeting.inverseMassJ = all.inverseMass[j];
  meeting.inverseMass = meeting.inverseMassI + meeting.inverseMassJ;
  if (!law.rotation) return meeting;
  meeting.spinI = vectorOf(all.spin[i]);
  meeting.spinJ = vectorOf(all.spin[j]);
  meeting.leverI = armOf(law.lever, a, b, overlap);
  meeting.leverJ = armOf(law.lever, b, a, overlap);
  meeting.armI = armOf(law.velocityLever, a, b, overlap);
  meeting.armJ = armOf(law.velocityLever, b, a, overlap);
  meeting.inverseInertiaI = all.inverseInertia[i];
  meeting.inverseInertiaJ = all.inverseInertia[j];
  return meeting;
}

/// The last step's results for a pair that touched.
struct SpaceResult {
  double overlap = 0.0, normal = 0.0, sliding = 0.0;
  Vec3<double> tangential, rolling;
};

/// A list of pairs, one entry each.
struct SpacePairs {
  std::size_t count;
  const std::int32_t *i, *j;
  const Quad* shift;  ///< where the image of j is that i is near to, from j
  SpaceMemory<double>* kept;
  SpaceResult* results;
  std::uint8_t* touches;  ///< whether it did in the last step
};

struct SpaceReport {
  std::size_t touching = 0;
  bool deep = false;  ///< some overlap is beyond what is allowed, or no number
};

/// @param range       how far apart bodies may be in contact [m]
/// @param maxOverlap  in units of the smaller radius
using SpacePairKernel = SpaceReport (*)(const GeneralLaw<double>&, const SpaceConventions&,
                                        const SpaceView&, const SpacePairs&, double range,
                                        double maxOverlap);

/// The moving spheres as their motion sees them. Without rotation spins and torques are null.
struct SpaceMotionView {
  Quad *position, *velocity, *spin;
  Quad *seenVelocity, *seenSpin;  ///< to be predicted; null: nothing is
  Quad *force, *torque;
  const double *inverseMass, *inverseInertia, *mass;
  const Quad* chosen;       ///< where the near pairs were chosen
  const double* allowance;  ///< the square of how far a sphere may be from there [m²]
};

struct SpaceMotionConstants {
  double kick, drift;  ///< v += kick·a, x += drift·v [s]
  double ahead;        ///< how far the dashpots' velocities are carried on [s]
  Vec3<double> gravity;
};

/// What a motion kernel saw on its way.
struct SpaceMotionReport {
  double excess = -1.0;  ///< > 0 if some sphere is beyond its allowance [m²]
  double squares = 0.0;  ///< not finite if some velocity or place is not
};

using SpaceMotionKernel = SpaceMotionReport (*)(const SpaceMotionConstants&, const SpaceMotionView&,
                                                std::size_t count);

struct SpaceKernels {
  SpacePairKernel pairs;
  SpaceMotionKernel motion;
};
}  // namespace grain
