#pragma once

#include <type_traits>

#include "engines/grain/kernels.hpp"

namespace grain::space {

/// Of those that meet: how many are kept next to each other, and how many at least go through the
/// law side by side.
inline constexpr std::size_t meetingBlock = 64, lookedAt = 32, width = 8;

GRAIN_INLINE double sumOfThree(const Lanes& lanes) {
  return lanes.v[0] + lanes.v[1] + lanes.v[2];
}

/// Finds the pairs of begin … end−1 that meet or touched before: they are few in a flow that is not
/// dense. A place that is no number is not skipped.
GRAIN_INLINE std::size_t findMeeting(const SpaceView& all, const SpacePairs& pairs, double,
                                     std::size_t begin, std::size_t end, std::size_t* meeting) {
  std::size_t found = 0;
  for (std::size_t p = begin; p < end; ++p) {
    Lanes d(all.position[static_cast<std::size_t>(pairs.i[p])]);
    d -= Lanes(all.position[static_cast<std::size_t>(pairs.j[p])]);
    d -= Lanes(pairs.shift(p));
    d.v *= d.v;
    meeting[found] = p;
    found += !(sumOfThree(d) >= pairs.within[p]);  // no branch
  }
  return found;
}

/// The same of spheres at a plane, which few reach.
GRAIN_INLINE std::size_t findMeeting(const SpaceView& all, const SpacePlane& plane, double range,
                                     std::size_t begin, std::size_t end, std::size_t* meeting) {
  double overlap[lookedAt];
  const Quad* const position = all.position + begin;
#pragma GCC ivdep
  for (std::size_t k = 0; k < end - begin; ++k)
    overlap[k] = position[k].w - plane.placeOf(position[k]).height;
  std::size_t found = 0;
  for (std::size_t k = 0; k < end - begin; ++k) {
    meeting[found] = begin + k;
    found += overlap[k] > -range || plane.touches[begin + k] != 0;
  }
  return found;
}

/// Bodies that meet, on their way through the law. A vector is a row, which moves as one; the law
/// takes rows apart.
struct alignas(64) MeetingBlock {
  Quad apart[meetingBlock];     ///< x_i − x_j, at a plane the normal; w: a_i; then the force on i
  Quad velocity[meetingBlock];  ///< of i relative to j; w: a_j, at a plane the height; then f_t
  Quad spinI[meetingBlock], spinJ[meetingBlock];  ///< then torques
  Quad touch[meetingBlock], spring[meetingBlock], angle[meetingBlock], rolling[meetingBlock];
  double memory[meetingBlock], rest[meetingBlock];
  double inverseMassI[meetingBlock], inverseMassJ[meetingBlock];
  double inverseInertiaI[meetingBlock], inverseInertiaJ[meetingBlock];
  double normalForce[meetingBlock];
};

/// With the constants of each two bodies. @see forPairConstants
struct MaterialBlock : MeetingBlock {
  double constants[pairConstants][meetingBlock];
};
template <class L>
using BlockOf = std::conditional_t<HasMaterials<L>, MaterialBlock, MeetingBlock>;

/// Gathers what the law uses of a pair.
template <class L>
GRAIN_INLINE void gather(const L& law, const SpaceView& all, const SpacePairs& pairs, std::size_t p,
                         std::size_t k, MeetingBlock& b) {
  const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
  const Lanes placeI(all.position[i]), placeJ(all.position[j]);
  Lanes apart = placeI, velocity = placeJ;
  apart -= placeJ;
  apart -= Lanes(pairs.shift(p));
  apart.withLast(placeI).store(b.apart[k]);
  if (law.normalDamping || law.tangential != TangentialLaw::none || remembersRest(law)) {
    velocity = Lanes(all.velocity[i]);
    velocity -= Lanes(all.velocity[j]);
  }
  velocity.withLast(placeJ).store(b.velocity[k]);
  if (law.rotation) {
    Lanes(all.spin[i]).store(b.spinI[k]);
    Lanes(all.spin[j]).store(b.spinJ[k]);
  }
  if (seesMasses(law) || seesRollingInertia(law)) {
    b.inverseMassI[k] = all.inverseMass[i];
    b.inverseMassJ[k] = all.inverseMass[j];
    if (law.rotation) {
      b.inverseInertiaI[k] = all.inverseInertia[i];
      b.inverseInertiaJ[k] = all.inverseInertia[j];
    }
  }
}
template <class L>
GRAIN_INLINE void gather(const L& law, const SpaceView& all, const SpacePlane& plane, std::size_t i,
                         std::size_t k, MeetingBlock& b) {
  const Quad& sphere = all.position[i];
  const SpacePlane::Place place = plane.placeOf(sphere);
  b.apart[k] = quadOf(place.normal, sphere.w);
  b.velocity[k] =
      quadOf(vectorOf(all.velocity[i]) - plane.velocityAt(law, sphere, place), place.height);
  if (law.rotation) b.spinI[k] = all.spin[i];
  b.inverseMassI[k] = all.inverseMass[i];
  if (law.rotation) b.inverseInertiaI[k] = all.inverseInertia[i];
}

GRAIN_INLINE const GeneralLaw<double>& lawOf(const GeneralLaw<double>&, const SpaceView& all,
                                             const SpacePairs& pairs, std::size_t p) {
  return all.lawOf(static_cast<std::size_t>(pairs.i[p]), static_cast<std::size_t>(pairs.j[p]));
}
GRAIN_INLINE const GeneralLaw<double>& lawOf(const GeneralLaw<double>& common, const SpaceView& all,
                                             const SpacePlane& plane, std::size_t i) {
  return all.laws == nullptr ? common : all.lawOf(i, plane.body);
}

/// How two that meet lie to each other.
template <class L>
GRAIN_INLINE void place(const L& law, const MeetingBlock& b, std::size_t k, const SpacePairs&,
                        Meeting<double>& meeting) {
  const Vec3<double> apart = vectorOf(b.apart[k]);
  const double distance = length(apart);
  meeting.normal = (1.0 / distance) * apart;
  meeting.radiusI = b.apart[k].w;
  meeting.radiusJ = b.velocity[k].w;
  meeting.overlap = meeting.radiusI + meeting.radiusJ - distance;
  if (law.rotation) {
    meeting.spinI = vectorOf(b.spinI[k]);
    meeting.spinJ = vectorOf(b.spinJ[k]);
    setArms(law, meeting);
  }
  if (seesMasses(law) || seesRollingInertia(law)) {
    meeting.inverseMassI = b.inverseMassI[k];
    meeting.inverseMassJ = b.inverseMassJ[k];
    if (law.rotation) {
      meeting.inverseInertiaI = b.inverseInertiaI[k];
      meeting.inverseInertiaJ = b.inverseInertiaJ[k];
    }
  }
}
template <class L>
GRAIN_INLINE void place(const L& law, const MeetingBlock& b, std::size_t k, const SpacePlane&,
                        Meeting<double>& meeting) {
  const double height = b.velocity[k].w;
  meeting.normal = vectorOf(b.apart[k]);
  meeting.radiusI = b.apart[k].w;
  meeting.overlap = meeting.radiusI - height;
  if (law.rotation) {
    meeting.spinI = vectorOf(b.spinI[k]);
    setArms(law, meeting, height);
    meeting.inverseInertiaI = b.inverseInertiaI[k];
  }
  meeting.inverseMassI = b.inverseMassI[k];
}

/// Whether one is not deeper in the other than is allowed, which no number is.
GRAIN_INLINE bool isWithin(double maxOverlap, const Meeting<double>& meeting, const SpacePairs&) {
  return meeting.overlap <= maxOverlap * smaller(meeting.radiusI, meeting.radiusJ) &&
         meeting.overlap < meeting.radiusI + meeting.radiusJ;
}
GRAIN_INLINE bool isWithin(double maxOverlap, const Meeting<double>& meeting, const SpacePlane&) {
  return meeting.overlap <= maxOverlap * meeting.radiusI;
}

GRAIN_INLINE void setTouches(const SpaceView& all, const SpacePairs& pairs, double range,
                             std::size_t p, bool now) {
  const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
  if (now != (pairs.touches[p] != 0))
    pairs.setTouches(p, now, all.position[i].w + all.position[j].w + range);
}
GRAIN_INLINE void setTouches(const SpaceView&, const SpacePlane& plane, double, std::size_t i,
                             bool now) {
  plane.touches[i] = now;
}

/// Action of pair p on its spheres.
GRAIN_INLINE void push(bool turns, const SpaceView& all, ActiveSpheres& active,
                       const SpacePairs& pairs, std::size_t p, const MeetingBlock& b,
                       std::size_t k) {
  if (pairs.pushes != nullptr) {
    pairs.pushes[p].force = b.apart[k];
    if (!turns) return;
    pairs.pushes[p].torqueI = b.spinI[k];
    pairs.pushes[p].torqueJ = b.spinJ[k];
    return;
  }
  const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
  active.push(i);
  active.push(j);
  all.force[i] += b.apart[k];
  all.force[j] -= b.apart[k];
  if (!turns) return;
  all.torque[i] += b.spinI[k];
  all.torque[j] += b.spinJ[k];
}
/// A plane pushes each sphere. @see Spheres::everyone_
GRAIN_INLINE void push(bool turns, const SpaceView& all, ActiveSpheres&, const SpacePlane&,
                       std::size_t i, const MeetingBlock& b, std::size_t k) {
  all.force[i] += b.apart[k];
  if (turns) all.torque[i] += b.spinI[k];
}

/// Contacts are taken in blocks: find those that meet, gather what the law sees of them, apply it
/// side by side where it is known to the compiler, then scatter the forces in the order of the
/// list. Bodies that do not touch add nothing.
template <class L, class Bodies>
static SpaceReport contactKernel(const GeneralLaw<double>& general, const SpaceConventions& given,
                                 const SpaceView& view, const Bodies& list, double range,
                                 double maxOverlap) {
  const L common(general);
  SpaceConventions how;
  if constexpr (DecidedAtRunTime<L>) how = given;
  const bool friction = common.tangential != TangentialLaw::none,
             rolls = common.rolling != RollingLaw::none, turns = common.rotation;
  const bool remembersAngle = common.rolling == RollingLaw::spring;
  const bool remembersNormal = hasSprings(common) || remembersAngle;
  const SpaceView all = view;  // copies that no store through a pointer can change
  const Bodies bodies = list;
  const SpaceContactView kept = bodies.contacts;
  ActiveSpheres active = view.active;
  SpaceReport report;
  std::size_t near[meetingBlock + width];
  BlockOf<L> b;
  std::size_t found = 0;
  for (std::size_t begin = bodies.first(); begin < bodies.last(); begin += lookedAt) {
    const bool last = begin + lookedAt >= bodies.last();
    found += findMeeting(all, bodies, range, begin, last ? bodies.last() : begin + lookedAt,
                         near + found);
    if (found == 0 || (!last && found + lookedAt <= meetingBlock)) continue;
    const std::size_t full = (found + width - 1) / width * width;
    for (std::size_t k = found; k < full; ++k) near[k] = near[found - 1];
    for (std::size_t k = 0; k < full; ++k) {
      const std::size_t p = near[k];
      gather(common, all, bodies, p, k, b);
      if constexpr (HasMaterials<L>) {
        const GeneralLaw<double>& own = lawOf(general, all, bodies, p);
        forPairConstants(common, [&](std::size_t which, auto member)
                                     GRAIN_INLINE_LAMBDA { b.constants[which][k] = own.*member; });
      }
      const bool touched = bodies.touches[p] != 0;
      const Quad none{};
      if (remembersNormal) b.touch[k] = touched ? kept.touch[p] : none;
      if (hasSprings(common)) b.spring[k] = touched ? kept.spring[p] : none;
      if (remembersAngle) b.angle[k] = touched ? kept.angle[p] : none;
      if (remembers(common)) {
        b.memory[k] = touched ? kept.bond[p].memory : 0.0;
        b.rest[k] = touched ? kept.bond[p].rest : 0.0;
      }
    }
    std::int64_t deep = 0;
#pragma GCC ivdep
    for (std::size_t k = 0; k < full; ++k) {
      const L& law = lawOfPair(common, b, k);
      Meeting<double> meeting{};
      place(law, b, k, bodies, meeting);
      meeting.velocity = vectorOf(b.velocity[k]);
      meeting.inverseMass = meeting.inverseMassI + meeting.inverseMassJ;
      SpaceMemory<double> memory{};
      if (remembersNormal) memory.normal = vectorOf(b.touch[k]);
      if (hasSprings(law)) memory.spring = vectorOf(b.spring[k]);
      if (remembersAngle) memory.angle = vectorOf(b.angle[k]);
      if (remembers(law)) {
        memory.memory = b.memory[k];
        memory.rest = b.rest[k];
      }
      if (law.cohesion == CohesionLaw::jkr)
        memory.memory =
            isBonded(law, meeting.overlap, motionOf(law, meeting).radius, memory.memory);
      const MeetingForce<double> force = meetingForce(law, how, meeting, memory);
      deep += isWithin(maxOverlap, meeting, bodies) ? 0 : 1;
      b.touch[k] = quadOf(meeting.normal, meeting.overlap);
      b.apart[k] = quadOf(force.force);
      b.normalForce[k] = force.normal;
      if (friction) b.velocity[k] = quadOf(force.tangential, force.sliding);
      if (hasSprings(law)) b.spring[k] = quadOf(memory.spring);
      if (turns) {
        b.spinI[k] = quadOf(force.torqueI);
        b.spinJ[k] = quadOf(force.torqueJ);
      }
      if (rolls) b.rolling[k] = quadOf(force.rolling);
      if (remembersAngle) b.angle[k] = quadOf(memory.angle);
      if (remembers(law)) {
        b.memory[k] = memory.memory;
        b.rest[k] = memory.rest;
      }
    }
    report.deep |= deep > 0;
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t p = near[k];
      const bool touches =
          common.cohesion == CohesionLaw::jkr ? b.memory[k] > 0.0 : b.touch[k].w > 0.0;
      setTouches(all, bodies, range, p, touches);
      if (!touches) continue;
      ++report.touching;
      kept.touch[p] = b.touch[k];
      if (hasSprings(common)) kept.spring[p] = b.spring[k];
      if (remembersAngle) kept.angle[p] = b.angle[k];
      if (remembers(common)) kept.bond[p] = {b.memory[k], b.rest[k]};
      if (kept.force != nullptr) {
        kept.force[p] = b.normalForce[k];
        if (friction) kept.slide[p] = b.velocity[k];
        if (rolls) kept.rolling[p] = b.rolling[k];
      }
      push(turns, all, active, bodies, p, b, k);
    }
    found = 0;
  }
  report.active = active.count;
  return report;
}

