// A worker of crossgrain that runs scenes on Chipmunk; README.md of this folder says what Chipmunk
// makes of a scene.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "crossgrain_walls.hpp"
#include "crossgrain_worker.hpp"
#include "rigid_law.hpp"
#include "space.hpp"

namespace chipmunk_worker {
namespace {

using namespace crossgrain_worker;

/// n from the second to the first, and how deep they overlap [m].
struct Geometry {
  Vector normal;
  double overlap;
};

/// Impulses since some step, and what walls got of them.
struct Sums {
  std::map<std::pair<std::int32_t, std::int32_t>, Vector> onFirst;  ///< [N s]
  std::vector<Vector> onBody;
  std::vector<double> torqueOnBody;
  long long steps = 0;
};

Vector vectorOf(const std::vector<double>& numbers, std::size_t k) {
  return {numbers[2 * k], numbers[2 * k + 1]};
}

Json setting(const char* name, double value, const char* unit, const char* doc) {
  return {
      {"name", name}, {"default", value}, {"unit", unit}, {"doc", doc}, {"choices", Json::array()}};
}

Json within(Json setting, double least, double most, bool whole) {
  setting.update({{"least", least}, {"most", most}, {"whole", whole}});
  return setting;
}

class Engine {
 public:
  static Json capabilities() {
    Json effects;
    for (const char* name : {"normal_damping", "friction", "rotation", "gravity", "moving_walls"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    return {{"version", cpVersionString},
            {"effects", effects},
            {"law_options",
             {{"normal", only("rigid")},
              {"lever_arm", only("radius")},
              {"velocity_arm", only("lever_arm")}}},
            {"precisions", only("double")},
            {"instant_contacts", true},
            {"accumulated_contacts", true},
            {"warm_handover", false},
            {"sliding_flags", false},
            {"tangential_restitution", false},
            {"settings",
             {setting("dt", 5e-4, "s", "time step; 0: the case's"),
              within(setting("iterations", 10.0, "-", "of the solver"), 1.0, 1e6, true),
              setting("slop", 0.0, "m",
                      "overlaps up to this are left standing; 0: a thousandth of the smallest "
                      "radius"),
              within(setting("bias", std::pow(0.9, 60.0), "-",
                             "what is left after a second of an overlap beyond the slop"),
                     0.0, 1.0, false)}}};
  }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    if (scene.contains("bottom") && scene.at("bottom").at("mu") > 0.0)
      throw Unsupported("has no bottom_friction");
    law_ = RigidLaw(scene.at("law"));
    const Json known = capabilities().at("settings");
    const auto number = [&](const char* name) {
      for (const Json& each : known)
        if (each.at("name") == name) return settings.value(name, each.at("default").get<double>());
      throw std::logic_error(name);
    };
    dt_ = number("dt") > 0.0 ? number("dt") : scene.at("dt").get<double>();
    steps_ = evaluations_ = 0;
    wallSeconds_ = cpuSeconds_ = 0.0;
    disks_ = scene.at("disks");
    radius_ = arrays.at("disks.radius");
    mass_ = arrays.at("disks.mass");
    friction_ = law_.friction() > 0.0;
    rotation_ = friction_ && scene.at("rotation").get<bool>();
    space_.reset();
    loadWalls(scene, arrays);
    const double smallest =
        disks_ > 0 ? *std::min_element(radius_.begin(), radius_.begin() + static_cast<long>(disks_))
                   : 1.0;
    const double slop = number("slop") > 0.0 ? number("slop") : 1e-3 * smallest;
    const Vector gravity{scene.at("gravity").at(0), scene.at("gravity").at(1)};
    restitution_.clear();
    requireRestitution();
    space_.emplace(disksOf(arrays), bodies_,
                   SpaceOptions{dt_, static_cast<int>(number("iterations")), slop, number("bias"),
                                law_.friction(), gravity, [this](std::int32_t i, std::int32_t j) {
                                  return restitution(i, j);
                                }});
    clear(sums_);
    clear(last_);
    const Json pairs = pairTable();
    Json effects = Json::array();
    for (const auto& [name, on] : {std::pair("normal_damping", law_.damps()),
                                   {"friction", friction_},
                                   {"rotation", rotation_},
                                   {"gravity", gravity.x != 0.0 || gravity.y != 0.0},
                                   {"moving_walls", moving_}})
      if (on) effects.push_back(name);
    return {{"engine", "chipmunk"},
            {"version", cpVersionString},
            {"dt", dt_},
            {"precision", "double"},
            {"integrator", "explicit positions, then sequential impulses"},
            {"velocity_lag", -0.5 * dt_},
            {"effects", effects},
            {"pairs", pairs},
            {"deviations", deviations(pairs, slop)}};
  }

  double advance(double t) {
    using Clock = std::chrono::steady_clock;
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    while (steps_ < std::llround(t / dt_)) step();
    wallSeconds_ += std::chrono::duration<double>(Clock::now() - wall).count();
    cpuSeconds_ += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return now();
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
    if (friction_) arrays.add("spin", spin);
    const bool accumulated = contacts == "accumulated";
    Sums& shown = accumulated ? sums_ : last_;
    const double interval = static_cast<double>(shown.steps) * dt_;
    Json bodies = Json::array();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Body& body = bodies_[b];
      bodies.push_back({{"centre", {body.centre.x, body.centre.y}},
                        {"angle", body.angle},
                        {"velocity", {body.velocity.x, body.velocity.y}},
                        {"angular_velocity", body.spin}});
      if (shown.steps == 0) continue;
      const Vector force = (1.0 / interval) * shown.onBody[b];
      bodies.back()["force"] = {force.x, force.y};
      bodies.back()["torque"] = shown.torqueOnBody[b] / interval;
    }
    if (shown.steps > 0 && contacts != "none") addContacts(arrays, shown, interval);
    if (accumulated) clear(sums_);
    return {{"position_time", now()},
            {"velocity_time", now()},
            {"contact_time", now()},
            {"contact_interval", interval},
            {"bodies", bodies}};
  }

