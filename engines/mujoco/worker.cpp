// A worker of crossgrain that runs scenes on MuJoCo; README.md of this folder says what MuJoCo
// makes of a scene.

#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <utility>

#include "crossgrain_worker.hpp"
#include "model.hpp"

namespace mujoco_worker {
namespace {

using namespace crossgrain_worker;

Json setting(const char* name, Json value, const char* doc, Json more) {
  Json each{{"name", name},
            {"default", std::move(value)},
            {"unit", "-"},
            {"doc", doc},
            {"choices", Json::array()}};
  each.update(more);
  return each;
}

class Engine {
 public:
  static Json capabilities() {
    Json effects;
    for (const char* name : {"normal_damping", "friction", "tangential_damping", "rotation",
                             "gravity", "moving_walls"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    return {
        {"version", mj_versionString()},
        {"effects", effects},
        {"law_options",
         {{"normal", only("linear")},
          {"damper", only("constant")},
          {"tangential", {"none", "viscous"}},
          {"tension", only("cut")},
          {"coulomb_bound", only("compression")},
          {"lever_arm", only("overlap_middle")},
          {"velocity_arm", only("lever_arm")},
          {"plane_arm", only("middle")},
          {"damping_velocity", only("lagged")},
          {"integrator", only("semi_implicit_euler")}}},
        {"wall_motions", {"fixed", "rotating", "translating", "oscillating"}},
        {"plane_motions", only("fixed")},
        {"precisions", only("double")},
        {"instant_contacts", true},
        {"accumulated_contacts", false},
        {"warm_handover", false},
        {"sliding_flags", false},
        {"settings",
         {setting(
              "impedance", 1e-4,
              "d of its contacts: 1e-4 springs that know nothing of each other, 0.9999 constraints",
              {{"least", 1e-4}, {"most", 0.9999}}),
          setting("solver", "CG", "CG or Newton", {{"choices", {"CG", "Newton"}}}),
          setting("iterations", 100.0, "most of its solver in a step",
                  {{"least", 1.0}, {"whole", true}}),
          setting("tolerance", 1e-14, "of its solver", {{"least", 0.0}})}}};
  }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    *this = Engine();
    const Json& law = scene.at("law");
    if (law.at("normal") != "linear") throw Unsupported("has only normal = linear");
    if (scene.contains("bottom") && scene.at("bottom").at("mu") > 0.0)
      throw Unsupported("has no bottom_friction");
    Json used;
    const Json known = capabilities().at("settings");
    for (const Json& each : known)
      used[each.at("name")] =
          settings.value(each.at("name").get<std::string>(), each.at("default"));
    dt_ = scene.at("dt");
    PairLaw pair{law.at("kn"), law.at("gn"), 0.0, 0.0};
    if (law.at("tangential") != "none" && law.at("mu") > 0.0) {
      pair.mu = law.at("mu");
      pair.gt = law.at("gt");
      if (!(pair.gt > 0.0 && pair.gn > 0.0))
        throw Unsupported("has friction that brakes with gt, by a ratio to gn: both must be > 0");
    }
    friction_ = pair.mu > 0.0;
    rotation_ = friction_ && scene.at("rotation").get<bool>();
    disks_ = scene.at("disks");
    radius_ = arrays.at("disks.radius");
    loadWalls(scene, arrays);
    const Vector gravity{scene.at("gravity").at(0), scene.at("gravity").at(1)};
    model_.emplace(disksOf(arrays), bodies_, pair,
                   ModelOptions{dt_, gravity, rotation_, used.at("impedance"), used.at("tolerance"),
                                used.at("iterations").get<int>(), used.at("solver") == "Newton"});
    bool moving = false;
    for (const Body& body : bodies_) moving = moving || body.moves();
    Json effects = Json::array();
    for (const auto& [name, on] : {std::pair("normal_damping", pair.gn > 0.0),
                                   {"friction", friction_},
                                   {"tangential_damping", friction_},
                                   {"rotation", rotation_},
                                   {"gravity", gravity.x != 0.0 || gravity.y != 0.0},
                                   {"moving_walls", moving}})
      if (on) effects.push_back(name);
    Json deviations = Json::array();
    if (friction_)
      deviations.push_back({{"name", "dilation"},
                            {"value", pair.mu * pair.gn},
                            {"unit", "kg/s"},
                            {"note", "of contacts that slide f_n grows by this times |v_t|"}});
    return {{"engine", "mujoco"},
            {"version", mj_versionString()},
            {"dt", dt_},
            {"precision", "double"},
            {"effects", effects},
            {"integrator", "semi_implicit_euler"},
            {"velocity_lag", dt_ / 2},
            {"pairs", Json::array()},
            {"deviations", deviations}};
  }

  double advance(double t) {
    using Clock = std::chrono::steady_clock;
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    while (steps_ < std::llround(t / dt_)) {
      ++steps_;
      for (Body& body : bodies_) body.at(now());
      model_->step(bodies_);
      evaluations_ += model_->contacts().size();
    }
    wallSeconds_ += std::chrono::duration<double>(Clock::now() - wall).count();
    cpuSeconds_ += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return now();
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) const {
    std::vector<double> position, velocity, spin, walls;
    for (std::size_t i = 0; i < disks_; ++i) {
      append(position, model_->position(i));
      append(velocity, model_->velocity(i));
      spin.push_back(model_->spin(i));
    }
    for (const Body& body : bodies_)
      for (const Vector& place : body.position) append(walls, place);
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    arrays.add("wall_position", walls);
    if (friction_) arrays.add("spin", spin);
    if (contacts == "instant") addContacts(arrays);
    return {{"position_time", now()},
            {"velocity_time", now()},
            {"contact_time", now()},
            {"contact_interval", 0.0},
            {"bodies", wallLoads()}};
  }

  Json stats() const {
    return {{"steps", steps_},
            {"contact_evaluations", evaluations_},
            {"wall_seconds", wallSeconds_},
            {"cpu_seconds", cpuSeconds_},
            {"counters", {{"solver_iterations", model_ ? model_->iterations() : 0}}}};
  }

 private:
  double now() const { return static_cast<double>(steps_) * dt_; }

  static void append(std::vector<double>& numbers, Vector v) {
    numbers.insert(numbers.end(), {v.x, v.y});
  }

  void loadWalls(const Json& scene, const Arrays& arrays) {
    for (const Json& body : scene.at("bodies")) {
      const std::string name = "bodies." + std::to_string(bodies_.size()) + ".disk_";
      bodies_.emplace_back(body, arrays.at(name + "position"), arrays.at(name + "radius"));
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t k = 0; k < bodies_[b].radius.size(); ++k) ofWall_.push_back({b, k});
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t p = 0; p < bodies_[b].planes.size(); ++p) ofWall_.push_back({b, PLANE});
  }

