// Soft disks and spheres in plain C++17, as small as an engine can be: a worker to begin your own
// with.
//
//     g++ -O2 -std=c++17 -I../../engines/cpp engine.cpp -o engine
//     crossgrain conformance examples/cpp/engine.toml
//
// Linear springs and dashpots, Coulomb friction with a tangential spring; semi-implicit Euler
// steps; periodic boxes. Every formula is that of adapters/worker/README.md; disks first, then wall
// disks, then planes. Run<2> has disks in a plane, Run<3> spheres in space: an engine of one of
// them needs no template. `engine 3` takes scenes of spheres alone.

#include <map>
#include <utility>
#include <variant>

#include "crossgrain_scene.hpp"

using namespace crossgrain_worker;

namespace {

/// A scene as it runs.
template <int D>
class Run {
  using Vector = VectorOf<D>;
  using Spin = SpinOf<D>;  // about z in the plane, a vector in space

 public:
  Json load(const Json& scene, const Arrays& arrays) {
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
    gravity_ = scene.at("gravity").get<Vector>();
    box_ = BoxOf<D>(scene);
    bodies_ = bodiesOf<D>(scene, arrays);
    for (const DiskOf<D>& disk : disksOf<D>(arrays)) {
      radius_.push_back(disk.radius);
      mass_.push_back(disk.mass);
      inertia_.push_back(disk.inertia);
      position_.push_back(disk.position);
      velocity_.push_back(disk.velocity);
      spin_.push_back(turns_ ? disk.spin : Spin{});
    }
    disks_ = radius_.size();
    bool moving = false;
    for (const BodyOf<D>& body : bodies_) {
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
                                   {"gravity", !isZero(gravity_)},
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
    std::vector<double> position, velocity, spin, walls;
    for (std::size_t i = 0; i < position_.size(); ++i) {
      append(i < disks_ ? position : walls, position_[i]);
      if (i >= disks_) continue;
      append(velocity, velocity_[i]);
      append(spin, spin_[i]);
    }
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    arrays.add("wall_position", walls);
    if (friction_) arrays.add("spin", spin);
    if (contacts == "instant") addContacts(arrays);
    Json bodies = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      bodies.push_back(bodies_[b].pose());
      bodies.back()["force"] = toJson(onBody_[b]);
      bodies.back()["torque"] = toJson(torqueOnBody_[b]);
    }
    return {{"position_time", steps_.now()},
            {"velocity_time", steps_.now()},
            {"contact_time", steps_.now()},
            {"contact_interval", 0.0},
            {"bodies", bodies}};
  }

  Json stats() const { return steps_.stats(evaluations_); }

 private:
  struct Contact {
    std::size_t i, j;
    Vector normal;
    double overlap, fn;
    Vector ft;  ///< on i, normal to n
    bool sliding;

    Vector force() const { return fn * normal + ft; }
    /// Torque on i for each metre of its arm.
    Spin couple() const { return -1.0 * cross(normal, ft); }
  };

  void step() {
    for (std::size_t i = 0; i < disks_; ++i) {
      velocity_[i] = velocity_[i] + dt_ * ((1.0 / mass_[i]) * force_[i] + gravity_);
      if (turns_) spin_[i] = spin_[i] + (dt_ / inertia_[i]) * torque_[i];
      position_[i] = position_[i] + dt_ * velocity_[i];
    }
    moveWalls();
    addForces();
  }

  void moveWalls() {
    std::size_t id = disks_;
    for (BodyOf<D>& body : bodies_) {
      body.at(steps_.now());
      for (std::size_t k = 0; k < body.radius.size(); ++k, ++id) {
        position_[id] = body.position[k];
        velocity_[id] = body.diskVelocity[k];
        spin_[id] = turns_ ? body.spin : Spin{};
      }
    }
  }

  /// All pairs: slow, and short. Springs of pairs that no longer touch are gone.
  void addForces() {
    force_.assign(disks_, {});
    torque_.assign(disks_, {});
    onBody_.assign(bodies_.size(), {});
    torqueOnBody_.assign(bodies_.size(), {});
    contacts_.clear();
    before_.clear();
    before_.swap(spring_);
    for (std::size_t i = 0; i < disks_; ++i) {
      std::size_t body = 0, end = disks_;  // of the wall disk that comes
      for (std::size_t j = i + 1; j < radius_.size(); ++j) {
        while (j >= disks_ && j >= end + bodies_[body].radius.size())
          end += bodies_[body++].radius.size();
        const Vector apart = box_.nearest(position_[i] - position_[j]);
        const double reach = radius_[i] + radius_[j];
        if (dot(apart, apart) >= reach * reach) continue;
        const double distance = norm(apart);
        const Contact c =
            contact(i, j, (1.0 / distance) * apart, reach - distance, velocity_[i] - velocity_[j],
                    radius_[i] * spin_[i] + radius_[j] * spin_[j]);
        if (j < disks_) {
          force_[j] = force_[j] - c.force();
          torque_[j] = torque_[j] + radius_[j] * c.couple();
        } else {
          push(body, position_[j], c, turns_ ? radius_[j] : 0.0);
        }
      }
      std::size_t plane = radius_.size();
      for (std::size_t b = 0; b < bodies_.size(); ++b)
        for (const PlaneOf<D>& p : bodies_[b].planes) {
          const double height = dot(position_[i] - p.point, p.normal);
          const std::size_t id = plane++;
          if (height >= radius_[i]) continue;
          const Vector foot = position_[i] - height * p.normal;
          push(b, foot,
               contact(i, id, p.normal, radius_[i] - height,
                       velocity_[i] - bodies_[b].velocityAt(foot), radius_[i] * spin_[i]),
               0.0);
        }
    }
    evaluations_ += contacts_.size();
  }

