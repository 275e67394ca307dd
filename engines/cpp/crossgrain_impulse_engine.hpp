#pragma once

// All that a worker of rigid contacts and impulses answers, given a space that steps and reports
// its impulses; engines/node/impulse_engine.mjs is the same in JavaScript.
//
//     serve(ImpulseEngine(about, [](const ImpulseScene& scene) {
//       return std::make_unique<MySpace>(scene);
//     }));
//
// A second function, of const ImpulseSceneOf<3>&, makes spaces of spheres, whose walls may have
// cylinders.

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

/// Passes or parts that a solver makes of a step.
inline Json iterations(double value, const char* doc, double least = 1.0) {
  Json entry = within(setting("iterations", value, "-", doc), least, 1e6, true);
  entry["role"] = "iterations";
  return entry;
}

/// Description that an engine gives of itself.
struct ImpulseAbout {
  std::string name, version, integrator;
  /// Steps by which a reported velocity is later than the motion that had it: 1/2 where velocities
  /// change first, −1/2 where positions do.
  double lag;
  /// Where forces act: lever_arm, velocity_arm, plane_arm; and `rolling`, of those that have it.
  Json lawOptions;
  Json settings;            ///< `dt` among them
  Json shapes = {};         ///< kinds of convex bodies that it has; null: none
  int mostVertices = 1000;  ///< of a polygon or polyhedron
  bool rounded = false;     ///< polygons, too
};

template <int D>
using MakeSpaceOf = std::function<std::unique_ptr<ImpulseSpaceOf<D>>(const ImpulseSceneOf<D>&)>;

/// A Space<D> of a scene, for both functions of ImpulseEngine.
template <template <int> class Space, int D>
std::unique_ptr<ImpulseSpaceOf<D>> spaceFor(const ImpulseSceneOf<D>& scene) {
  return std::make_unique<Space<D>>(scene);
}

/// A scene as it runs.
class ImpulseRun {
 public:
  ImpulseRun() = default;
  ImpulseRun(const ImpulseRun&) = delete;
  ImpulseRun& operator=(const ImpulseRun&) = delete;
  virtual ~ImpulseRun() = default;

  virtual Json load(const Json& scene, const Arrays& arrays, const Json& settings) = 0;
  virtual double advance(double t) = 0;
  virtual Json snapshot(const std::string& contacts, ArrayFile& arrays) = 0;
  virtual Json stats() const = 0;
};

template <int D>
class ImpulseRunOf : public ImpulseRun {
 public:
  using Vector = VectorOf<D>;

