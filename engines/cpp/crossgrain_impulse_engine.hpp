#pragma once

// All that a worker of rigid contacts and impulses answers, given a space that steps and reports
// its impulses; engines/node/impulse_engine.mjs is the same in JavaScript.
//
//     serve(ImpulseEngine(about, [](const ImpulseScene& scene) {
//       return std::make_unique<MySpace>(scene);
//     }));

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "crossgrain_impulse_sums.hpp"
#include "crossgrain_rigid_pairs.hpp"

namespace crossgrain_worker {

/// A number's entry in `settings`.
inline Json setting(const char* name, double value, const char* unit, const char* doc) {
  return {
      {"name", name}, {"default", value}, {"unit", unit}, {"doc", doc}, {"choices", Json::array()}};
}

inline Json within(Json setting, double least, double most, bool whole) {
  setting.update({{"least", least}, {"most", most}, {"whole", whole}});
  return setting;
}

/// What an engine says of itself.
struct ImpulseAbout {
  std::string name, version, integrator;
  /// By how many steps a velocity that is shown is later than the motion that had it: 1/2 where
  /// velocities change first, −1/2 where positions do.
  double lag;
  /// Where forces act: lever_arm, velocity_arm, plane_arm; and `rolling`, of those that have it.
  Json lawOptions;
  Json settings;  ///< `dt` among them
};

class ImpulseEngine {
 public:
  using MakeSpace = std::function<std::unique_ptr<ImpulseSpace>(const ImpulseScene&)>;

  ImpulseEngine(ImpulseAbout about, MakeSpace make)
      : about_(std::move(about)), make_(std::move(make)) {}

  Json capabilities() const {
    Json effects;
    for (const char* name : {"normal_damping", "friction", "rotation", "gravity", "moving_walls"})
      effects[name] = "optional";
    if (about_.lawOptions.contains("rolling")) effects["rolling_resistance"] = "optional";
    Json options = about_.lawOptions;
    options["normal"] = {"rigid"};
    return {{"version", about_.version},       {"effects", effects},
            {"law_options", options},          {"precisions", {"double"}},
            {"instant_contacts", true},        {"accumulated_contacts", true},
            {"warm_handover", false},          {"sliding_flags", false},
            {"tangential_restitution", false}, {"settings", about_.settings}};
  }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    if (scene.contains("bottom") && scene.at("bottom").at("mu") > 0.0)
      throw Unsupported("has no bottom_friction");
    const RigidLaw law(scene.at("law"));
    const auto number = [this, settings](const char* name) {
      for (const Json& each : about_.settings)
        if (each.at("name") == name) return settings.value(name, each.at("default").get<double>());
      throw std::logic_error(name);
    };
    dt_ = number("dt") > 0.0 ? number("dt") : scene.at("dt").get<double>();
    steps_ = StepCount(dt_);
    evaluations_ = 0;
    disks_ = scene.at("disks");
    radius_ = arrays.at("disks.radius");
    friction_ = law.friction() > 0.0;
    rolls_ = law.rolling() > 0.0 && scene.at("rotation").get<bool>();
    rotation_ = (friction_ || rolls_) && scene.at("rotation").get<bool>();
    space_.reset();
    loadWalls(scene, arrays);
    pairs_ = RigidPairs(law, arrays.at("disks.mass"), radius_);
    const auto end = radius_.begin() + static_cast<long>(disks_);
    const double smallest = disks_ > 0 ? *std::min_element(radius_.begin(), end) : 1.0;
    const Vector gravity{scene.at("gravity").at(0), scene.at("gravity").at(1)};
    const auto restitution = [this](std::int32_t i, std::int32_t j) {
      return pairs_.restitution(i, j);
    };
    ImpulseScene made{turningDisks(arrays), bodies_, dt_,   law.friction(), gravity, smallest,
                      restitution,          {},      number};
    if (rolls_)
      made.rolling = [this](std::int32_t i, std::int32_t j) { return pairs_.rolling(i, j); };
    space_ = make_(made);
    sums_.clear(bodies_.size());
    last_.clear(bodies_.size());
    Json deviations = space_->deviations();
    for (const Json& each : pairs_.deviations()) deviations.push_back(each);
    Json effects = Json::array();
    for (const auto& [name, on] :
         {std::pair("normal_damping", law.damps()),
          {"friction", friction_},
          {"rotation", rotation_},
          {"rolling_resistance", rolls_},
          {"gravity", gravity.x != 0.0 || gravity.y != 0.0},
          {"moving_walls", std::any_of(bodies_.begin(), bodies_.end(),
                                       [](const Body& body) { return body.moves(); })}})
      if (on) effects.push_back(name);
    return {{"engine", about_.name},
            {"version", about_.version},
            {"dt", dt_},
            {"precision", "double"},
            {"integrator", about_.integrator},
            {"velocity_lag", about_.lag * dt_},
            {"effects", effects},
            {"pairs", pairs_.table(!bodies_.empty(), rolls_)},
            {"deviations", deviations}};
  }

