#include "studies/stability/in_space.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "adapters/grain_space.hpp"
#include "adapters/suitability.hpp"

namespace crossgrain::inline studies {
namespace {

using Turn = Eigen::Matrix3d;

/// No axis of the scene is along one of space, nor a bisector of two.
Turn anyTurn() {
  return Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
}

/// x, y and z become y, z and x, to the bit.
Turn alongAxes() {
  Turn turn;
  turn << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  return turn;
}

void turn(std::vector<Vec3>& vectors, const Turn& by) {
  for (Vec3& vector : vectors) vector = by * vector;
}

SpaceScene turned(SpaceScene scene, const Turn& by) {
  for (auto* vectors : {&scene.disks.position, &scene.disks.velocity, &scene.disks.spin})
    turn(*vectors, by);
  for (WallBodyOf<3>& body : scene.bodies) {
    turn(body.diskPosition, by);
    for (PlaneOf<3>& plane : body.planes) plane = {by * plane.point, by * plane.normal};
    for (Vec3* vector : {&body.centre, &body.motion.angularVelocity, &body.motion.velocity,
                         &body.motion.amplitude})
      *vector = by * *vector;
  }
  scene.gravity = by * scene.gravity;
  return scene;
}

SpaceSnapshot turned(SpaceSnapshot now, const Turn& by) {
  for (auto* vectors : {&now.position, &now.velocity, &now.wallPosition}) turn(*vectors, by);
  if (now.spin) turn(*now.spin, by);
  for (BodySnapshotOf<3>& body : now.bodies) {
    for (Vec3* vector : {&body.centre, &body.angle, &body.velocity, &body.angularVelocity})
      *vector = by * *vector;
    for (std::optional<Vec3>* load : {&body.force, &body.torque})
      if (*load) **load = by * **load;
  }
  if (now.contacts)
    for (auto* vectors :
         {&now.contacts->normal, &now.contacts->tangentialForce, &now.contacts->rollingTorque})
      turn(*vectors, by);
  return now;
}

class PlaneInSpace final : public Engine {
 public:
  explicit PlaneInSpace(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

  Capabilities capabilities() const override {
    Capabilities can = engine_->capabilities();
    can.dimensions = {2};
    can.energyLedger = false;
    return can;
  }

  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    const Capabilities can = engine_->capabilities();
    if (std::ranges::find(can.dimensions, 3) == can.dimensions.end())
      throw UnsupportedScene("has dimension = 2, not 3");
    if (scene.bottom) throw UnsupportedScene("has no bottom plate in space");
    if (scene.box) throw UnsupportedScene("has no box that lies across the axes of space");
    const bool axes = scene.planeCount() > 0 && can.limits.planesAlongAxes;
    turn_ = axes ? alongAxes() : anyTurn();
    radius_ = std::ranges::min(scene.disks.radius);
    SpaceScene there = turned(inSpace(scene), turn_);
    there.energyLedger = false;
    changeLaws(there, [&](ContactLaw& law) { law = lawAsRun(can, law); });
    return engine_->loadInSpace(there, settings);
  }

  double advance(double t) override { return engine_->advance(t); }

  Snapshot snapshot(ContactReport contacts) override {
    const SpaceSnapshot now = turned(engine_->snapshotInSpace(contacts), turn_.transpose());
    for (std::size_t k = 0; k < now.position.size(); ++k)
      if (!(std::abs(now.position[k].z()) <= leavesPlane * radius_))
        throw UnsupportedScene(
            fmt::format("has sphere {} off its plane by {:.2g} radii at t = {:g} s: from there on "
                        "the scene in space is another one",
                        k, std::abs(now.position[k].z()) / radius_, now.positionTime));
    Snapshot flat = inPlane(now);
    flat.energies = now.energies;
    return flat;
  }

  Stats stats() const override { return engine_->stats(); }
  void checkpoint(const std::filesystem::path& file) override { engine_->checkpoint(file); }
  void restore(const std::filesystem::path& file) override { engine_->restore(file); }

 private:
  std::unique_ptr<Engine> engine_;
  Turn turn_ = Turn::Identity();
  double radius_ = 0.0;  ///< the smallest [m]
};

}  // namespace

Scene ofSpheres(Scene scene) {
  Disks& disks = scene.disks;
  for (std::size_t k = 0; k < disks.size(); ++k)
    disks.inertia[k] = 0.4 * disks.mass[k] * disks.radius[k] * disks.radius[k];
  return scene;
}

std::unique_ptr<Engine> runInSpace(std::unique_ptr<Engine> engine) {
  return std::make_unique<PlaneInSpace>(std::move(engine));
}

}  // namespace crossgrain::inline studies
