#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

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
  /// In registers: by way of memory three numbers would have to be there before one load of all.
  GRAIN_INLINE explicit Lanes(const Vec3<double>& a) : v{a.x, a.y, a.z, 0.0} {}
  GRAIN_INLINE void store(Quad& quad) const { __builtin_memcpy(&quad, &v, sizeof v); }
  GRAIN_INLINE void operator+=(const Lanes& b) { v += b.v; }
  GRAIN_INLINE void operator-=(const Lanes& b) { v -= b.v; }
  /// Three of these and the fourth of others.
  GRAIN_INLINE Lanes withLast(const Lanes& others) const {
    Lanes both = *this;
    both.v = __builtin_shufflevector(v, others.v, 0, 1, 2, 7);
    return both;
  }
};

GRAIN_INLINE Vec3<double> vectorOf(const Quad& quad) {
  return {quad.x, quad.y, quad.z};
}
GRAIN_INLINE Quad quadOf(const Vec3<double>& v, double w = 0.0) {
  return {v.x, v.y, v.z, w};
}
GRAIN_INLINE void add(Quad& quad, const Vec3<double>& v, double factor) {
  Lanes sum(quad), part(v);
  part.v *= factor;
  sum += part;
  sum.store(quad);
}
GRAIN_INLINE void operator+=(Quad& quad, const Quad& part) {
  Lanes sum(quad);
  sum += Lanes(part);
  sum.store(quad);
}
GRAIN_INLINE void operator-=(Quad& quad, const Quad& part) {
  Lanes difference(quad);
  difference -= Lanes(part);
  difference.store(quad);
}

/// The moving spheres that contacts push: forces on all others are 0, so that they fly straight on.
struct ActiveSpheres {
  std::int32_t* list;  ///< in any order
  std::size_t count;
  std::uint8_t* mark;  ///< pushed in this step: 2; in the one before: 1; neither, not listed: 0

  /// @pre a sphere of a wall has a mark > 0, so that it is never listed
  GRAIN_INLINE void push(std::size_t i) {
    if (mark[i] == 0) list[count++] = static_cast<std::int32_t>(i);
    mark[i] = 2;
  }
};

/// Arrays that contacts read of the spheres (moving, then those of walls) and add to.
struct SpaceView {
  const Quad* position;                        ///< w: the radius
  const Quad *velocity, *spin;                 ///< for dashpots; spin: null without rotation
  const double *inverseMass, *inverseInertia;  ///< 0 of walls
  Quad *force, *torque;
  ActiveSpheres active;
  /// Where there are several: the material of each, and the laws by two of them.
  const std::int32_t* material = nullptr;
  const GeneralLaw<double>* laws = nullptr;
  std::int32_t materials = 0;

  GRAIN_INLINE const GeneralLaw<double>& lawOf(std::size_t i, std::size_t j) const {
    return laws[material[i] * materials + material[j]];
  }
};

/// The last step's results for a pair that touched.
struct SpaceResult {
  double overlap = 0.0, normal = 0.0, sliding = 0.0;
  Vec3<double> tangential{}, rolling{};
};

/// Of CohesionLaw::jkr, or the elasto-plastic.
struct SpaceBond {
  double memory, rest;
};

/// Memory of contacts and the law's last results: of each kind one record a contact; null where the
/// law has no such.
struct SpaceContactView {
  Quad* touch;   ///< the normal of the last step in which it touched; w: the overlap then [m]
  Quad* spring;  ///< ξ
  Quad* angle;   ///< θ
  SpaceBond* bond;
  // Results of a step, which the next one does not need. Null, too, where none are asked for.
  double* force;  ///< f_n
  Quad* slide;    ///< f_t of friction; w: whether it slides
  Quad* rolling;  ///< the torque against rolling

