#include "stability/transform.hpp"

#include <gsl/gsl_randist.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "support/random.hpp"

namespace crossgrain::inline stability {

double Units::of(int l, int m, int t) const {
  return std::pow(length, l) * std::pow(mass, m) * std::pow(time, t);
}

namespace {

/// γ in the units of what its damper multiplies it with.
double damperUnit(Damper damper, const Units& units) {
  switch (damper) {
    case Damper::constant:
      return units.of(0, 1, -1);
    case Damper::viscoelastic:
      return units.of(0, 0, 1);
    case Damper::critical:
      break;
  }
  return 1.0;
}

template <int D>
MotionOf<D> inUnits(MotionOf<D> motion, const Units& units) {
  motion.angularVelocity *= units.of(0, 0, -1);
  motion.velocity *= units.of(1, 0, -1);
  motion.amplitude *= units.length;
  motion.frequency *= units.of(0, 0, -1);
  motion.radialVelocity *= units.of(1, 0, -1);
  motion.radialEnd *= units.time;
  return motion;
}

}  // namespace

ContactLaw inUnits(ContactLaw law, const Units& units) {
  const double stiffness = units.of(0, 1, -2), modulus = units.of(-1, 1, -2);
  law.kn *= law.stiffens() ? modulus : stiffness;
  law.kn3 *= units.of(-2, 1, -2);
  law.kt *= law.normal == NormalLaw::hertz ? modulus : stiffness;
  law.gn *= damperUnit(law.damper, units);
  law.gt *= damperUnit(law.damper, units);
  const LawConventions& how = law.conventions;
  const bool perAngle = how.rollingStiffness == RollingStiffness::constant;  // [N m]
  law.kr *= perAngle ? units.of(2, 1, -2) : stiffness;
  const bool ratio =
      law.rolling == RollingLaw::spring && how.rollingDamper == RollingDamper::critical;
  law.gr *= ratio ? 1.0 : units.of(0, 1, -1);
  if (law.rolling == RollingLaw::viscousByLoad) law.muR *= units.of(-1, 0, 1);
  law.kc *= law.cohesion == CohesionLaw::area ? modulus : stiffness;
  law.w *= stiffness;  // J/m² is N/m
  law.kUnload *= stiffness;
  return law;
}

template <int D>
SceneOf<D> inUnits(SceneOf<D> scene, const Units& units) {
  const double speed = units.of(1, 0, -1), rate = units.of(0, 0, -1);
  DisksOf<D>& disks = scene.disks;
  for (double& radius : disks.radius) radius *= units.length;
  for (double& mass : disks.mass) mass *= units.mass;
  for (double& inertia : disks.inertia) inertia *= units.of(2, 1, 0);
  for (VecOf<D>& position : disks.position) position *= units.length;
  for (VecOf<D>& velocity : disks.velocity) velocity *= speed;
  for (SpinOf<D>& spin : disks.spin) spin *= rate;
  for (Vec3& moments : disks.moments) moments *= units.of(2, 1, 0);
  for (ShapeOf<D>& shape : scene.shapes) {
    for (VecOf<D>& vertex : shape.vertices) vertex *= units.length;
    shape.rounding *= units.length;
  }
  for (WallBodyOf<D>& body : scene.bodies) {
    body.centre *= units.length;
    for (VecOf<D>& position : body.diskPosition) position *= units.length;
    for (double& radius : body.diskRadius) radius *= units.length;
    for (PlaneOf<D>& plane : body.planes) plane.point *= units.length;
    for (Cylinder& cylinder : body.cylinders) {
      cylinder.point *= units.length;
      cylinder.radius *= units.length;
    }
    body.motion = inUnits(body.motion, units);
  }
  changeLaws(scene, [&](ContactLaw& law) { law = inUnits(law, units); });
  if (scene.bottom) {
    scene.bottom->kb *= units.of(0, 1, -2);
    scene.bottom->gb *= units.of(0, 1, -1);
    scene.bottom->gravity *= units.of(1, 0, -2);
  }
  if (scene.box) {
    scene.box->low *= units.length;
    scene.box->high *= units.length;
  }
  scene.gravity *= units.of(1, 0, -2);
  scene.dt *= units.time;
  return scene;
}

namespace {

/// −1 of a mirrored scene, whose angular velocities are the opposite of turned ones.
double handedness(const Placement& placement) {
  return placement.mirror ? -1.0 : 1.0;
}

/// By thirds of a turn to the bit.
Vec3 turnedAboutDiagonal(const Vec3& v, double turn) {
  const double thirds = turn / (2.0 / 3.0 * std::numbers::pi), whole = std::round(thirds);
  if (std::abs(thirds - whole) <= 1e-15 * std::abs(thirds)) {
    const int k = (static_cast<int>(whole) % 3 + 3) % 3;
    return {v[(3 - k) % 3], v[(4 - k) % 3], v[(5 - k) % 3]};
  }
  return Eigen::AngleAxisd(turn, Vec3::Ones().normalized()) * v;
}

}  // namespace

Vec3 placedDirection(const Placement& placement, const Vec3& direction) {
  const double x = handedness(placement) * direction.x();
  return turnedAboutDiagonal({x, direction.y(), direction.z()}, placement.turn);
}

Vec3 directionBack(const Placement& placement, const Vec3& direction) {
  const Vec3 before = turnedAboutDiagonal(direction, -placement.turn);
  return {handedness(placement) * before.x(), before.y(), before.z()};
}

namespace {

/// As what a direction along axis k becomes lies along an axis; −1: along none.
template <int D>
int axisOf(const Placement& placement, int k) {
  const VecOf<D> turned = placedDirection(placement, VecOf<D>(VecOf<D>::Unit(k)));
  for (int to = 0; to < D; ++to)
    if (std::abs(turned[to]) == 1.0) return to;
  return -1;
}

}  // namespace

template <int D>
bool turnsBox(const Placement& placement) {
  return axisOf<D>(placement, 0) >= 0;
}
template bool turnsBox<2>(const Placement&);
template bool turnsBox<3>(const Placement&);

template <int D>
SceneOf<D> placed(SceneOf<D> scene, const Placement& placement) {
  const auto turn = [&](VecOf<D>& vector) { vector = placedDirection(placement, vector); };
  const auto spun = [&](SpinOf<D>& spin) {
    if constexpr (D == 3) turn(spin);
    spin *= handedness(placement);
  };
  std::ranges::for_each(scene.disks.position, turn);
  std::ranges::for_each(scene.disks.velocity, turn);
  std::ranges::for_each(scene.disks.spin, spun);
  for (WallBodyOf<D>& body : scene.bodies) {
    turn(body.centre);
    std::ranges::for_each(body.diskPosition, turn);
    for (PlaneOf<D>& plane : body.planes) {
      turn(plane.point);
      turn(plane.normal);
    }
    if constexpr (D == 3)
      for (Cylinder& cylinder : body.cylinders) {
        turn(cylinder.point);
        turn(cylinder.axis);
      }
    turn(body.motion.velocity);
    turn(body.motion.amplitude);
    spun(body.motion.angularVelocity);
  }
  turn(scene.gravity);
  if (scene.box) {
    const BoxOf<D> box = *scene.box;
    const VecOf<D> one = placedDirection(placement, box.low),
                   other = placedDirection(placement, box.high);
    scene.box->low = one.cwiseMin(other);
    scene.box->high = one.cwiseMax(other);
    for (int k = 0; k < D; ++k)
      scene.box->periodic[static_cast<std::size_t>(axisOf<D>(placement, k))] =
          box.periodic[static_cast<std::size_t>(k)];
  }
  return scene;
}
template Scene placed<2>(Scene, const Placement&);
template SpaceScene placed<3>(SpaceScene, const Placement&);

template <int D>
SceneOf<D> renumbered(SceneOf<D> scene, const std::vector<std::size_t>& order) {
  scene.disks.forEachList([&](auto& list) {
    const auto from = list;
    if (!from.empty())
      for (std::size_t k = 0; k < order.size(); ++k) list[k] = from[order[k]];
  });
  if (scene.materials) {
    const std::vector<std::int32_t> ofDisk = scene.materials->ofDisk;
    for (std::size_t k = 0; k < order.size(); ++k) scene.materials->ofDisk[k] = ofDisk[order[k]];
  }
  return scene;
}

template Scene inUnits<2>(Scene, const Units&);
template SpaceScene inUnits<3>(SpaceScene, const Units&);
template Scene renumbered<2>(Scene, const std::vector<std::size_t>&);
template SpaceScene renumbered<3>(SpaceScene, const std::vector<std::size_t>&);

template <int D>
SceneOf<D> transformed(const SceneOf<D>& scene, const Transform& by) {
  return renumbered(inUnits(placed(scene, by.placement), by.units), by.order);
}
template Scene transformed<2>(const Scene&, const Transform&);
template SpaceScene transformed<3>(const SpaceScene&, const Transform&);

namespace {

std::size_t placeOf(const Transform& by, std::size_t k) {
  return by.order.empty() ? k : by.order[k];
}

}  // namespace

template <int D>
std::vector<VecOf<D>> placesBack(const Transform& by, const std::vector<VecOf<D>>& position) {
  std::vector<VecOf<D>> places(position.size());
  for (std::size_t k = 0; k < position.size(); ++k)
    places[placeOf(by, k)] = directionBack(by.placement, VecOf<D>(position[k] / by.units.length));
  return places;
}
template std::vector<Vec2> placesBack<2>(const Transform&, const std::vector<Vec2>&);
template std::vector<Vec3> placesBack<3>(const Transform&, const std::vector<Vec3>&);

template <int D>
std::vector<SpinOf<D>> spinsBack(const Transform& by, const std::vector<SpinOf<D>>& spin) {
  std::vector<SpinOf<D>> spins(spin.size());
  const double unit = handedness(by.placement) * by.units.time;
  for (std::size_t k = 0; k < spin.size(); ++k) {
    SpinOf<D>& back = spins[placeOf(by, k)];
    back = unit * spin[k];
    if constexpr (D == 3) back = directionBack(by.placement, back);
  }
  return spins;
}
template std::vector<double> spinsBack<2>(const Transform&, const std::vector<double>&);
template std::vector<Vec3> spinsBack<3>(const Transform&, const std::vector<Vec3>&);

std::vector<std::size_t> shuffledOrder(std::size_t disks, std::uint64_t seed) {
  std::vector<std::size_t> order(disks);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (disks < 2) return order;
  const Random random = seededRandom(seed);
  while (std::ranges::is_sorted(order))  // of few disks a shuffle may be none
    gsl_ran_shuffle(random.get(), order.data(), order.size(), sizeof(std::size_t));
  return order;
}

template <int D>
DisksOf<D> nudged(DisksOf<D> disks, double epsilon, std::uint64_t seed) {
  const Random random = seededRandom(seed);
  const auto either = [&] { return gsl_rng_uniform_int(random.get(), 2) == 0 ? 1.0 : -1.0; };
  const auto nudge = [&](VecOf<D>& vector, double by) {
    for (int k = 0; k < D; ++k) vector[k] += either() * by;
  };
  for (std::size_t i = 0; i < disks.size(); ++i) {
    nudge(disks.position[i], epsilon * (disks.position[i].norm() + disks.radius[i]));
    nudge(disks.velocity[i], epsilon * disks.velocity[i].norm());
    if constexpr (D == 2)
      disks.spin[i] += either() * epsilon * std::abs(disks.spin[i]);
    else
      nudge(disks.spin[i], epsilon * disks.spin[i].norm());
  }
  return disks;
}
template Disks nudged<2>(Disks, double, std::uint64_t);
template DisksOf<3> nudged<3>(DisksOf<3>, double, std::uint64_t);

template <int D>
double extentOf(const SceneOf<D>& scene) {
  double extent = 0.0;
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    extent = std::max(extent, scene.disks.position[i].norm() + scene.disks.radius[i]);
  for (const WallBodyOf<D>& body : scene.bodies) {
    for (const VecOf<D>& position : body.diskPosition) extent = std::max(extent, position.norm());
    for (const PlaneOf<D>& plane : body.planes) extent = std::max(extent, plane.point.norm());
    for (const Cylinder& cylinder : body.cylinders)
      extent = std::max(extent, cylinder.point.norm() + cylinder.radius);
  }
  return extent;
}
template double extentOf<2>(const Scene&);
template double extentOf<3>(const SpaceScene&);

}  // namespace crossgrain::inline stability
