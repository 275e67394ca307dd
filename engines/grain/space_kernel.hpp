#pragma once

#include <type_traits>

#include "engines/grain/kernels.hpp"

namespace grain::space {

inline constexpr std::size_t blockSize = 128;
/// Of those that meet: what numbers of one kind are kept next to each other, and how many at least
/// go through the law side by side.
inline constexpr std::size_t meetingBlock = 64, lookedAt = 32, width = 8;

/// The linear law with a spring and dashpots, the everyday one, under conventions at run time: what
/// else a law may have is not compiled.
struct EverydayLaw : LawConstants<double>, LawOptions<double>, Conventions {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr Damper damper = Damper::constant;
  static constexpr TangentialLaw tangential = TangentialLaw::springDashpot;
  static constexpr bool normalDamping = true, rotation = true;
  static constexpr RollingLaw rolling = RollingLaw::none;
  static constexpr CohesionLaw cohesion = CohesionLaw::none;
  static constexpr LawConventions conventions{};

  explicit EverydayLaw(const GeneralLaw<double>& law)
      : LawConstants(law), LawOptions(law), Conventions(law) {}
};

GRAIN_INLINE double sumOfThree(const Lanes& lanes) {
  return lanes.v[0] + lanes.v[1] + lanes.v[2];
}

/// Finds the pairs of begin … end−1 that meet or touched before: they are few in a flow that is not
/// dense. A place that is no number is not skipped.
GRAIN_INLINE std::size_t findMeeting(const SpaceView& all, const SpacePairs& pairs,
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

/// Action of pair p on its spheres.
template <class L>
GRAIN_INLINE void push(const L& law, const SpaceView& all, ActiveSpheres& active,
                       const SpacePairs& pairs, std::size_t p, const SpacePush& force) {
  if (pairs.pushes != nullptr) {
    pairs.pushes[p] = force;
    return;
  }
  const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
  active.push(i);
  active.push(j);
  add(all.force[i], force.force, 1.0);
  add(all.force[j], force.force, -1.0);
  if (!law.rotation) return;
  add(all.torque[i], force.torqueI, 1.0);
  add(all.torque[j], force.torqueJ, 1.0);
}

/// The law of two spheres: of several materials theirs.
template <class L, bool OfMaterials>
GRAIN_INLINE std::conditional_t<OfMaterials, L, const L&> lawOfPair(const L& common,
                                                                    const SpaceView& all,
                                                                    std::size_t i, std::size_t j) {
  if constexpr (OfMaterials)
    return L(all.lawOf(i, j));
  else
    return common;
}

/// Of any law, pair by pair. Pairs that do not touch add nothing.
/// @tparam OfMaterials  each two spheres have a law of their own
template <class L, bool OfMaterials>
static SpaceReport pairKernel(const GeneralLaw<double>& general, const SpaceConventions& how,
                              const SpaceView& view, const SpacePairs& list, double range,
                              double maxOverlap) {
  const L common(general);
  const SpaceView all = view;  // copies that no store through a pointer can change
  const SpacePairs pairs = list;
  ActiveSpheres active = view.active;
  SpaceReport report;
  std::size_t near[blockSize];
  for (std::size_t begin = 0; begin < pairs.count; begin += blockSize) {
    const std::size_t end = smaller(begin + blockSize, pairs.count);
    const std::size_t found = findMeeting(all, pairs, begin, end, near);
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t p = near[k];
      const auto i = static_cast<std::size_t>(pairs.i[p]);
      const auto j = static_cast<std::size_t>(pairs.j[p]);
      const L& law = lawOfPair<L, OfMaterials>(common, all, i, j);
      const Vec3<double> d =
          vectorOf(all.position[i]) - vectorOf(all.position[j]) - vectorOf(pairs.shift(p));
      const double distance = length(d);
      const double overlap = all.position[i].w + all.position[j].w - distance;
      const Meeting<double> meeting = meetingOf(law, all, i, j, (1.0 / distance) * d, overlap);
      SpaceMemory<double> kept{};
      if (pairs.touches[p] != 0) kept = pairs.contacts.memory(p);
      bool touches = meeting.overlap > 0.0;
      if (law.cohesion == CohesionLaw::jkr) {
        const double radius =
            meeting.radiusI * meeting.radiusJ / (meeting.radiusI + meeting.radiusJ);
        kept.memory = isBonded(law, meeting.overlap, radius, kept.memory);
        touches = kept.memory > 0.0;
      }
      const double smallest = smaller(meeting.radiusI, meeting.radiusJ);
      if (!(meeting.overlap <= maxOverlap * smallest) || !(distance > 0.0)) report.deep = true;
      pairs.setTouches(p, touches, meeting.radiusI + meeting.radiusJ + range);
      if (!touches) continue;
      ++report.touching;
      const MeetingForce<double> force = meetingForce(law, how, meeting, kept);
      pairs.contacts.set(
          p, kept, {meeting.overlap, force.normal, force.sliding, force.tangential, force.rolling});
      push(law, all, active, pairs, p, {force.force, force.torqueI, force.torqueJ});
    }
  }
  report.active = active.count;
  return report;
}

/// Vectors of a few pairs, component by component.
struct Column {
  double x[meetingBlock], y[meetingBlock], z[meetingBlock];