/// The step of motion of one sphere, in parts.
struct Mover {
  const SpaceMotionConstants c;
  const SpaceMotionView s;
  SpaceMotionReport report{};

  /// v += kick·a, u = v + ahead·a; then the new force begins with gravity.
  GRAIN_INLINE void kick(std::size_t i) const {
    Lanes a(s.force[i]), v(s.velocity[i]), force(c.gravity);
    const bool predicts = s.seenVelocity != nullptr;
    a.v *= s.inverseMass[i];
    v.v += c.kick * a.v;
    v.store(s.velocity[i]);
    if (predicts) {
      v.v += c.ahead * a.v;
      v.store(s.seenVelocity[i]);
    }
    force.v *= s.mass[i];
    force.store(s.force[i]);
    if (s.spin == nullptr) return;
    Lanes spinUp(s.torque[i]), spin(s.spin[i]);
    spinUp.v *= s.inverseInertia[i];
    spin.v += c.kick * spinUp.v;
    spin.store(s.spin[i]);
    if (predicts) {
      spin.v += c.ahead * spinUp.v;
      spin.store(s.seenSpin[i]);
    }
    s.torque[i] = {};
  }
  /// x += drift·v
  GRAIN_INLINE void drift(std::size_t i) const {
    Lanes x(s.position[i]), v(s.velocity[i]);
    x.v += c.drift * v.v;
    x.store(s.position[i]);
  }
  /// @return how far it is from where pairs were chosen, squared [m²]
  GRAIN_INLINE double look(std::size_t i) {
    Lanes moved(s.chosen[i]);
    moved -= Lanes(s.position[i]);
    moved.v *= moved.v;
    const double square = sumOfThree(moved);
    report.excess = larger(report.excess, square - s.allowance[i] * s.allowance[i]);
    report.squares += square;
    return square;
  }
  GRAIN_INLINE void release(std::size_t i, double square) {
    Lanes way(s.velocity[i]);
    way.v *= way.v;
    const double step = c.drift * squareRoot(sumOfThree(way));
    const double left = s.allowance[i] - squareRoot(square);
    if (left < report.freeSteps * step) report.freeSteps = left / step;
  }
};