  Json stats() const {
    return {{"steps", steps_},
            {"contact_evaluations", evaluations_},
            {"wall_seconds", wallSeconds_},
            {"cpu_seconds", cpuSeconds_},
            {"counters", Json::object()}};
  }

 private:
  double now() const { return static_cast<double>(steps_) * dt_; }

  static void append(std::vector<double>& numbers, Vector v) {
    numbers.insert(numbers.end(), {v.x, v.y});
  }

  void loadWalls(const Json& scene, const Arrays& arrays) {
    bodies_.clear();
    planes_.clear();
    owner_.clear();
    moving_ = false;
    for (const Json& body : scene.at("bodies")) {
      const std::string name = "bodies." + std::to_string(bodies_.size()) + ".disk_";
      bodies_.emplace_back(body, arrays.at(name + "position"), arrays.at(name + "radius"));
      moving_ = moving_ || bodies_.back().moves();
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      owner_.insert(owner_.end(), bodies_[b].radius.size(), b);
      radius_.insert(radius_.end(), bodies_[b].radius.begin(), bodies_[b].radius.end());
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      for (std::size_t p = 0; p < bodies_[b].planes.size(); ++p) {
        owner_.push_back(b);
        planes_.push_back(p);
      }
  }

  std::vector<Disk> disksOf(const Arrays& arrays) const {
    std::vector<Disk> disks;
    for (std::size_t i = 0; i < disks_; ++i)
      disks.push_back(
          {radius_[i], mass_[i],
           rotation_ ? arrays.at("disks.inertia")[i] : std::numeric_limits<double>::infinity(),
           vectorOf(arrays.at("disks.position"), i), vectorOf(arrays.at("disks.velocity"), i),
           friction_ ? arrays.at("disks.spin")[i] : 0.0});
    return disks;
  }

  double inverseMass(std::size_t id) const { return id < disks_ ? 1.0 / mass_[id] : 0.0; }

  /// Whether every pair has a restitution: asked in a step, a refusal would pass through Chipmunk's
  /// C. The law is overdamped where γ_n² (1/m₁ + 1/m₂) ≥ 4 k_n, so the lightest pair decides for
  /// all.
  /// @throws Unsupported
  void requireRestitution() const {
    if (disks_ == 0) return;
    std::vector<double> lightest(mass_);
    const auto second = lightest.begin() + std::min<long>(1, static_cast<long>(disks_) - 1);
    std::nth_element(lightest.begin(), second, lightest.end());
    const double least = *std::min_element(lightest.begin(), lightest.end());
    law_.restitution(1.0 / least + (disks_ > 1 ? 1.0 / *second : 0.0));
  }

  double restitution(std::int32_t i, std::int32_t j) {
    const double inverse =
        inverseMass(static_cast<std::size_t>(i)) + inverseMass(static_cast<std::size_t>(j));
    const auto [known, isNew] = restitution_.try_emplace(inverse);
    if (isNew) known->second = law_.restitution(inverse);
    return known->second;
  }

  /// Of the first few kinds of disks. @throws Unsupported
  Json pairTable() const {
    std::map<double, double> kinds;  // mass → radius
    for (std::size_t i = 0; i < disks_ && kinds.size() < 4; ++i)
      kinds.emplace(mass_[i], radius_[i]);
    Json pairs = Json::array();
    const auto add = [&](double radius, const std::string& other, double inverse) {
      char name[80];
      std::snprintf(name, sizeof name, "%.3g mm with %s", 1e3 * radius, other.c_str());
      pairs.push_back({{"pair", name}, {"en", law_.restitution(inverse)}});
      if (friction_) pairs.back().update({{"mu", law_.friction()}, {"et0", 0.0}});
    };
    for (auto one = kinds.begin(); one != kinds.end(); ++one) {
      for (auto two = one; two != kinds.end(); ++two) {
        char other[40];
        std::snprintf(other, sizeof other, "%.3g mm", 1e3 * two->second);
        add(one->second, other, 1.0 / one->first + 1.0 / two->first);
      }
      if (!bodies_.empty()) add(one->second, "wall", 1.0 / one->first);
    }
    return pairs;
  }

  Json deviations(const Json& pairs, double slop) const {
    Json list = Json::array();
    const auto add = [&](const char* name, double value, const char* unit,
                         const std::string& note) {
      list.push_back({{"name", name}, {"value", value}, {"unit", unit}, {"note", note}});
    };
    if (law_.soft() && !pairs.empty()) {
      add("normal", pairs.front().at("en"), "-",
          "rigid contacts with the soft law's e_n for each pair");
      if (friction_)
        add("e_t0", 0.0, "-", "contacts that stick give back nothing of the tangential speed");
    }
    add("slop", slop, "m", "overlaps up to this are left standing");
    return list;
  }

  void clear(Sums& sums) const {
    sums.onFirst.clear();
    sums.onBody.assign(bodies_.size(), {});
    sums.torqueOnBody.assign(bodies_.size(), 0.0);
    sums.steps = 0;
  }

  void step() {
    space_->step(static_cast<double>(steps_ + 1) * dt_);
    ++steps_;
    clear(last_);
    for (const PairImpulse& impulse : space_->impulses()) {
      ++evaluations_;
      for (Sums* sums : {&last_, &sums_}) add(*sums, impulse);
    }
    ++last_.steps;
    ++sums_.steps;
  }

  void add(Sums& sums, const PairImpulse& impulse) const {
    Vector& sum = sums.onFirst[{impulse.i, impulse.j}];
    sum = sum + impulse.onFirst;
    const auto j = static_cast<std::size_t>(impulse.j);
    if (j < disks_) return;
    const std::size_t b = owner_[j - disks_];
    const Vector on = -1.0 * impulse.onFirst;
    sums.onBody[b] = sums.onBody[b] + on;
    sums.torqueOnBody[b] += cross(pointOnWall(impulse.i, j) - bodies_[b].centre, on);
  }

  /// Where a disk pushes a wall: a wall disk's rim, or without rotation its centre; a plane's foot.
  Vector pointOnWall(std::int32_t i, std::size_t j) const {
    const Vector place = space_->position(static_cast<std::size_t>(i));
    const Geometry between = geometry(static_cast<std::size_t>(i), j);
    if (j >= radius_.size())
      return place - (radius_[static_cast<std::size_t>(i)] - between.overlap) * between.normal;
    const Vector centre = wallDisk(j - disks_);
    return rotation_ ? centre + radius_[j] * between.normal : centre;
  }

  Vector wallDisk(std::size_t k) const {
    const std::size_t b = owner_[k];
    std::size_t first = k;
    while (first > 0 && owner_[first - 1] == b) --first;
    return bodies_[b].position[k - first];
  }

  Geometry geometry(std::size_t i, std::size_t j) const {
    const Vector place = space_->position(i);
    if (j >= radius_.size()) {
      const std::size_t p = j - radius_.size();
      const Plane& plane = bodies_[owner_[j - disks_]].planes[planes_[p]];
      return {plane.normal, radius_[i] - dot(place - plane.point, plane.normal)};
    }
    const Vector apart = place - (j < disks_ ? space_->position(j) : wallDisk(j - disks_));
    const double distance = std::hypot(apart.x, apart.y);
    return {(1.0 / distance) * apart, radius_[i] + radius_[j] - distance};
  }

  /// Mean forces over the interval, with the geometry of now.
  void addContacts(ArrayFile& arrays, const Sums& sums, double interval) const {
    std::vector<std::int32_t> i, j;
    std::vector<double> normal, overlap, fn, ft;
    for (const auto& [pair, onFirst] : sums.onFirst) {
      const Geometry between =
          geometry(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
      i.push_back(pair.first);
      j.push_back(pair.second);
      append(normal, between.normal);
      overlap.push_back(between.overlap);
      fn.push_back(dot(onFirst, between.normal) / interval);
      ft.push_back(dot(onFirst, turned(between.normal)) / interval);
    }
    arrays.add("contacts.i", i);
    arrays.add("contacts.j", j);
    arrays.add("contacts.normal", normal);
    arrays.add("contacts.overlap", overlap);
    arrays.add("contacts.normal_force", fn);
    arrays.add("contacts.tangential_force", ft);
  }

  RigidLaw law_;
  double dt_ = 0.0;
  bool friction_ = false, rotation_ = false, moving_ = false;
  std::size_t disks_ = 0;
  std::vector<double> radius_;  ///< disks, then wall disks [m]
  std::vector<double> mass_;    ///< disks [kg]
  std::vector<Body> bodies_;
  std::vector<std::size_t> owner_;        ///< body of a wall disk, then of a plane
  std::vector<std::size_t> planes_;       ///< a plane's number in its body
  std::map<double, double> restitution_;  ///< by 1/m₁₂ [1/kg]
  std::optional<Space> space_;
  Sums sums_, last_;
  long long steps_ = 0;
  unsigned long long evaluations_ = 0;
  double wallSeconds_ = 0.0, cpuSeconds_ = 0.0;
};

}  // namespace
}  // namespace chipmunk_worker

int main() {
  return crossgrain_worker::serve(chipmunk_worker::Engine());
}
