#include "adapters/scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <stdexcept>

namespace crossgrain {

std::string toString(Precision precision) {
  return std::string(precisionNames[static_cast<std::size_t>(precision)]);
}

template <int D>
PlaneOf<D> planeAt(BodyStateOf<D> now, const std::type_identity_t<VecOf<D>>& referenceCentre,
                   const std::type_identity_t<PlaneOf<D>>& reference) {
  now.radialShift = 0.0;
  return {memberPosition<D>(now, referenceCentre, reference.point),
          turnedBy<D>(now.angle, reference.normal)};
}
template Plane planeAt<2>(BodyState, const Vec2&, const Plane&);
template PlaneOf<3> planeAt<3>(BodyStateOf<3>, const Vec3&, const PlaneOf<3>&);

PlaneOf<3> tangentPlane(const Cylinder& cylinder, const Vec3& place) {
  const Vec3 axis = cylinder.axis.normalized(), from = place - cylinder.point;
  const Vec3 aside = from - from.dot(axis) * axis;
  const double distance = aside.norm();
  const Vec3 outward = distance > 0.0 ? Vec3(aside / distance) : axis.unitOrthogonal();
  return {place - aside + cylinder.radius * outward, -outward};
}

namespace {

/// The number of members of a kind that all bodies have together.
template <int D>
std::size_t countOf(const SceneOf<D>& scene, auto WallBodyOf<D>::*members) {
  std::size_t count = 0;
  for (const WallBodyOf<D>& body : scene.bodies) count += (body.*members).size();
  return count;
}

}  // namespace

template <int D>
std::size_t SceneOf<D>::wallDiskCount() const {
  return countOf(*this, &WallBodyOf<D>::diskRadius);
}

template <int D>
std::size_t SceneOf<D>::planeCount() const {
  return countOf(*this, &WallBodyOf<D>::planes);
}

template <int D>
std::size_t SceneOf<D>::cylinderCount() const {
  return countOf(*this, &WallBodyOf<D>::cylinders);
}

template <int D>
std::size_t SceneOf<D>::idCount() const {
  return disks.size() + wallDiskCount() + planeCount() + cylinderCount();
}

template <int D>
std::vector<double> SceneOf<D>::radii() const {
  std::vector<double> all = disks.radius;
  for (const auto& body : bodies)
    all.insert(all.end(), body.diskRadius.begin(), body.diskRadius.end());
  return all;
}

template <int D>
const ContactLaw& SceneOf<D>::lawOf(std::size_t i, std::size_t j) const {
  if (!materials) return law;
  const auto materialOf = [&](std::size_t id) {
    if (id < disks.size()) return materials->ofDisk[id];
    std::size_t first = disks.size();  // of the next member of a body
    for (const int kind : {0, 1, 2})
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        first += kind == 0   ? bodies[b].diskRadius.size()
                 : kind == 1 ? bodies[b].planes.size()
                             : bodies[b].cylinders.size();
        if (id < first) return materials->ofBody[b];
      }
    throw std::out_of_range("an id that the scene does not have");
  };
  return materials->law(materialOf(i), materialOf(j));
}

template struct SceneOf<2>;
template struct SceneOf<3>;

Vec3 spinMomentum(const DisksOf<3>& spheres, std::size_t i, const Vec3& spin,
                  const TurnOf<3>* turn) {
  if (!turn || spheres.areRound()) return spheres.inertia[i] * spin;
  const Eigen::Matrix3d axes = matrixOf<3>(*turn);
  return axes * spheres.moments[i].cwiseProduct(axes.transpose() * spin);
}

double spinEnergy(const DisksOf<3>& spheres, std::size_t i, const Vec3& spin,
                  const TurnOf<3>* turn) {
  if (!turn || spheres.areRound()) return 0.5 * spheres.inertia[i] * spin.squaredNorm();
  return 0.5 * spin.dot(spinMomentum(spheres, i, spin, turn));
}

template <int D>
PlacedBody<D>::PlacedBody(const SceneOf<D>& scene, std::size_t disk, const VecOf<D>& position,
                          const TurnOf<D>& turn)
    : position_(position), turn_(turn) {
  if (scene.isConvex(disk))
    of_ = &scene.shapeOf(disk);
  else
    round_ = roundShape<D>(scene.disks.radius[disk]);
}
template class PlacedBody<2>;
template class PlacedBody<3>;

template <int D>
double overlapOfPair(const SceneOf<D>& scene, std::size_t i, std::size_t j, const VecOf<D>& apart,
                     const std::vector<TurnOf<D>>* turn) {
  const std::size_t disks = scene.disks.size();
  const auto radiusOf = [&](std::size_t id) {
    if (id < disks) return scene.disks.radius[id];
    id -= disks;
    for (const WallBodyOf<D>& body : scene.bodies) {
      if (id < body.diskRadius.size()) return body.diskRadius[id];
      id -= body.diskRadius.size();
    }
    throw std::out_of_range("no wall disk of the scene");
  };
  const bool moving = j < disks;
  if (!scene.isConvex(i) && !(moving && scene.isConvex(j)))
    return radiusOf(i) + radiusOf(j) - apart.norm();
  const std::vector<TurnOf<D>>& turns = turn ? *turn : scene.disks.turn;
  const PlacedBody<D> one(scene, i, apart, turns[i]);
  if (moving)
    return overlapOf<D>(one.get(), PlacedBody<D>(scene, j, VecOf<D>::Zero(), turns[j]).get());
  const ShapeOf<D> round = roundShape<D>(radiusOf(j));
  return overlapOf<D>(one.get(), {&round});
}
template double overlapOfPair<2>(const Scene&, std::size_t, std::size_t, const Vec2&,
                                 const std::vector<double>*);
template double overlapOfPair<3>(const SpaceScene&, std::size_t, std::size_t, const Vec3&,
                                 const std::vector<Eigen::Vector4d>*);

template <int D>
double overlapWithPlane(const SceneOf<D>& scene, std::size_t i, const VecOf<D>& position,
                        const PlaneOf<D>& plane, const std::vector<TurnOf<D>>* turn) {
  if (!scene.isConvex(i)) return scene.disks.radius[i] - (position - plane.point).dot(plane.normal);
  const TurnOf<D>& own = turn ? (*turn)[i] : scene.disks.turn[i];
  return depthBehind<D>(PlacedBody<D>(scene, i, position, own).get(), plane.point, plane.normal);
}
template double overlapWithPlane<2>(const Scene&, std::size_t, const Vec2&, const Plane&,
                                    const std::vector<double>*);
template double overlapWithPlane<3>(const SpaceScene&, std::size_t, const Vec3&, const PlaneOf<3>&,
                                    const std::vector<Eigen::Vector4d>*);

template <int D>
std::string nameOfId(const SceneOf<D>& scene, std::size_t id) {
  const char* const round = D == 2 ? "disk" : "sphere";
  const std::size_t disks = scene.disks.size();
  if (id < disks) {
    if (!scene.isConvex(id)) return fmt::format("{} {}", round, id);
    return fmt::format("{} {}", toString(scene.shapeOf(id).kind), id);
  }
  const std::size_t walls = disks + scene.wallDiskCount(), planes = walls + scene.planeCount();
  if (id < walls) return fmt::format("wall {} {}", round, id - disks);
  return id < planes ? fmt::format("plane {}", id - walls)
                     : fmt::format("cylinder {}", id - planes);
}
template std::string nameOfId<2>(const Scene&, std::size_t);
template std::string nameOfId<3>(const SpaceScene&, std::size_t);

}  // namespace crossgrain
