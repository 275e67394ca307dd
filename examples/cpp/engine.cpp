// Soft disks in plain C++17, as small as an engine can be: a worker to begin your own with.
//
//     g++ -O2 -std=c++17 -I../../engines/cpp engine.cpp -o engine
//     crossgrain conformance examples/cpp/engine.toml
//
// Linear springs and dashpots, Coulomb friction with a tangential spring; semi-implicit Euler
// steps. Every formula is that of adapters/worker/README.md; disks first, then wall disks, then
// planes.

#include <map>
#include <utility>

#include "crossgrain_scene.hpp"

using namespace crossgrain_worker;

namespace {

struct Contact {
  std::int32_t i, j;
  Vector normal;
  double overlap, fn, ft;
  bool sliding;
};

class Engine {
 public:
  static Json capabilities() {
    Json effects;  // what is missing is "never"
    for (const char* name : {"normal_damping", "friction", "tangential_spring",
                             "tangential_damping", "rotation", "gravity", "moving_walls"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    return {{"version", "1"},
            {"effects", effects},
            {"law_options",
             {{"normal", only("linear")},
              {"damper", only("constant")},
              {"tangential", {"none", "spring", "spring_dashpot"}},
              {"tension", only("allow")},
              {"coulomb_bound", only("compression")},
              {"dashpot", only("inside")},
              {"spring_reset", only("total")},
              {"spring_update", only("after")},
              {"lever_arm", only("radius")},
              {"velocity_arm", only("lever_arm")},
              {"history", only("displacement")},
              {"damping_velocity", only("lagged")},
              {"integrator", only("semi_implicit_euler")}}},
            {"precisions", only("double")},
            {"instant_contacts", true},
            {"accumulated_contacts", false},
            {"warm_handover", false},
            {"sliding_flags", true},
            {"settings", Json::array()}};
  }

  Json load(const Json& scene, const Arrays& arrays, const Json&) {
    *this = Engine();
    const Json& law = scene.at("law");
    const std::string tangential = law.at("tangential");
    if (law.at("normal") != "linear") throw Unsupported("has only normal = linear");
    if (scene.contains("bottom")) throw Unsupported("has no bottom_friction");
    dt_ = scene.at("dt");
    steps_ = StepCount(dt_);
    kn_ = law.at("kn");
    gn_ = law.at("gn");
    kt_ = law.at("kt");
    mu_ = law.at("mu");
    gt_ = tangential == "spring_dashpot" ? law.at("gt").get<double>() : 0.0;
    friction_ = tangential != "none" && mu_ > 0.0;
    if (friction_ && !(kt_ > 0.0))
      throw Unsupported("has friction by springs alone: kt must be > 0");
    turns_ = friction_ && scene.at("rotation").get<bool>();
    gravity_ = {scene.at("gravity").at(0), scene.at("gravity").at(1)};
    disks_ = scene.at("disks");
    radius_ = arrays.at("disks.radius");
    mass_ = arrays.at("disks.mass");
    inertia_ = arrays.at("disks.inertia");
    spin_ = arrays.at("disks.spin");
    if (!turns_) spin_.assign(disks_, 0.0);
    position_ = vectorsOf(arrays.at("disks.position"));
    velocity_ = vectorsOf(arrays.at("disks.velocity"));
    bodies_ = bodiesOf(scene, arrays);
    bool moving = false;
    for (const Body& body : bodies_) {
      radius_.insert(radius_.end(), body.radius.begin(), body.radius.end());
      moving = moving || body.moves();
    }
    for (auto* each : {&position_, &velocity_}) each->resize(radius_.size());
    spin_.resize(radius_.size());
    moveWalls();
    addForces();
    Json effects = Json::array();
    for (const auto& [name, on] : {std::pair("normal_damping", gn_ > 0.0),
                                   {"friction", friction_},
                                   {"tangential_spring", friction_},
                                   {"tangential_damping", friction_ && gt_ > 0.0},
                                   {"rotation", turns_},
                                   {"gravity", gravity_.x != 0.0 || gravity_.y != 0.0},
                                   {"moving_walls", moving}})
      if (on) effects.push_back(name);
    return {
        {"engine", "plain"},       {"version", "1"},         {"dt", dt_},
        {"precision", "double"},   {"effects", effects},     {"integrator", "semi_implicit_euler"},
        {"velocity_lag", dt_ / 2}, {"pairs", Json::array()}, {"deviations", Json::array()}};
  }

  double advance(double t) {
    return steps_.advance(t, [this] { step(); });
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) {
    std::vector<double> position = flat(position_), velocity = flat(velocity_);
    arrays.add(
        "wall_position",
        std::vector<double>(position.begin() + 2 * static_cast<long>(disks_), position.end()));
    position.resize(2 * disks_);
    velocity.resize(2 * disks_);
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    if (friction_)
      arrays.add("spin",
                 std::vector<double>(spin_.begin(), spin_.begin() + static_cast<long>(disks_)));
    if (contacts == "instant") addContacts(arrays);
    Json bodies = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies.push_back(bodies_[b].pose());
      bodies.back()["force"] = {onBody_[b].x, onBody_[b].y};
      bodies.back()["torque"] = torqueOnBody_[b];
    }
    return {{"position_time", steps_.now()},
            {"velocity_time", steps_.now()},
            {"contact_time", steps_.now()},
            {"contact_interval", 0.0},
            {"bodies", bodies}};
  }

  Json stats() const { return steps_.stats(evaluations_); }

 private:
  void step() {
    for (std::size_t i = 0; i < disks_; ++i) {
      velocity_[i] = velocity_[i] + dt_ * ((1.0 / mass_[i]) * force_[i] + gravity_);
      if (turns_) spin_[i] += dt_ * torque_[i] / inertia_[i];
      position_[i] = position_[i] + dt_ * velocity_[i];
    }
    moveWalls();
    addForces();
  }

  void moveWalls() {
    std::size_t id = disks_;
    for (Body& body : bodies_) {
      body.at(steps_.now());
      for (std::size_t k = 0; k < body.radius.size(); ++k, ++id) {
        position_[id] = body.position[k];
        velocity_[id] = body.diskVelocity[k];
        spin_[id] = turns_ ? body.spin : 0.0;
      }
    }
  }

  /// All pairs: slow, and short. Springs of pairs that no longer touch are gone.
  void addForces() {
    force_.assign(disks_, {});
    torque_.assign(disks_, 0.0);
    onBody_.assign(bodies_.size(), {});
    torqueOnBody_.assign(bodies_.size(), 0.0);
    contacts_.clear();
    std::map<std::pair<std::size_t, std::size_t>, double> before;
    before.swap(spring_);
    const auto remembered = [&](std::size_t i, std::size_t j) {
      const auto found = before.find({i, j});
      return found == before.end() ? 0.0 : found->second;
    };
    for (std::size_t i = 0; i < disks_; ++i) {
      std::size_t body = 0, end = disks_;  // of the wall disk that comes
      for (std::size_t j = i + 1; j < radius_.size(); ++j) {
        while (j >= disks_ && j >= end + bodies_[body].radius.size())
          end += bodies_[body++].radius.size();
        const Vector apart = position_[i] - position_[j];
        const double reach = radius_[i] + radius_[j], distance = std::sqrt(dot(apart, apart));
        if (distance >= reach) continue;
        const Vector n = (1.0 / distance) * apart;
        const double rim = radius_[i] * spin_[i] + radius_[j] * spin_[j];
        const Contact c =
            contact(i, j, n, reach - distance, velocity_[i] - velocity_[j], rim, remembered(i, j));
        if (j < disks_) {
          force_[j] = force_[j] - forceOf(c);
          torque_[j] -= radius_[j] * c.ft;
        } else {
          push(body, position_[j], c, radius_[j]);
        }
      }
      std::size_t plane = radius_.size();
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (const Plane& p : bodies_[b].planes) {
          const double height = dot(position_[i] - p.point, p.normal);
          const std::size_t id = plane++;
          if (height >= radius_[i]) continue;
          const Vector foot = position_[i] - height * p.normal;
          const Contact c = contact(i, id, p.normal, radius_[i] - height,
                                    velocity_[i] - bodies_[b].velocityAt(foot),
                                    radius_[i] * spin_[i], remembered(i, id));
          push(b, foot, c, 0.0);
        }
    }
    evaluations_ += contacts_.size();
  }

  /// The law for one pair; keeps its spring, lists it, and adds its force to disk i.
  Contact contact(std::size_t i, std::size_t j, Vector n, double overlap, Vector relative,
                  double rim, double spring) {
    const double slip = dot(relative, turned(n)) - rim;
    Contact c{static_cast<std::int32_t>(i),
              static_cast<std::int32_t>(j),
              n,
              overlap,
              kn_ * overlap - gn_ * dot(relative, n),
              0.0,
              false};
    if (friction_) {
      const double bound = mu_ * std::max(c.fn, 0.0), trial = -kt_ * spring - gt_ * slip;
      c.sliding = std::abs(trial) > bound;
      c.ft = c.sliding ? std::copysign(bound, trial) : trial;
      spring_[{i, j}] = c.sliding ? -c.ft / kt_ : spring + slip * dt_;
    }
    force_[i] = force_[i] + forceOf(c);
    torque_[i] -= radius_[i] * c.ft;
    contacts_.push_back(c);
    return c;
  }

  static Vector forceOf(const Contact& c) { return c.fn * c.normal + c.ft * turned(c.normal); }

  void push(std::size_t body, Vector place, const Contact& c, double arm) {
    const Vector on = -1.0 * forceOf(c);
    onBody_[body] = onBody_[body] + on;
    torqueOnBody_[body] += cross(place - bodies_[body].centre, on) - arm * c.ft;
  }

  void addContacts(ArrayFile& arrays) const {
    ContactColumns columns;
    std::vector<std::uint8_t> sliding;
    for (const Contact& c : contacts_) {
      columns.add(c.i, c.j, c.normal, c.overlap, c.fn, c.ft);
      sliding.push_back(c.sliding);
    }
    columns.writeTo(arrays);
    arrays.add("contacts.sliding", sliding);
  }

  static std::vector<double> flat(const std::vector<Vector>& list) {
    std::vector<double> numbers;
    for (const Vector& v : list) append(numbers, v);
    return numbers;
  }

  double dt_ = 0.0, kn_ = 0.0, gn_ = 0.0, kt_ = 0.0, gt_ = 0.0, mu_ = 0.0;
  bool friction_ = false, turns_ = false;
  Vector gravity_;
  std::size_t disks_ = 0;
  std::vector<Body> bodies_;
  std::vector<double> radius_, mass_, inertia_, spin_, torque_, torqueOnBody_;
  std::vector<Vector> position_, velocity_, force_, onBody_;
  std::vector<Contact> contacts_;
  std::map<std::pair<std::size_t, std::size_t>, double> spring_;  ///< ξ by pair [m]
  StepCount steps_;
  unsigned long long evaluations_ = 0;
};

}  // namespace

int main() {
  return serve(Engine());
}