  GRAIN_INLINE void set(std::size_t k, const Vec3<double>& v) {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
  GRAIN_INLINE Vec3<double> at(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

/// Pairs that meet, on their way through the law.
struct alignas(64) MeetingBlock {
  Column apart, velocity, spinI, spinJ, normal, spring, angle;
  double radiusI[meetingBlock], radiusJ[meetingBlock];
  double inverseMassI[meetingBlock], inverseMassJ[meetingBlock];
  double inverseInertiaI[meetingBlock], inverseInertiaJ[meetingBlock];
  Column force, tangential, rolling, torqueI, torqueJ;
  double overlap[meetingBlock], normalForce[meetingBlock], sliding[meetingBlock];
};

/// The same of a law that knows its effects and conventions, so that pairs are taken side by side:
/// the same arithmetic, to the bit. What the law has no use for is not gathered.
template <class L>
static SpaceReport contactKernel(const GeneralLaw<double>& general, const SpaceConventions&,
                                 const SpaceView& view, const SpacePairs& list, double range,
                                 double maxOverlap) {
  const L law(general);
  const bool friction = law.tangential != TangentialLaw::none,
             rolls = law.rolling != RollingLaw::none;
  const bool remembers = hasSprings(law) || law.rolling == RollingLaw::spring;
  const bool masses = seesMasses(law) || seesRollingInertia(law);
  const SpaceView all = view;  // copies that no store through a pointer can change
  const SpacePairs pairs = list;
  const SpaceContactView kept = pairs.contacts;
  ActiveSpheres active = view.active;
  SpaceReport report;
  std::size_t near[meetingBlock + width];
  MeetingBlock b;
  std::size_t found = 0;
  for (std::size_t begin = 0; begin < pairs.count; begin += lookedAt) {
    const bool last = begin + lookedAt >= pairs.count;
    found += findMeeting(all, pairs, begin, last ? pairs.count : begin + lookedAt, near + found);
    if (found == 0 || (!last && found + lookedAt <= meetingBlock)) continue;
    const std::size_t full = (found + width - 1) / width * width;
    for (std::size_t k = found; k < full; ++k) near[k] = near[found - 1];
    for (std::size_t k = 0; k < full; ++k) {
      const std::size_t p = near[k];
      const auto i = static_cast<std::size_t>(pairs.i[p]);
      const auto j = static_cast<std::size_t>(pairs.j[p]);
      b.apart.set(k,
                  vectorOf(all.position[i]) - vectorOf(all.position[j]) - vectorOf(pairs.shift(p)));
      if (law.normalDamping || friction)
        b.velocity.set(k, vectorOf(all.velocity[i]) - vectorOf(all.velocity[j]));
      if (law.rotation) {
        b.spinI.set(k, vectorOf(all.spin[i]));
        b.spinJ.set(k, vectorOf(all.spin[j]));
      }
      b.radiusI[k] = all.position[i].w;
      b.radiusJ[k] = all.position[j].w;
      if (masses) {
        b.inverseMassI[k] = all.inverseMass[i];
        b.inverseMassJ[k] = all.inverseMass[j];
        b.inverseInertiaI[k] = all.inverseInertia[i];
        b.inverseInertiaJ[k] = all.inverseInertia[j];
      }
      const bool touched = pairs.touches[p] != 0;
      if (remembers) b.normal.set(k, touched ? kept.touch[p].normal : Vec3<double>{});
      if (hasSprings(law)) b.spring.set(k, touched ? kept.spring[p] : Vec3<double>{});
      if (law.rolling == RollingLaw::spring)
        b.angle.set(k, touched ? kept.angle[p] : Vec3<double>{});
    }
#pragma GCC ivdep
    for (std::size_t k = 0; k < full; ++k) {
      const Vec3<double> apart = b.apart.at(k);
      const double distance = length(apart);
      Meeting<double> meeting{};
      meeting.normal = (1.0 / distance) * apart;
      if (law.normalDamping || friction) meeting.velocity = b.velocity.at(k);
      meeting.radiusI = b.radiusI[k];
      meeting.radiusJ = b.radiusJ[k];
      meeting.overlap = meeting.radiusI + meeting.radiusJ - distance;
      if (law.rotation) {
        meeting.spinI = b.spinI.at(k);
        meeting.spinJ = b.spinJ.at(k);
        meeting.leverI = armOf(law.lever, meeting.radiusI, meeting.radiusJ, meeting.overlap);
        meeting.leverJ = armOf(law.lever, meeting.radiusJ, meeting.radiusI, meeting.overlap);
        meeting.armI = armOf(law.velocityLever, meeting.radiusI, meeting.radiusJ, meeting.overlap);
        meeting.armJ = armOf(law.velocityLever, meeting.radiusJ, meeting.radiusI, meeting.overlap);
      }
      if (masses) {
        meeting.inverseMassI = b.inverseMassI[k];
        meeting.inverseMassJ = b.inverseMassJ[k];
        meeting.inverseMass = b.inverseMassI[k] + b.inverseMassJ[k];
        meeting.inverseInertiaI = b.inverseInertiaI[k];
        meeting.inverseInertiaJ = b.inverseInertiaJ[k];
      }
      SpaceMemory<double> memory{};
      if (remembers) memory.normal = b.normal.at(k);
      if (hasSprings(law)) memory.spring = b.spring.at(k);
      if (law.rolling == RollingLaw::spring) memory.angle = b.angle.at(k);
      const MeetingForce<double> force = meetingForce(law, SpaceConventions{}, meeting, memory);
      b.normal.set(k, meeting.normal);
      b.force.set(k, force.force);
      b.overlap[k] = meeting.overlap;
      b.normalForce[k] = force.normal;
      if (friction) {
        b.tangential.set(k, force.tangential);
        b.sliding[k] = force.sliding;
      }
      if (hasSprings(law)) b.spring.set(k, memory.spring);
      if (law.rotation) {
        b.torqueI.set(k, force.torqueI);
        b.torqueJ.set(k, force.torqueJ);
      }
      if (rolls) b.rolling.set(k, force.rolling);
      if (law.rolling == RollingLaw::spring) b.angle.set(k, memory.angle);
    }
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t p = near[k];
      const double smallest = smaller(b.radiusI[k], b.radiusJ[k]);
      if (!(b.overlap[k] <= maxOverlap * smallest) || !(b.overlap[k] < b.radiusI[k] + b.radiusJ[k]))
        report.deep = true;
      pairs.setTouches(p, b.overlap[k] > 0.0, b.radiusI[k] + b.radiusJ[k] + range);
      if (!(b.overlap[k] > 0.0)) continue;
      ++report.touching;
      kept.touch[p] = {b.normal.at(k), b.overlap[k], b.normalForce[k]};
      if (friction) kept.slide[p] = {b.tangential.at(k), b.sliding[k]};
      if (hasSprings(law)) kept.spring[p] = b.spring.at(k);
      if (rolls) kept.rolling[p] = b.rolling.at(k);
      if (law.rolling == RollingLaw::spring) kept.angle[p] = b.angle.at(k);
      SpacePush force{b.force.at(k), {}, {}};
      if (law.rotation) force = {b.force.at(k), b.torqueI.at(k), b.torqueJ.at(k)};
      push(law, all, active, pairs, p, force);
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
  /// x_i − x_j − shift to the nearest image.
  GRAIN_INLINE void reduce(Lanes& apart, const Lanes& length) const {
    const Whole sides = reinterpret_cast<Whole>(length.v);
    apart.v -= reinterpret_cast<Lanes::Four>(up & sides);
    apart.v += reinterpret_cast<Lanes::Four>(down & sides);
  }
  GRAIN_INLINE std::int32_t number() const {
    const Whole weights{1, 3, 9, 0}, each = (up & weights) - (down & weights);
    return static_cast<std::int32_t>(13 + each[0] + each[1] + each[2]);
  }
};

static inline std::size_t neighbourKernel(const SpaceCellsView& view, const Quad& mine,
                                          std::int32_t i, std::size_t begin, std::size_t end,
                                          double reach, SpaceNeighbour* found) {
  const SpaceCellsView cells = view;
  const Lanes own(mine), length(cells.length), half(cells.half);
  std::size_t count = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const Quad& other = cells.place[k];
    Lanes apart = own;
    apart -= Lanes(other);
    const Images images(apart, half);
    images.reduce(apart, length);
    apart.v *= apart.v;
    const double within = mine.w + other.w + reach;
    found[count].j = static_cast<std::int32_t>(k);
    count += sumOfThree(apart) < within * within && cells.sorted[k] > i;
  }
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
