#include "studies/core/in_space.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adapters/grain_space.hpp"
#include "law/law_options.hpp"

namespace crossgrain::inline studies {
namespace {

using Turn = Eigen::Matrix3d;

/// Options of a law in space alone.
constexpr std::array optionsOfSpace = {"spring_turn", "spring_twist"};

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

/// Flags of axes after a turn that takes axes to axes.
std::array<bool, 3> turned(const std::array<bool, 3>& along, const Turn& by) {
  std::array<bool, 3> to{};
  for (int k = 0; k < 3; ++k)
    for (int from = 0; from < 3; ++from)
      if (by(k, from) == 1.0)
        to[static_cast<std::size_t>(k)] = along[static_cast<std::size_t>(from)];
  return to;
}

SpaceScene turned(SpaceScene scene, const Turn& by) {
  for (auto* vectors : {&scene.disks.position, &scene.disks.velocity, &scene.disks.spin})
    turn(*vectors, by);
  if (scene.box)
    for (Vec3* corner : {&scene.box->low, &scene.box->high}) *corner = by * *corner;
  for (WallBodyOf<3>& body : scene.bodies) {
    turn(body.diskPosition, by);
    for (PlaneOf<3>& plane : body.planes) plane = {by * plane.point, by * plane.normal};
    for (Vec3* vector : {&body.centre, &body.motion.angularVelocity, &body.motion.velocity,
                         &body.motion.amplitude})
      *vector = by * *vector;
  }
  if (scene.box) scene.box->periodic = turned(scene.box->periodic, by);
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

/// The scene at z = 0; a box is there as deep as it is wide.
SpaceScene raisedScene(const Scene& scene, const Capabilities& can) {
  if (scene.bottom) throw UnsupportedScene("has no bottom plate in space");
  SpaceScene there = inSpace(scene);
  if (there.box) {
    const double half = 0.5 * (there.box->high.x() - there.box->low.x());
    there.box->low.z() = -half;
    there.box->high.z() = half;
  }
  changeLaws(there, [&](ContactLaw& law) {
    for (const char* option : optionsOfSpace)
      if (const auto has = can.lawOptions.find(option); has != can.lawOptions.end())
        setLawOption(law, option, has->second.front());
  });
  return there;
}

class PlaneInSpace final : public Engine {
 public:
  PlaneInSpace(std::unique_ptr<Engine> engine, PlaneFrame frame)
      : engine_(std::move(engine)), frame_(frame) {}

  Capabilities capabilities() const override {
    Capabilities can = engine_->capabilities();
    can.dimensions = {2};
    can.energyLedger = false;
    for (const Effect effect : {Effect::bottomFriction, Effect::bottomSpinFriction})
      can.effects[effect] = Support::never;
    for (const char* option : optionsOfSpace) can.lawOptions.erase(option);
    return can;
  }

  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    const Capabilities can = engine_->capabilities();
    if (std::ranges::find(can.dimensions, 3) == can.dimensions.end())
      throw UnsupportedScene("has dimension = 2, not 3");
    if (!scene.shapes.empty()) throw UnsupportedScene("has no convex bodies in a plane of space");
    const bool axes = scene.box || (scene.planeCount() > 0 && can.limits.planesAlongAxes);
    turn_ = frame_ == PlaneFrame::flat ? Turn(Turn::Identity()) : axes ? alongAxes() : anyTurn();
    radius_ = scene.disks.size() > 0 ? std::ranges::min(scene.disks.radius) : 1.0;
    SpaceScene there = turned(raisedScene(scene, can), turn_);
    there.energyLedger = false;
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
  PlaneFrame frame_;
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

std::unique_ptr<Engine> runInSpace(std::unique_ptr<Engine> engine, PlaneFrame frame) {
  return std::make_unique<PlaneInSpace>(std::move(engine), frame);
}

}  // namespace crossgrain::inline studies