  std::vector<Disk> disksOf(const Arrays& arrays) const {
    const auto vector = [&](const char* name, std::size_t i) {
      const std::vector<double>& numbers = arrays.at(name);
      return Vector{numbers[2 * i], numbers[2 * i + 1]};
    };
    std::vector<Disk> disks;
    for (std::size_t i = 0; i < disks_; ++i)
      disks.push_back({radius_[i], arrays.at("disks.mass")[i], arrays.at("disks.inertia")[i],
                       vector("disks.position", i), vector("disks.velocity", i),
                       arrays.at("disks.spin")[i]});
    return disks;
  }

  /// Forces on walls act where disks touch them; without rotation on wall disks' centres.
  Json wallLoads() const {
    std::vector<Vector> force(bodies_.size());
    std::vector<double> torque(bodies_.size());
    for (const ContactForce& c : model_->contacts()) {
      if (static_cast<std::size_t>(c.j) < disks_) continue;
      const auto [b, k] = ofWall_[static_cast<std::size_t>(c.j) - disks_];
      const Vector place = rotation_ || k == PLANE ? c.point : bodies_[b].position[k];
      force[b] = force[b] - c.onFirst;
      torque[b] -= cross(place - bodies_[b].centre, c.onFirst);
    }
    Json loads = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Body& body = bodies_[b];
      loads.push_back({{"centre", {body.centre.x, body.centre.y}},
                       {"angle", body.angle},
                       {"velocity", {body.velocity.x, body.velocity.y}},
                       {"angular_velocity", body.spin},
                       {"force", {force[b].x, force[b].y}},
                       {"torque", torque[b]}});
    }
    return loads;
  }

  void addContacts(ArrayFile& arrays) const {
    std::vector<std::int32_t> i, j;
    std::vector<double> normal, overlap, fn, ft;
    for (const ContactForce& c : model_->contacts()) {
      i.push_back(c.i);
      j.push_back(c.j);
      append(normal, c.normal);
      overlap.push_back(c.overlap);
      fn.push_back(dot(c.onFirst, c.normal));
      ft.push_back(dot(c.onFirst, turned(c.normal)));
    }
    arrays.add("contacts.i", i);
    arrays.add("contacts.j", j);
    arrays.add("contacts.normal", normal);
    arrays.add("contacts.overlap", overlap);
    arrays.add("contacts.normal_force", fn);
    arrays.add("contacts.tangential_force", ft);
  }

  static constexpr std::size_t PLANE = static_cast<std::size_t>(-1);  ///< no wall disk: a plane

  double dt_ = 0.0;
  bool friction_ = false, rotation_ = false;
  std::size_t disks_ = 0;
  std::vector<double> radius_;  ///< disks [m]
  std::vector<Body> bodies_;
  std::vector<std::pair<std::size_t, std::size_t>>
      ofWall_;  ///< body, disk of it; wall disks, then planes
  std::optional<Model> model_;
  long long steps_ = 0;
  unsigned long long evaluations_ = 0;
  double wallSeconds_ = 0.0, cpuSeconds_ = 0.0;
};

}  // namespace
}  // namespace mujoco_worker

int main() {
  return crossgrain_worker::serve(mujoco_worker::Engine());
}
