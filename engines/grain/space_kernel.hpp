#pragma once

#include "engines/grain/kernels.hpp"

namespace grain::space {

inline constexpr std::size_t blockSize = 128;

/// Pairs that do not touch add nothing. Those that do are found first, a block at a time, since
/// they are few in a flow that is not dense.
template <class L>
static SpaceReport pairKernel(const GeneralLaw<double>& general, const SpaceConventions& how,
                              const SpaceView& view, const SpacePairs& list, double range,
                              double maxOverlap) {
  const L law(general);
  const SpaceView all = view;  // copies that no store through a pointer can change
  const SpacePairs pairs = list;
  SpaceReport report;
  std::size_t near[blockSize];
  for (std::size_t begin = 0; begin < pairs.count; begin += blockSize) {
    const std::size_t end = begin + blockSize < pairs.count ? begin + blockSize : pairs.count;
    std::size_t found = 0;
    for (std::size_t p = begin; p < end; ++p) {
      const Quad& a = all.position[static_cast<std::size_t>(pairs.i[p])];
      const Quad& b = all.position[static_cast<std::size_t>(pairs.j[p])];
      Lanes d(a);
      d -= Lanes(b);
      d -= Lanes(pairs.shift[p]);
      d.v *= d.v;
      const double reach = a.w + b.w + range;
      // Those that touched before are looked at once more, to forget it. A place that is no number
      // is not skipped.
      const bool apart = d.v[0] + d.v[1] + d.v[2] >= reach * reach;
      near[found] = p;
      found += !apart || pairs.touches[p] != 0;
    }
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t p = near[k];
      const auto i = static_cast<std::size_t>(pairs.i[p]);
      const auto j = static_cast<std::size_t>(pairs.j[p]);
      const Vec3<double> d =
          vectorOf(all.position[i]) - vectorOf(all.position[j]) - vectorOf(pairs.shift[p]);
      const double distance = length(d);
      const double overlap = all.position[i].w + all.position[j].w - distance;
      const Meeting<double> meeting = meetingOf(law, all, i, j, (1.0 / distance) * d, overlap);
      SpaceMemory<double>& kept = pairs.kept[p];
      bool touches = meeting.overlap > 0.0;
      if (law.cohesion == Cohesion::jkr) {
        const double radius =
            meeting.radiusI * meeting.radiusJ / (meeting.radiusI + meeting.radiusJ);
        kept.memory = isBonded(law, meeting.overlap, radius, kept.memory);
        touches = kept.memory > 0.0;
      }
      const double smallest = smaller(meeting.radiusI, meeting.radiusJ);
      if (!(meeting.overlap <= maxOverlap * smallest) || !(distance > 0.0)) report.deep = true;
      pairs.touches[p] = touches;
      if (!touches) {
        kept = {};
        continue;
      }
      ++report.touching;
      const MeetingForce<double> force = meetingForce(law, how, meeting, kept);
      pairs.results[p] = {meeting.overlap, force.normal, force.sliding, force.tangential,
                          force.rolling};
      add(all.force[i], force.force, 1.0);
      add(all.force[j], force.force, -1.0);
      if (!law.rotation) continue;
      add(all.torque[i], force.torqueI, 1.0);
      add(all.torque[j], force.torqueJ, 1.0);
    }
  }
  return report;
}

/// v += kick·a, x += drift·v, u = v + ahead·a; then the new forces begin with gravity.
static inline SpaceMotionReport motionKernel(const SpaceMotionConstants& constants,
                                             const SpaceMotionView& view, std::size_t count) {
  const SpaceMotionConstants c = constants;
  const SpaceMotionView s = view;
  const Lanes gravity(quadOf(c.gravity));
  SpaceMotionReport report;
  const bool predicts = s.seenVelocity != nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    Lanes a(s.force[i]), v(s.velocity[i]), x(s.position[i]), moved(s.chosen[i]), force = gravity;
    a.v *= s.inverseMass[i];
    v.v += c.kick * a.v;
    v.store(s.velocity[i]);
    x.v += c.drift * v.v;
    x.store(s.position[i]);
    moved.v -= x.v;
    moved.v *= moved.v;
    const double square = moved.v[0] + moved.v[1] + moved.v[2];
    report.excess = larger(report.excess, square - s.allowance[i]);
    report.squares += square;
    if (predicts) {
      v.v += c.ahead * a.v;
      v.store(s.seenVelocity[i]);
    }
    force.v *= s.mass[i];
    force.store(s.force[i]);
    if (s.spin == nullptr) continue;
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
  return report;
}

}  // namespace grain::space