  GRAIN_INLINE SpaceMemory<double> memory(std::size_t p) const {
    SpaceMemory<double> kept{.normal = vectorOf(touch[p])};
    if (spring != nullptr) kept.spring = vectorOf(spring[p]);
    if (angle != nullptr) kept.angle = vectorOf(angle[p]);
    if (bond == nullptr) return kept;
    kept.memory = bond[p].memory;
    kept.rest = bond[p].rest;
    return kept;
  }
  GRAIN_INLINE SpaceResult result(std::size_t p) const {
    SpaceResult result{.overlap = touch[p].w, .normal = force[p]};
    if (slide != nullptr) result.tangential = vectorOf(slide[p]);
    if (slide != nullptr) result.sliding = slide[p].w;
    if (rolling != nullptr) result.rolling = vectorOf(rolling[p]);
    return result;
  }
  /// @param overlap  [m]
  GRAIN_INLINE void remember(std::size_t p, const SpaceMemory<double>& kept, double overlap) const {
    touch[p] = quadOf(kept.normal, overlap);
    if (spring != nullptr) spring[p] = quadOf(kept.spring);
    if (angle != nullptr) angle[p] = quadOf(kept.angle);
    if (bond != nullptr) bond[p] = {kept.memory, kept.rest};
  }
  GRAIN_INLINE void set(std::size_t p, const SpaceMemory<double>& kept,
                        const SpaceResult& result) const {
    remember(p, kept, result.overlap);
    force[p] = result.normal;
    if (slide != nullptr) slide[p] = quadOf(result.tangential, result.sliding);
    if (rolling != nullptr) rolling[p] = quadOf(result.rolling);
  }
  SpaceContactView withoutResults() const {
    return {touch, spring, angle, bond, nullptr, nullptr, nullptr};
  }
};

/// Action of a pair on its spheres: the force on i, and torques about their own centres.
struct SpacePush {
  Quad force, torqueI, torqueJ;
};

/// A list of pairs, one entry each.
struct SpacePairs {
  std::size_t count;
  const std::int32_t *i, *j;
  const Quad* shifts;           ///< where images of j are that some i are near to, from j
  const std::int32_t* shiftOf;  ///< the entry of a pair
  /// The square of the distance within which it is looked at. One that touched is until that is
  /// over.
  double* within;
  SpaceContactView contacts;  ///< of those that touch; of others anything
  std::uint8_t* touches;      ///< whether it did in the last step
  /// Where a pair that touches leaves what it does, for others to add; null: it is added to both.
  SpacePush* pushes = nullptr;

  std::size_t first() const { return 0; }
  std::size_t last() const { return count; }
  GRAIN_INLINE const Quad& shift(std::size_t p) const {
    return shifts[static_cast<std::size_t>(shiftOf[p])];
  }
  /// @param reach  how far apart the centres may be in contact [m]
  GRAIN_INLINE void setTouches(std::size_t p, bool now, double reach) const {
    touches[p] = now;
    within[p] = now ? std::numeric_limits<double>::infinity() : reach * reach;
  }
};

/// A plane or a hollow cylinder at this instant, and spheres that may touch it, begin … end−1; of
/// its contacts one record a sphere.
struct SpacePlane {
  Vec3<double> point, normal;           ///< of a cylinder a point of the axis, and its direction
  double radius;                        ///< of a cylinder; 0: a plane
  Vec3<double> centre, velocity, spin;  ///< of its wall
  std::size_t body;                     ///< its number for SpaceView::lawOf()
  std::size_t begin, end;
  SpaceContactView contacts;
  std::uint8_t* touches;

  std::size_t first() const { return begin; }
  std::size_t last() const { return end; }
  /// How a sphere lies to it: of a cylinder the normal to the axis, the height R − s.
  struct Place {
    Vec3<double> normal;
    double height;
  };
  GRAIN_INLINE Place placeOf(const Quad& sphere) const {
    const Vec3<double> from = vectorOf(sphere) - point;
    const double along = dot(from, normal);
    if (!(radius > 0.0)) return {normal, along};
    const Vec3<double> aside = from - along * normal;
    const double distance = length(aside);
    // On the axis there is no normal, and contact only of a sphere as large as the cylinder.
    return {either(distance > 0.0, (-1.0 / distance) * aside, {}), radius - distance};
  }
  /// From the centre of the wall to where it meets a sphere [m].
  template <class L>
  GRAIN_INLINE Vec3<double> armTo(const L& law, const Quad& sphere, const Place& place) const {
    const double away = planePoint(law, sphere.w, place.height);
    return vectorOf(sphere) - away * place.normal - centre;
  }
  /// Of its point there [m/s].
  template <class L>
  GRAIN_INLINE Vec3<double> velocityAt(const L& law, const Quad& sphere, const Place& place) const {
    return velocity + cross(spin, armTo(law, sphere, place));
  }
};