  ImpulseRunOf(const ImpulseAbout& about, const MakeSpaceOf<D>& make)
      : about_(about), make_(make) {}

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) override {
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
    disks_ = scene.at("disks");
    radius_ = arrays.at("disks.radius");
    friction_ = law.friction() > 0.0;
    rolls_ = law.rolling() > 0.0 && scene.at("rotation").get<bool>();
    convex_ = scene.contains("shapes");
    rotation_ = (friction_ || rolls_ || convex_) && scene.at("rotation").get<bool>();
    if (D == 3 && rolls_) throw Unsupported("resists no rolling in space");
    if (convex_ && rolls_) throw Unsupported("resists no rolling of convex bodies");
    loadWalls(scene, arrays);
    pairs_ = RigidPairs(law, arrays.at("disks.mass"), radius_);
    const auto end = radius_.begin() + static_cast<long>(disks_);
    const double smallest = disks_ > 0 ? *std::min_element(radius_.begin(), end) : 1.0;
    const Vector gravity = scene.at("gravity").get<Vector>();
    const auto restitution = [this](std::int32_t i, std::int32_t j) {
      return pairs_.restitution(i, j);
    };
    ImpulseSceneOf<D> made{turningDisks(scene, arrays),
                           bodies_,
                           dt_,
                           law.friction(),
                           gravity,
                           smallest,
                           convex_,
                           restitution,
                           {},
                           number};
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
          {"gravity", !isZero(gravity)},
          {"moving_walls", std::any_of(bodies_.begin(), bodies_.end(),
                                       [](const BodyOf<D>& body) { return body.moves(); })}})
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

  double advance(double t) override {
    return steps_.advance(t, [this] { step(); });
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) override {
    std::vector<double> position, velocity, spin, walls;
    for (std::size_t i = 0; i < disks_; ++i) {
      append(position, space_->position(i));
      append(velocity, space_->velocity(i));
      append(spin, space_->spin(i));
    }
    for (const BodyOf<D>& body : bodies_)
      for (const Vector& place : body.position) append(walls, place);
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    arrays.add("wall_position", walls);
    if (friction_ || rolls_ || convex_) arrays.add("spin", spin);
    if (convex_) {
      std::vector<double> turn;
      for (std::size_t i = 0; i < disks_; ++i) append(turn, space_->turn(i));
      arrays.add("turn", turn);
    }
    const bool accumulated = contacts == "accumulated";
    ImpulseSumsOf<D>& shown = accumulated ? sums_ : last_;
    const double interval = static_cast<double>(shown.steps) * dt_;
    Json bodies = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies.push_back(bodies_[b].pose());
      if (shown.steps == 0) continue;
      const Vector force = (1.0 / interval) * shown.onBody[b];
      bodies.back()["force"] = toJson(force);
      bodies.back()["torque"] = toJson(meanOf(shown.torqueOnBody[b], interval));
    }
    if (shown.steps > 0 && contacts != "none" && convex_)
      addPoints(arrays, shown, interval);
    else if (shown.steps > 0 && contacts != "none")
      addContacts(arrays, shown, interval, rolls_,
                  [this](std::size_t i, std::size_t j) { return geometry(i, j); });
    if (accumulated) sums_.clear(bodies_.size());
    return {{"position_time", steps_.now()},
            {"velocity_time", steps_.now()},
            {"contact_time", steps_.now()},
            {"contact_interval", interval},
            {"bodies", bodies}};
  }

  Json stats() const override { return steps_.stats(evaluations_); }

 private:
  void loadWalls(const Json& scene, const Arrays& arrays) {
    bodies_ = bodiesOf<D>(scene, arrays);
    for (const BodyOf<D>& body : bodies_)
      radius_.insert(radius_.end(), body.radius.begin(), body.radius.end());
    if (convex_ && std::any_of(bodies_.begin(), bodies_.end(),
                               [](const BodyOf<D>& body) { return !body.cylinders.empty(); }))
      throw Unsupported("has cylinders with spheres inside, not convex bodies");
    ids_.emplace(disks_, bodies_);
  }

  /// Disks as they take part: of infinite inertia where they cannot turn, without spin where
  /// nothing turns them, or, beside convex bodies, where they cannot turn.
  std::vector<DiskOf<D>> turningDisks(const Json& scene, const Arrays& arrays) const {
    std::vector<DiskOf<D>> disks = disksOf<D>(arrays);
    addShapes(disks, scene, arrays);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (DiskOf<D>& disk : disks) {
      if (!rotation_) {
        disk.inertia = infinity;
        disk.moments = {infinity, infinity, infinity};
      }
      if (convex_ ? !rotation_ : !friction_ && !rolls_) disk.spin = {};
    }
    return disks;
  }

  void step() {
    space_->step(steps_.now());
    last_.clear(bodies_.size());
    for (PairImpulseOf<D> impulse : space_->impulses()) {
      ++evaluations_;
      if (convex_) {
        if (impulse.pressing != 0.0 || !isZero(impulse.along))
          for (ImpulseSumsOf<D>* sums : {&last_, &sums_}) sums->addPoint(impulse, *ids_, bodies_);
        continue;
      }
      // Without rotation friction has no arm, on a wall disk either.
      const auto j = static_cast<std::size_t>(impulse.j);
      if (!rotation_ && ids_->isWallDisk(j)) impulse.place = wallDisk(j);
      for (ImpulseSumsOf<D>* sums : {&last_, &sums_}) sums->add(impulse, *ids_, bodies_);
    }
    ++last_.steps;
    ++sums_.steps;
  }

  Vector wallDisk(std::size_t id) const { return bodies_[ids_->body(id)].position[ids_->part(id)]; }

  GeometryOf<D> geometry(std::size_t i, std::size_t j) const {
    const Vector place = space_->position(i);
    if (ids_->isCylinder(j)) {
      const auto [normal, distance] = bodies_[ids_->body(j)].cylinders[ids_->part(j)].facing(place);
      return {normal, radius_[i] - distance};
    }
    if (ids_->isPlane(j)) {
      const PlaneOf<D>& plane = bodies_[ids_->body(j)].planes[ids_->part(j)];
      return {plane.normal, radius_[i] - dot(place - plane.point, plane.normal)};
    }
    const Vector apart = place - (ids_->isWall(j) ? wallDisk(j) : space_->position(j));
    const double distance = norm(apart);
    return {(1.0 / distance) * apart, radius_[i] + radius_[j] - distance};
  }

  const ImpulseAbout& about_;
  const MakeSpaceOf<D>& make_;
  RigidPairs pairs_;
  double dt_ = 0.0;
  bool friction_ = false, rotation_ = false, rolls_ = false, convex_ = false;
  std::size_t disks_ = 0;
  std::vector<double> radius_;  ///< disks, then wall disks [m]
  std::vector<BodyOf<D>> bodies_;
  std::optional<WallIds> ids_;
  std::unique_ptr<ImpulseSpaceOf<D>> space_;
  ImpulseSumsOf<D> sums_, last_;
  StepCount steps_;
  unsigned long long evaluations_ = 0;
};

