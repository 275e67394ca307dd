// A worker of crossgrain that runs scenes on MuJoCo; README.md of this folder says what MuJoCo
// makes of a scene.

#include <algorithm>
#include <optional>
#include <utility>

#include "crossgrain_impulse_sums.hpp"
#include "crossgrain_worker.hpp"
#include "model.hpp"

namespace crossgrain_worker::mujoco {
namespace {

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
        {"shapes", {"polygon", "capsule"}},
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
                  {{"least", 1.0}, {"most", 1e6}, {"whole", true}, {"role", "iterations"}}),
          setting("tolerance", 1e-14, "of its solver", {{"least", 0.0}, {"most", 1.0}})}}};
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
    const double dt = scene.at("dt");
    steps_ = StepCount(dt);
    PairLaw pair{law.at("kn"), law.at("gn"), 0.0, 0.0};
    if (law.at("tangential") != "none" && law.at("mu") > 0.0) {
      pair.mu = law.at("mu");
      pair.gt = law.at("gt");
      if (!(pair.gt > 0.0 && pair.gn > 0.0))
        throw Unsupported("has friction that brakes with gt, by a ratio to gn: both must be > 0");
    }
    friction_ = pair.mu > 0.0;
    convex_ = scene.contains("shapes");
    rotation_ = (friction_ || convex_) && scene.at("rotation").get<bool>();
    if (convex_ && !rotation_) throw Unsupported("has convex bodies that turn");
    disks_ = scene.at("disks");
    bodies_ = bodiesOf(scene, arrays);
    ids_.emplace(disks_, bodies_);
    const Vector gravity{scene.at("gravity").at(0), scene.at("gravity").at(1)};
    std::vector<Disk> disks = disksOf(arrays);
    addShapes(disks, scene, arrays);
    model_.emplace(
        disks, bodies_, pair,
        ModelOptions{dt, gravity, rotation_, convex_, used.at("impedance"), used.at("tolerance"),
                     used.at("iterations").get<int>(), used.at("solver") == "Newton"});
    const bool moving =
        std::any_of(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.moves(); });
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
                            {"note", "growth of f_n with |v_t| where contacts slide"}});
    return {{"engine", "mujoco"},
            {"version", mj_versionString()},
            {"dt", dt},
            {"precision", "double"},
            {"effects", effects},
            {"integrator", "semi_implicit_euler"},
            {"velocity_lag", dt / 2},
            {"pairs", Json::array()},
            {"deviations", deviations}};
  }

  double advance(double t) {
    return steps_.advance(t, [this] {
      for (Body& body : bodies_) body.at(steps_.now());
      model_->step(bodies_);
      evaluations_ += model_->contacts().size();
    });
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
    if (friction_ || convex_) arrays.add("spin", spin);
    if (convex_) {
      std::vector<double> turn;
      for (std::size_t i = 0; i < disks_; ++i) turn.push_back(model_->turn(i));
      arrays.add("turn", turn);
    }
    if (contacts == "instant") addContacts(arrays);
    return {{"position_time", steps_.now()},
            {"velocity_time", steps_.now()},
            {"contact_time", steps_.now()},
            {"contact_interval", 0.0},
            {"bodies", wallLoads()}};
  }

  Json stats() const {
    return steps_.stats(evaluations_, {{"solver_iterations", model_ ? model_->iterations() : 0}});
  }

 private:
  /// Forces on walls act where disks touch them; without rotation on wall disks' centres.
  Json wallLoads() const {
    std::vector<Vector> force(bodies_.size());
    std::vector<double> torque(bodies_.size());
    for (const ContactForce& c : model_->contacts()) {
      const auto j = static_cast<std::size_t>(c.j);
      if (!ids_->isWall(j)) continue;
      const std::size_t b = ids_->body(j);
      const Vector place =
          rotation_ || ids_->isPlane(j) ? c.point : bodies_[b].position[ids_->part(j)];
      force[b] = force[b] - c.onFirst;
      torque[b] -= cross(place - bodies_[b].centre, c.onFirst);
    }
    Json loads = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      loads.push_back(bodies_[b].pose());
      loads.back()["force"] = {force[b].x, force[b].y};
      loads.back()["torque"] = torque[b];
    }
    return loads;
  }

  void addContacts(ArrayFile& arrays) const {
    if (convex_) return addForces(arrays);
    ContactColumns columns;
    for (const ContactForce& c : model_->contacts())
      columns.add(c.i, c.j, c.normal, c.overlap, dot(c.onFirst, c.normal),
                  dot(c.onFirst, turned(c.normal)));
    columns.writeTo(arrays);
  }

  /// Those of all points of a pair together.
  void addForces(ArrayFile& arrays) const {
    ImpulseSumsOf<2> sums;
    sums.clear(bodies_.size());
    for (const ContactForce& c : model_->contacts())
      sums.addPoint({c.i, c.j, c.normal, dot(c.onFirst, c.normal), dot(c.onFirst, turned(c.normal)),
                     c.point, 0.0, c.overlap},
                    *ids_, bodies_);
    addPoints(arrays, sums, 1.0);
  }

  bool friction_ = false, rotation_ = false, convex_ = false;
  std::size_t disks_ = 0;
  std::vector<Body> bodies_;
  std::optional<WallIds> ids_;
  std::optional<Model> model_;
  StepCount steps_;
  unsigned long long evaluations_ = 0;
};

}  // namespace
}  // namespace crossgrain_worker::mujoco

int main() {
  return crossgrain_worker::serve(crossgrain_worker::mujoco::Engine());
}