struct SpaceReport {
  std::size_t touching = 0, active = 0;  ///< pairs; spheres listed by now
  bool deep = false;                     ///< some overlap is beyond what is allowed, or no number
};

/// @param range       how far apart bodies may be in contact [m]
/// @param maxOverlap  in units of the smaller radius
template <class Bodies>
using SpaceContactKernel = SpaceReport (*)(const GeneralLaw<double>&, const SpaceConventions&,
                                           const SpaceView&, const Bodies&, double range,
                                           double maxOverlap);

/// Contact kernels of spheres that meet, or of those at a plane.
template <class Bodies>
struct SpaceContactKernels {
  SpaceContactKernel<Bodies> own[contactVariants];  ///< as Kernels::contacts
  SpaceContactKernel<Bodies> general;
};

/// The spheres as their motion sees them. Without rotation spins and torques are null.
struct SpaceMotionView {
  Quad *position, *velocity, *spin;
  Quad *seenVelocity, *seenSpin;  ///< to be predicted; null: nothing is
  Quad *force, *torque;
  const double *inverseMass, *inverseInertia, *mass;
  const Quad* chosen;       ///< where the near pairs were chosen
  const double* allowance;  ///< how far a sphere may be from there [m]
  ActiveSpheres active;
  bool everyone;  ///< is active, whatever touches: something else pushes
};

struct SpaceMotionConstants {
  double kick, drift;  ///< v += kick·a, x += drift·v [s]
  double ahead;        ///< how far the dashpots' velocities are carried on [s]
  Vec3<double> gravity;
};

/// Extremes that a motion kernel saw on its way.
struct SpaceMotionReport {
  double excess = -1.0;    ///< > 0 if some sphere is beyond its allowance [m²]
  double squares = 0.0;    ///< not finite if some velocity or place is not
  double freeSteps = 1e9;  ///< for so many those that fly straight from here on have allowance left
  std::size_t active = 0;  ///< spheres listed by now
};

/// Moves spheres begin … end−1, of which the active ones are listed.
using SpaceMotionKernel = SpaceMotionReport (*)(const SpaceMotionConstants&, const SpaceMotionView&,
                                                std::size_t begin, std::size_t end);

/// How many are looked at side by side, so that some beyond the last may be.
inline constexpr std::size_t spareOfSorted = 8;

/// Spheres sorted by cells, inside the box.
struct SpaceCellsView {
  const Quad* place;  ///< w: the radius; with spares
  const std::int32_t* sorted;
  Quad length, half;  ///< of the box; 0 and infinite where it is not periodic
};

/// A neighbour, and by which image of it: (x + 1) + 3 (y + 1) + 9 (z + 1) of −1, 0 or 1 box each.
struct SpaceNeighbour {
  std::int32_t j, image;
};

/// Lists those of the sorted begin … end−1 that have numbers beyond i and the nearest image within
/// a_i + a_j + reach. @param found  with room for one more
using SpaceNeighbourKernel = std::size_t (*)(const SpaceCellsView&, const Quad& mine,
                                             std::int32_t i, std::size_t begin, std::size_t end,
                                             double reach, SpaceNeighbour* found);

/// Far pairs of spheres first … first + count − 1; those of first + k are begin[k] … begin[k +
/// 1]−1.
struct SpaceFarPairs {
  std::size_t first, count;
  const std::int32_t* begin;
  const SpaceNeighbour* pairs;
  const Quad* place;  ///< in the box, but for what they moved since; w: how far they reach
  const Quad* image;  ///< of the 27
};

struct SpaceChoice {
  std::int32_t i, pair;
};

/// Lists the far pairs that reach each other. @param found  with room for one more
using SpaceChoiceKernel = std::size_t (*)(const SpaceFarPairs&, SpaceChoice* found);

/// Kernels of laws of their own are under the usual SpaceConventions.
struct SpaceKernels {
  SpaceContactKernels<SpacePairs> pairs, materialPairs;
  SpaceContactKernels<SpacePlane> planes;  ///< of materials or of none
  SpaceMotionKernel motion;
  SpaceNeighbourKernel neighbours;
  SpaceChoiceKernel choose;
};
}  // namespace grain