/// Spheres that nothing pushes fly straight on, which takes neither forces nor a look at how far
/// they came.
static inline SpaceMotionReport motionKernel(const SpaceMotionConstants& constants,
                                             const SpaceMotionView& view, std::size_t begin,
                                             std::size_t end) {
  Mover mover{constants, view};
  if (view.everyone) {
    for (std::size_t i = begin; i < end; ++i) {
      mover.kick(i);
      mover.drift(i);
      mover.look(i);
    }
    mover.report.active = view.active.count;
    return mover.report;
  }
  const ActiveSpheres active = view.active;
  for (std::size_t k = 0; k < active.count; ++k)
    mover.kick(static_cast<std::size_t>(active.list[k]));
  for (std::size_t i = begin; i < end; ++i) mover.drift(i);
  std::size_t left = 0;
  for (std::size_t k = 0; k < active.count; ++k) {
    const auto i = static_cast<std::size_t>(active.list[k]);
    const double square = mover.look(i);
    active.list[left] = active.list[k];
    left += --active.mark[i] != 0;
    if (active.mark[i] == 0) mover.release(i, square);
  }
  mover.report.active = left;
  return mover.report;
}

/// Which components of x_i − x_j are beyond half a box, up or down.
struct Images {
  typedef std::int64_t Whole __attribute__((vector_size(32)));
  Whole up, down;

