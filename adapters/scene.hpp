#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/motion.hpp"
#include "adapters/shape.hpp"
#include "adapters/vec2.hpp"
#include "law/contact_law.hpp"

namespace crossgrain {

/// The moving disks, or spheres in space, structure of arrays, all of one length N; ids are 0 …
/// N−1. Among them there may be convex bodies, whose radius is that of the circle or sphere about
/// their centre of mass that holds them.
template <int D>
struct DisksOf {
  std::vector<double> radius;      ///< [m]
  std::vector<double> mass;        ///< [kg]
  std::vector<double> inertia;     ///< moment of inertia about the centre, q m a² [kg m²]
  std::vector<VecOf<D>> position;  ///< [m]
  std::vector<VecOf<D>> velocity;  ///< [m/s]
  std::vector<SpinOf<D>> spin;     ///< ω, laboratory frame [rad/s]
  // Empty where all are round.
  std::vector<std::int32_t> shape = {};  ///< index into SceneOf::shapes; −1: a disk, or sphere
  std::vector<TurnOf<D>> turn = {};      ///< orientation
  std::vector<VecOf<3>> moments = {};    ///< in space: of inertia, about the body's axes [kg m²]

  bool areRound() const { return shape.empty(); }
  std::size_t size() const { return radius.size(); }
  /// Of every kind of list, also those that are empty.
  void forEachList(auto&& visit) {
    for (auto* const each : {&radius, &mass, &inertia}) visit(*each);
    for (auto* const each : {&position, &velocity}) visit(*each);
    visit(spin);
    visit(shape);
    visit(turn);
    visit(moments);
  }
};
using Disks = DisksOf<2>;

/// A straight wall: the half plane, or half space, behind `point`; `normal` points into the free
/// side.
template <int D>
struct PlaneOf {
  VecOf<D> point = VecOf<D>::Zero();  ///< [m]
  VecOf<D> normal = VecOf<D>::UnitY();
};
using Plane = PlaneOf<2>;

/// Where a plane given at t = 0 is by now: it shifts and turns with its body, about the body's
/// centre at t = 0. Those of radial bodies stay.
template <int D>
PlaneOf<D> planeAt(BodyStateOf<D> now, const std::type_identity_t<VecOf<D>>& referenceCentre,
                   const std::type_identity_t<PlaneOf<D>>& reference);

/// A hollow circular cylinder without ends, in space: spheres are inside. Its body stands still or
/// turns about its axis, so that the surface stays where it is and only its velocity is ω × r.
struct Cylinder {
  Vec3 point = Vec3::Zero();  ///< of its axis [m]
  Vec3 axis = Vec3::UnitZ();  ///< along it, of length 1
  double radius = 0.0;        ///< [m]
};

/// The plane that touches a cylinder where it is nearest to a place. A sphere with its centre there
/// meets both alike: n points to the axis, and δ = a − (R − s) with s the distance from the axis.
PlaneOf<3> tangentPlane(const Cylinder& cylinder, const Vec3& place);

/// A rigid body of wall disks, plane walls and cylinders that moves as prescribed, whatever pushes
/// on it.
template <int D>
struct WallBodyOf {
  std::string name;                    ///< "wheel", "ring", …
  VecOf<D> centre = VecOf<D>::Zero();  ///< at t = 0; angle and torque are about it [m]
  std::vector<VecOf<D>> diskPosition;  ///< at t = 0 [m]
  std::vector<double> diskRadius;      ///< [m]
  std::vector<PlaneOf<D>> planes;
  MotionOf<D> motion;
  std::vector<Cylinder> cylinders = {};  ///< of space alone
};
using WallBody = WallBodyOf<2>;

/// A cell that space is filled with: along each periodic direction everything is there again at
/// every multiple of its length, and what leaves at one side comes in at the other. Along others it
/// bounds nothing. A snapshot's positions need not be in it; engines leave paths whole.
template <int D>
struct BoxOf {
  VecOf<D> low = VecOf<D>::Zero(), high = VecOf<D>::Zero();  ///< corners [m]
  std::array<bool, D> periodic{};                            ///< along x, y (, z)

  /// Of the images of a difference of two places, the shortest.
  VecOf<D> nearest(VecOf<D> difference) const {
    return shifted(difference, [](double of) { return std::round(of); });
  }
  /// Of the images of a place, that in the box.
  VecOf<D> wrapped(const VecOf<D>& place) const {
    return low + shifted(place - low, [](double of) { return std::floor(of); });
  }