class ImpulseEngine {
 public:
  ImpulseEngine(ImpulseAbout about, MakeSpaceOf<2> inPlane, MakeSpaceOf<3> inSpace = {})
      : about_(std::move(about)), inPlane_(std::move(inPlane)), inSpace_(std::move(inSpace)) {}

  Json capabilities() const {
    Json effects;
    for (const char* name : {"normal_damping", "friction", "rotation", "gravity", "moving_walls"})
      effects[name] = "optional";
    if (about_.lawOptions.contains("rolling")) effects["rolling_resistance"] = "optional";
    Json options = about_.lawOptions;
    options["normal"] = {"rigid"};
    Json can = {{"version", about_.version},       {"effects", effects},
                {"law_options", options},          {"precisions", {"double"}},
                {"instant_contacts", true},        {"accumulated_contacts", true},
                {"warm_handover", false},          {"sliding_flags", false},
                {"tangential_restitution", false}, {"settings", about_.settings}};
    if (!about_.shapes.is_null())
      can.update({{"shapes", about_.shapes},
                  {"most_vertices", about_.mostVertices},
                  {"rounded", about_.rounded}});
    if (inSpace_) {
      can["dimensions"] = {2, 3};
      can["cylinders"] = true;
    }
    return can;
  }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    run_.reset();
    const bool space = scene.value("dimension", 2) == 3;
    if (space && !inSpace_) throw Unsupported("has dimension = 2, not 3");
    if (space)
      run_ = std::make_unique<ImpulseRunOf<3>>(about_, inSpace_);
    else
      run_ = std::make_unique<ImpulseRunOf<2>>(about_, inPlane_);
    return run_->load(scene, arrays, settings);
  }

  double advance(double t) { return run_->advance(t); }
  Json snapshot(const std::string& contacts, ArrayFile& arrays) {
    return run_->snapshot(contacts, arrays);
  }
  Json stats() const { return run_->stats(); }

 private:
  ImpulseAbout about_;
  MakeSpaceOf<2> inPlane_;
  MakeSpaceOf<3> inSpace_;
  std::unique_ptr<ImpulseRun> run_;
};

}  // namespace crossgrain_worker
