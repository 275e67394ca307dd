#include "studies/collide/convex.hpp"

#include <fmt/format.h>

namespace crossgrain::inline studies {

ConvexOutcomes convexOutcomes(const Case& setup, const CollisionStart& start) {
  return inDimensionOf(setup, [&]<int D>() {
    const ConvexTouchOf<D> touch = convexTouch<D>(setup, start);
    const ConvexImpactStart<D>& before = touch.impact;
    const ConvexImpact<D> impact = convexImpact(before);
    const auto end = [&](const ImpactOutcome<D>& after) {
      return convexEnd<D>(before, after.velocity, after.spin);
    };
    const auto name = [](const ImpactOutcome<D>& after) {
      return std::string(impactKindNames[static_cast<std::size_t>(after.kind)]);
    };
    ConvexOutcomes all{{},
                       end(impact.poisson),
                       end(impact.stronge),
                       impact.judged,
                       "",
                       freeFlight(touch, impact, start.vn)};
    if (impact.newton) all.newton = end(*impact.newton);
    all.kind = name(impact.poisson);
    if (name(impact.stronge) != all.kind) all.kind += " or " + name(impact.stronge);
    return all;
  });
}

template <int D>
std::optional<CollisionEnd> convexEndOf(const Case& setup, const SnapshotOf<D>& after,
                                        std::size_t pair, const CollisionStart& start) {
  const Collision& c = collisionIn(setup);
  const ConvexTouchOf<D> touch = convexTouch<D>(setup, start);
  const std::size_t count = touch.bodies.size();
  std::array<VecOf<D>, 2> velocity = {VecOf<D>::Zero(), VecOf<D>::Zero()};
  std::array<SpinOf<D>, 2> spin = {noSpin<D>(), noSpin<D>()};
  for (std::size_t side = 0; side < count; ++side) {
    const std::size_t i = count * pair + side;
    velocity[side] = after.velocity[i];
    if (after.spin) spin[side] = (*after.spin)[i];
    if constexpr (D == 3) {
      const Eigen::Matrix3d back = turnOf(setup).transpose();
      velocity[side] = back * velocity[side];
      spin[side] = back * spin[side];
    }
    if (c.wall) velocity[side].template head<2>() -= c.wallVelocity;
  }
  // By an impulse of as little as this of m v_n nothing has met.
  constexpr double least = 1e-3;
  if (velocity[0].x() - touch.bodies.velocity[0].x() < least * start.vn) return std::nullopt;
  return convexEnd<D>(touch.impact, velocity, spin);
}
template std::optional<CollisionEnd> convexEndOf<2>(const Case&, const Snapshot&, std::size_t,
                                                    const CollisionStart&);
template std::optional<CollisionEnd> convexEndOf<3>(const Case&, const SpaceSnapshot&, std::size_t,
                                                    const CollisionStart&);

std::vector<double> Collision::*sweptList(const Collision& collision) {
  for (const auto list : {&Collision::orientation, &Collision::psi, &Collision::spin})
    if ((collision.*list).size() > 1) return list;
  return &Collision::psi;
}

namespace {

/// "box that reaches 0.0707 m, 1 kg"
template <int D>
std::string describe(const DiskGroupOf<D>& body) {
  return fmt::format("{} that reaches {:.4g} m, {:g} kg",
                     body.shape ? toString(body.shape->kind)
                     : D == 2   ? "disk"
                                : "sphere",
                     body.radius, body.mass);
}

}  // namespace

ConvexSweep convexSweep(const Case& setup, const std::vector<CollisionStart>& starts,
                        const OracleCurve& fine, const OracleCurve& sweep) {
  const Collision& c = collisionIn(setup);
  ConvexSweep convex;
  convex.bodies = inDimensionOf(setup, [&]<int D>() {
    const auto& pair = std::get<ConvexPairOf<D>>(c.convex);
    return describe(pair.body[0]) + (c.wall ? " on a plane" : " on a " + describe(pair.body[1]));
  });
  const auto list = sweptList(c);
  convex.axis = list == &Collision::orientation ? "orientation"
                : list == &Collision::psi       ? "psi_i"
                                                : "spin_before";
  Outcomes poisson, stronge;
  for (const ConvexOutcomes& each : fine.convex) {
    poisson.emplace_back(outcomeOf(each.poisson));
    stronge.emplace_back(outcomeOf(each.stronge));
  }
  convex.poisson = tableOf(starts, poisson, true);
  convex.stronge = tableOf(starts, stronge, true);
  for (const ConvexOutcomes& each : sweep.convex) convex.kinds.push_back(each.kind);
  return convex;
}

}  // namespace crossgrain::inline studies