 private:
  VecOf<D> shifted(VecOf<D> x, auto&& images) const {
    for (int k = 0; k < D; ++k)
      if (periodic[static_cast<std::size_t>(k)])
        x[k] -= (high[k] - low[k]) * images(x[k] / (high[k] - low[k]));
    return x;
  }
};

/// The floating-point numbers that an engine steps with.
enum class Precision { float64, float32 };

/// As in case files and reports, in enum order.
inline constexpr std::array<std::string_view, 2> precisionNames = {"double", "float"};
std::string toString(Precision precision);

/// Bodies of several materials: the contact law of each two of them.
struct Materials {
  std::vector<std::string> names;    ///< "glass", "steel", …
  std::vector<std::int32_t> ofDisk;  ///< index into names, of each disk
  std::vector<std::int32_t> ofBody;  ///< of each wall body: its disks, planes and cylinders
  /// Of materials a and b at a · (number of materials) + b; symmetric. They differ in constants
  /// alone: options, conventions and the effects that they call for are those of Scene::law.
  std::vector<ContactLaw> laws;

  const ContactLaw& law(std::int32_t a, std::int32_t b) const {
    return laws[static_cast<std::size_t>(a) * names.size() + static_cast<std::size_t>(b)];
  }

  bool operator==(const Materials&) const = default;
};

/// One granular scene: everything an engine needs, plain data in SI units, laboratory frame.
/// Ids: disks 0 … N−1, then the wall disks body by body, then the planes, then the cylinders.
template <int D>
struct SceneOf {
  std::string name;
  DisksOf<D> disks;
  std::vector<ShapeOf<D>> shapes;  ///< of convex bodies among the disks
  std::vector<WallBodyOf<D>> bodies;
  ContactLaw law;                       ///< of all pairs
  std::optional<Materials> materials;   ///< instead, where pairs differ
  std::optional<BottomPlate> bottom;    ///< of the plane alone
  std::optional<BoxOf<D>> box;          ///< absent: no direction is periodic
  VecOf<D> gravity = VecOf<D>::Zero();  ///< in the plane, or in space [m/s²]
  bool rotation = true;                 ///< false: friction acts, but no spin changes; all are zero
  Precision precision = Precision::float64;
  double dt = 0.0;            ///< time step [s]
  bool energyLedger = false;  ///< whether engines that can are to keep Snapshot::ledger, at a cost

  std::size_t wallDiskCount() const;
  std::size_t planeCount() const;
  std::size_t cylinderCount() const;
  std::size_t idCount() const;  ///< of all that contacts can be of
  /// Of a pair by their ids; what `law` is where all pairs are alike.
  const ContactLaw& lawOf(std::size_t i, std::size_t j) const;
  std::vector<double> radii() const;  ///< of the disks, then of the wall disks [m]
  bool isConvex(std::size_t disk) const { return !disks.areRound() && disks.shape[disk] >= 0; }
  /// @pre isConvex(disk)
  const ShapeOf<D>& shapeOf(std::size_t disk) const {
    return shapes[static_cast<std::size_t>(disks.shape[disk])];
  }
};
using Scene = SceneOf<2>;
using SpaceScene = SceneOf<3>;

/// Does the same to the law of all pairs.
template <int D>
void changeLaws(SceneOf<D>& scene, auto&& change) {
  change(scene.law);
  if (scene.materials)
    for (ContactLaw& law : scene.materials->laws) change(law);
}

/// Of the spin of a body in space about its centre of mass [J].
/// @param turn  its orientation; null of a sphere
double spinEnergy(const DisksOf<3>& spheres, std::size_t i, const Vec3& spin,
                  const TurnOf<3>* turn);

/// J ω of it, laboratory frame [kg m²/s].
Vec3 spinMomentum(const DisksOf<3>& spheres, std::size_t i, const Vec3& spin,
                  const TurnOf<3>* turn);

/// A body of the scene where it is; a disk or sphere is one vertex with its radius around it.
/// @param position, turn  of its centre of mass [m], and its orientation
template <int D>
class PlacedBody {
 public:
  PlacedBody(const SceneOf<D>& scene, std::size_t disk, const VecOf<D>& position,
             const TurnOf<D>& turn);
  PlacedShapeOf<D> get() const { return {of_ ? of_ : &round_, position_, turn_}; }

 private:
  const ShapeOf<D>* of_ = nullptr;
  ShapeOf<D> round_;
  VecOf<D> position_;
  TurnOf<D> turn_;
};

/// Depth by which two bodies of the scene overlap, or a body and a wall disk [m]; < 0: their
/// distance.
/// @param apart  from the centre of j to that of i [m]
/// @param turn   orientations; those of the scene's start if null
template <int D>
double overlapOfPair(const SceneOf<D>& scene, std::size_t i, std::size_t j, const VecOf<D>& apart,
                     const std::vector<TurnOf<D>>* turn = nullptr);

/// The same of a body and a plane.
template <int D>
double overlapWithPlane(const SceneOf<D>& scene, std::size_t i, const VecOf<D>& position,
                        const PlaneOf<D>& plane, const std::vector<TurnOf<D>>* turn = nullptr);

/// "disk 3", "wall disk 12", "plane 0", "cylinder 0": what an id is, each kind counted from 0; in
/// space "sphere 3"; of convex bodies "polygon 3".
template <int D>
std::string nameOfId(const SceneOf<D>& scene, std::size_t id);

}  // namespace crossgrain