  double advance(double t) {
    return steps_.advance(t, [this] { step(); });
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) {
    std::vector<double> position, velocity, spin, walls;
    for (std::size_t i = 0; i < disks_; ++i) {
      append(position, space_->position(i));
      append(velocity, space_->velocity(i));
      spin.push_back(space_->spin(i));
    }
    for (const Body& body : bodies_)
      for (const Vector& place : body.position) append(walls, place);
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    arrays.add("wall_position", walls);
    if (friction_ || rolls_) arrays.add("spin", spin);
    const bool accumulated = contacts == "accumulated";
    ImpulseSums& shown = accumulated ? sums_ : last_;
    const double interval = static_cast<double>(shown.steps) * dt_;
    Json bodies = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies.push_back(bodies_[b].pose());
      if (shown.steps == 0) continue;
      const Vector force = (1.0 / interval) * shown.onBody[b];
      bodies.back()["force"] = {force.x, force.y};
      bodies.back()["torque"] = shown.torqueOnBody[b] / interval;
    }
    if (shown.steps > 0 && contacts != "none")
      addContacts(arrays, shown, interval, rolls_,
                  [this](std::size_t i, std::size_t j) { return geometry(i, j); });
    if (accumulated) sums_.clear(bodies_.size());
    return {{"position_time", steps_.now()},
            {"velocity_time", steps_.now()},
            {"contact_time", steps_.now()},
            {"contact_interval", interval},
            {"bodies", bodies}};
  }

  Json stats() const { return steps_.stats(evaluations_); }

 private:
  void loadWalls(const Json& scene, const Arrays& arrays) {
    bodies_ = bodiesOf(scene, arrays);
    for (const Body& body : bodies_)
      radius_.insert(radius_.end(), body.radius.begin(), body.radius.end());
    ids_.emplace(disks_, bodies_);
  }

  /// As they take part: what cannot turn has no moment of inertia, what nothing turns no spin.
  std::vector<Disk> turningDisks(const Arrays& arrays) const {
    std::vector<Disk> disks = disksOf(arrays);
    for (Disk& disk : disks) {
      if (!rotation_) disk.inertia = std::numeric_limits<double>::infinity();
      if (!friction_ && !rolls_) disk.spin = 0.0;
    }
    return disks;
  }

  void step() {
    space_->step(steps_.now());
    last_.clear(bodies_.size());
    for (PairImpulse impulse : space_->impulses()) {
      ++evaluations_;
      // Without rotation friction has no arm, on a wall disk either.
      const auto j = static_cast<std::size_t>(impulse.j);
      if (!rotation_ && ids_->isWall(j) && !ids_->isPlane(j)) impulse.place = wallDisk(j);
      for (ImpulseSums* sums : {&last_, &sums_}) sums->add(impulse, *ids_, bodies_);
    }
    ++last_.steps;
    ++sums_.steps;
  }

  Vector wallDisk(std::size_t id) const { return bodies_[ids_->body(id)].position[ids_->part(id)]; }

  Geometry geometry(std::size_t i, std::size_t j) const {
    const Vector place = space_->position(i);
    if (ids_->isPlane(j)) {
      const Plane& plane = bodies_[ids_->body(j)].planes[ids_->part(j)];
      return {plane.normal, radius_[i] - dot(place - plane.point, plane.normal)};
    }
    const Vector apart = place - (ids_->isWall(j) ? wallDisk(j) : space_->position(j));
    const double distance = std::hypot(apart.x, apart.y);
    return {(1.0 / distance) * apart, radius_[i] + radius_[j] - distance};
  }

  ImpulseAbout about_;
  MakeSpace make_;
  RigidPairs pairs_;
  double dt_ = 0.0;
  bool friction_ = false, rotation_ = false, rolls_ = false;
  std::size_t disks_ = 0;
  std::vector<double> radius_;  ///< disks, then wall disks [m]
  std::vector<Body> bodies_;
  std::optional<WallIds> ids_;
  std::unique_ptr<ImpulseSpace> space_;
  ImpulseSums sums_, last_;
  StepCount steps_;
  unsigned long long evaluations_ = 0;
};

}  // namespace crossgrain_worker