  GRAIN_INLINE Images(const Lanes& apart, const Lanes& half)
      : up(apart.v > half.v), down(apart.v < -half.v) {}
  GRAIN_INLINE std::int32_t number() const {
    const Whole weights{1, 3, 9, 0}, each = (up & weights) - (down & weights);
    return static_cast<std::int32_t>(13 + each[0] + each[1] + each[2]);
  }
};

/// A component of x_i − x_j − shift to the nearest image.
GRAIN_INLINE double nearest(double apart, double length, double half) {
  return apart - (apart > half ? length : 0.0) + (apart < -half ? length : 0.0);
}

static inline std::size_t neighbourKernel(const SpaceCellsView& view, const Quad& mine,
                                          std::int32_t i, std::size_t begin, std::size_t end,
                                          double reach, SpaceNeighbour* found) {
  const SpaceCellsView cells = view;
  const Quad box = cells.length, sides = cells.half;
  std::size_t count = 0;
  for (std::size_t first = begin; first < end; first += spareOfSorted) {
    const Quad* const place = cells.place + first;
    double room[spareOfSorted];
#pragma GCC ivdep
    for (std::size_t k = 0; k < spareOfSorted; ++k) {
      const Vec3<double> apart = {nearest(mine.x - place[k].x, box.x, sides.x),
                                  nearest(mine.y - place[k].y, box.y, sides.y),
                                  nearest(mine.z - place[k].z, box.z, sides.z)};
      const double within = mine.w + place[k].w + reach;
      room[k] = within * within - dot(apart, apart);
    }
    const std::size_t some = smaller(spareOfSorted, end - first);
    for (std::size_t k = 0; k < some; ++k) {
      found[count].j = static_cast<std::int32_t>(first + k);
      count += room[k] > 0.0 && cells.sorted[first + k] > i;
    }
  }
  const Lanes own(mine), half(cells.half);
  for (std::size_t n = 0; n < count; ++n) {
    const auto k = static_cast<std::size_t>(found[n].j);
    Lanes apart = own;
    apart -= Lanes(cells.place[k]);
    found[n] = {cells.sorted[k], Images(apart, half).number()};
  }
  return count;
}

static inline std::size_t chooseKernel(const SpaceFarPairs& view, SpaceChoice* found) {
  const SpaceFarPairs far = view;
  std::size_t count = 0;
  for (std::size_t row = 0; row < far.count; ++row) {
    const std::size_t i = far.first + row;
    const Lanes own(far.place[i]);
    const double reach = far.place[i].w;
    for (std::int32_t k = far.begin[row]; k < far.begin[row + 1]; ++k) {
      const SpaceNeighbour& pair = far.pairs[k];
      const Quad& other = far.place[pair.j];
      Lanes apart = own;
      apart -= Lanes(other);
      apart -= Lanes(far.image[pair.image]);
      apart.v *= apart.v;
      const double within = reach + other.w;
      found[count] = {static_cast<std::int32_t>(i), k};
      count += sumOfThree(apart) < within * within;
    }
  }
  return count;
}

}  // namespace grain::space