  /// The law for one pair; keeps its spring, lists it, and adds its force to disk i.
  /// @param relative  velocity of i less that of j  @param rim  a_i ω_i + a_j ω_j
  Contact contact(std::size_t i, std::size_t j, Vector n, double overlap, Vector relative,
                  Spin rim) {
    Contact c{i, j, n, overlap, kn_ * overlap - gn_ * dot(relative, n), {}, false};
    if (friction_) {
      const Vector slip = across(n, relative - cross(rim, n));
      const auto found = before_.find({i, j});
      const Vector spring = found == before_.end() ? Vector{} : follow(n, found->second);
      const Vector trial = -kt_ * spring - gt_ * slip;
      const double bound = mu_ * std::max(c.fn, 0.0), size = norm(trial);
      c.sliding = size > bound;
      c.ft = c.sliding ? (bound / size) * trial : trial;
      spring_[{i, j}] = c.sliding ? (-1.0 / kt_) * c.ft : spring + dt_ * slip;
    }
    force_[i] = force_[i] + c.force();
    torque_[i] = torque_[i] + radius_[i] * c.couple();
    contacts_.push_back(c);
    return c;
  }

  /// Part of v that is normal to n.
  static Vector across(Vector n, Vector v) { return v - dot(v, n) * n; }

  /// A spring after the normal has turned to n: normal to it, as long as it was (spring_turn =
  /// rescaled). In the plane it is the same number along z × n.
  static Vector follow(Vector n, Vector spring) {
    const Vector flat = across(n, spring);
    const double left = norm(flat);
    return left > 0.0 ? (norm(spring) / left) * flat : flat;
  }

  /// @param arm  of the tangential force about the centre of a wall disk
  void push(std::size_t body, Vector place, const Contact& c, double arm) {
    onBody_[body] = onBody_[body] - c.force();
    torqueOnBody_[body] =
        torqueOnBody_[body] - cross(place - bodies_[body].centre, c.force()) + arm * c.couple();
  }

  void addContacts(ArrayFile& arrays) const {
    ContactColumnsOf<D> columns;
    std::vector<std::uint8_t> sliding;
    for (const Contact& c : contacts_) {
      columns.add(static_cast<std::int32_t>(c.i), static_cast<std::int32_t>(c.j), c.normal,
                  c.overlap, c.fn, tangentOf(c.ft, c.normal));
      sliding.push_back(c.sliding);
    }
    columns.writeTo(arrays);
    arrays.add("contacts.sliding", sliding);
  }

  double dt_ = 0.0, kn_ = 0.0, gn_ = 0.0, kt_ = 0.0, gt_ = 0.0, mu_ = 0.0;
  bool friction_ = false, turns_ = false;
  Vector gravity_;
  BoxOf<D> box_;
  std::size_t disks_ = 0;
  std::vector<BodyOf<D>> bodies_;
  std::vector<double> radius_, mass_, inertia_;
  std::vector<Spin> spin_, torque_, torqueOnBody_;
  std::vector<Vector> position_, velocity_, force_, onBody_;
  std::vector<Contact> contacts_;
  std::map<std::pair<std::size_t, std::size_t>, Vector> spring_, before_;  ///< ξ by pair [m]
  StepCount steps_;
  unsigned long long evaluations_ = 0;
};

class Engine {
 public:
  explicit Engine(bool spheresAlone) : spheresAlone_(spheresAlone) {}

  Json capabilities() const {
    Json effects;  // what is missing is "never"
    for (const char* name : {"normal_damping", "friction", "tangential_spring",
                             "tangential_damping", "rotation", "gravity", "moving_walls"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    Json can = {{"version", "1"},
                {"dimensions", spheresAlone_ ? Json{3} : Json{2, 3}},
                {"periodic", true},
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
                  {"integrator", only("semi_implicit_euler")},
                  {"spring_turn", only("rescaled")},
                  {"spring_twist", only("none")}}},
                {"precisions", only("double")},
                {"instant_contacts", true},
                {"accumulated_contacts", false},
                {"warm_handover", false},
                {"sliding_flags", true},
                {"settings", Json::array()}};
    if (spheresAlone_) can["inertia"] = Json{0.4};  // q of J = q m a²; any if missing
    return can;
  }

  Json load(const Json& scene, const Arrays& arrays, const Json&) {
    if (scene.value("dimension", 2) == 3)
      run_.emplace<Run<3>>();
    else
      run_.emplace<Run<2>>();
    return std::visit([&](auto& run) { return run.load(scene, arrays); }, run_);
  }
  double advance(double t) {
    return std::visit([&](auto& run) { return run.advance(t); }, run_);
  }
  Json snapshot(const std::string& contacts, ArrayFile& arrays) {
    return std::visit([&](auto& run) { return run.snapshot(contacts, arrays); }, run_);
  }
  Json stats() const {
    return std::visit([](const auto& run) { return run.stats(); }, run_);
  }

 private:
  bool spheresAlone_;
  std::variant<Run<2>, Run<3>> run_;
};

}  // namespace

int main(int argc, char** argv) {
  const bool spheresAlone = argc > 1 && std::string(argv[1]) == "3";
  return serve(Engine(spheresAlone));
}
