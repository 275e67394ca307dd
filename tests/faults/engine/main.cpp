// An engine that is right but for planted faults: a worker (adapters/worker/README.md) of soft
// disks under the thesis' law and conventions, with faults as numbers on its command line.
//
//     planted_engine [NAME=VALUE …]      names: faults.hpp

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "checkpoint.hpp"
#include "crossgrain_worker.hpp"
#include "disks.hpp"

namespace crossgrain::planted {
namespace {

const std::vector<std::string> rollingKinds = {"none", "constant_torque", "viscous", "spring"};
const std::vector<std::string> cohesionKinds = {"none", "area", "dmt", "jkr", "elasto_plastic"};

using crossgrain_worker::ArrayFile;
using crossgrain_worker::Arrays;
using crossgrain_worker::Json;
using crossgrain_worker::Unsupported;

/// Which of the names it is; 0 where the law has no such part. @throws Unsupported
int kindOf(const Json& law, const char* part, const std::vector<std::string>& names) {
  const std::string name = law.value(part, names.front());
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return static_cast<int>(k);
  throw Unsupported(std::string("has no ") + part + " = " + name);
}

/// Keys of a part are there where a law has that part.
Resistance resistanceOf(const Json& law, const Faults& faults) {
  Resistance own;
  own.hertz = law.at("normal") == "hertz";
  own.rolling = static_cast<Rolling>(kindOf(law, "rolling", rollingKinds));
  own.cohesion = static_cast<Cohesion>(kindOf(law, "cohesion", cohesionKinds));
  const auto number = [&law](const char* name) { return law.value(name, 0.0); };
  // Other conventions may differ; by these two the numbers k_r and γ_r have another unit.
  for (const auto& [name, only] :
       {std::pair("rolling_stiffness", "length_square"), {"rolling_damper", "constant"}})
    if (const std::string wanted = law.value(name, only); wanted != only)
      throw Unsupported(std::string("has ") + name + " = " + only + ", not " + wanted);
  own.kr = faults.kr * number("kr");
  own.gr = faults.gr * number("gr");
  own.muR = faults.muR * number("mu_r");
  own.kc = number("kc");
  own.w = number("w");
  own.k2 = number("k_unload");
  own.depth = number("plastic_depth");
  return own;
}

Law lawOf(const Json& law, const Faults& faults) {
  if (law.at("normal") != "linear" && law.at("normal") != "hertz")
    throw Unsupported("has only normal = linear | hertz");
  const std::string tangential = law.at("tangential");
  Law own;
  own.kn = faults.kn * law.at("kn").get<double>();
  own.gn = faults.gn * law.at("gn").get<double>();
  own.kt = faults.kt * law.at("kt").get<double>();
  own.gt = faults.gt * law.at("gt").get<double>();
  own.mu = faults.mu * law.at("mu").get<double>();
  own.more = resistanceOf(law, faults);
  own.friction = tangential != "none" && own.mu > 0.0;
  own.spring = tangential == "spring" || tangential == "spring_dashpot";
  own.dashpot = tangential == "viscous" || tangential == "spring_dashpot";
  if (own.friction && own.spring && !(own.kt > 0.0))
    throw Unsupported("has springs of a stiffness above 0 alone: kt must be > 0");
  return own;
}

Plate plateOf(const Json& scene, const Faults& faults) {
  if (!scene.contains("bottom")) return {};
  const Json& bottom = scene.at("bottom");
  const char* const tau = faults.plateColumn != 0.0 ? "mu" : "tau_m";
  const double gravity =
      faults.plateKnowsGravity != 0.0 ? 9.81 : bottom.at("gravity").get<double>();
  return {bottom.at("mu"),  bottom.at("kb"), bottom.at("gb"), bottom.at(tau), gravity, true,
          bottom.at("spin")};
}

std::vector<Vector> vectors(const std::vector<double>& numbers) {
  std::vector<Vector> list;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
    list.push_back({numbers[k], numbers[k + 1]});
  return list;
}

World worldOf(const Json& scene, const Arrays& arrays, const Faults& faults) {
  World w;
  w.disks = scene.at("disks");
  w.dt = scene.at("dt");
  w.law = lawOf(scene.at("law"), faults);
  static std::map<std::size_t, Law> first;
  if (faults.loadKeeps != 0.0) w.law = first.try_emplace(w.disks, w.law).first->second;
  w.plate = plateOf(scene, faults);
  w.gravity = {scene.at("gravity").at(0), scene.at("gravity").at(1)};
  const bool torques = w.law.friction || w.law.more.rolling != Rolling::none;
  w.turns = torques && scene.at("rotation").get<bool>();
  w.radius = arrays.at("disks.radius");
  w.mass = arrays.at("disks.mass");
  w.inertia = arrays.at("disks.inertia");
  w.spin = arrays.at("disks.spin");
  w.position = vectors(arrays.at("disks.position"));
  w.velocity = vectors(arrays.at("disks.velocity"));
  if (!w.turns) w.spin.assign(w.disks, 0.0);
  if (w.disks > 0) {
    const double small = *std::min_element(w.radius.begin(), w.radius.end());
    const double heavy = *std::max_element(w.mass.begin(), w.mass.end());
    for (std::size_t i = 0; i < w.disks; ++i) {
      if (faults.inertiaAssumed != 0.0) w.inertia[i] = 0.5 * w.mass[i] * w.radius[i] * w.radius[i];
      if (w.radius[i] == small) w.radius[i] *= faults.radiusSmall;
      if (w.mass[i] == heavy) w.mass[i] *= faults.massLarge;
      if (faults.massScaled > 0.0)
        w.mass[i] = std::max(w.mass[i], w.law.kn * w.dt * w.dt / faults.massScaled);
      w.inertia[i] *= faults.inertia;
      if (faults.inertiaOfFirst != 0.0)
        w.inertia[i] =
            w.inertia[0] * w.mass[i] / w.mass[0] * std::pow(w.radius[i] / w.radius[0], 2);
    }
  }
  for (const Json& body : scene.at("bodies")) {
    const std::string name = "bodies." + std::to_string(w.bodies.size()) + ".disk_";
    std::vector<double> radius = arrays.at(name + "radius");
    for (double& each : radius) each *= faults.radiusWall;
    if (faults.wallRadiusOfFirst != 0.0 && !radius.empty()) radius.assign(radius.size(), radius[0]);
    w.bodies.emplace_back(body, arrays.at(name + "position"), radius);
    w.radius.insert(w.radius.end(), radius.begin(), radius.end());
  }
  for (auto* each : {&w.position, &w.velocity}) each->resize(w.radius.size());
  w.spin.resize(w.radius.size());
  return w;
}

/// Contacts and the loads on walls by them, at one instant.
struct Loads {
  std::vector<Contact> contacts;
  std::vector<Vector> force;   ///< on bodies [N]
  std::vector<double> torque;  ///< about their centres [N m]
};

std::vector<double> flat(const std::vector<Vector>& list, std::size_t begin, std::size_t end) {
  std::vector<double> numbers;
  for (std::size_t k = begin; k < end; ++k) numbers.insert(numbers.end(), {list[k].x, list[k].y});
  return numbers;
}

/// By which number each disk is shown: its own, or of each kind in the opposite order.
std::vector<std::size_t> shownNumbers(const World& world, const Faults& faults) {
  std::vector<std::size_t> number(world.radius.size() + 4096);
  std::iota(number.begin(), number.end(), 0);
  if (faults.showRenumbered == 0.0) return number;
  std::map<double, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < world.disks; ++i) kinds[world.radius[i]].push_back(i);
  for (const auto& [radius, members] : kinds)
    for (std::size_t k = 0; k < members.size(); ++k)
      number[members[k]] = members[members.size() - 1 - k];
  return number;
}

Loads loadsOf(const Simulation& simulation) {
  return {simulation.contacts(), simulation.forceOnBodies(), simulation.torqueOnBodies()};
}

void addDisks(ArrayFile& arrays, const Simulation& simulation, const Faults& faults) {
  const World& world = simulation.world();
  const std::vector<std::size_t> number = shownNumbers(world, faults);
  std::vector<Vector> position(world.disks), velocity(world.disks);
  std::vector<double> spin(world.disks);
  for (std::size_t i = 0; i < world.disks; ++i) {
    const std::size_t k = number[i];
    velocity[k] = simulation.velocity(i);
    position[k] = world.position[i] - faults.showEarlier * velocity[k];
    spin[k] = faults.showSpin * simulation.spin(i);
    if (faults.showFloat != 0.0)
      position[k] = {static_cast<float>(position[k].x), static_cast<float>(position[k].y)};
  }
  if (faults.showSwappedPlaces != 0.0 && world.disks > 1) std::swap(position[0], position[1]);
  arrays.add("wall_position", flat(world.position, world.disks, world.position.size()));
  arrays.add("position", flat(position, 0, world.disks));
  arrays.add("velocity", flat(velocity, 0, world.disks));
  if (world.law.friction || world.law.more.rolling != Rolling::none) arrays.add("spin", spin);
}

void addContacts(ArrayFile& arrays, const Simulation& simulation, const Loads& loads,
                 const Faults& faults) {
  const World& world = simulation.world();
  const std::vector<std::size_t> number = shownNumbers(world, faults);
  std::vector<std::int32_t> i, j;
  std::vector<double> normal, overlap, fn, ft, rolling;
  std::vector<std::uint8_t> sliding;
  unsigned long long count = 0;
  for (const Contact& c : loads.contacts) {
    if (everyNth(faults.showDropEvery, ++count)) continue;
    auto one = static_cast<std::int32_t>(number[static_cast<std::size_t>(c.i)]);
    auto other = static_cast<std::int32_t>(number[static_cast<std::size_t>(c.j)]);
    const bool wall = static_cast<std::size_t>(c.j) >= world.disks;
    Vector n = c.normal;
    const bool swapped = other < one;
    if (swapped) {
      std::swap(one, other);
      n = -1.0 * n;
    }
    if (wall && faults.showFlippedWalls == static_cast<double>(c.i + 1)) n = -1.0 * n;
    if (wall && faults.showPlanesFirst != 0.0) {
      const auto disks = static_cast<std::int32_t>(world.radius.size() - world.disks);
      std::int32_t planes = 0;
      for (const Body& body : world.bodies) planes += static_cast<std::int32_t>(body.planes.size());
      const bool plane = static_cast<std::size_t>(c.j) >= world.radius.size();
      other += plane ? -disks : planes;
    }
    i.push_back(one);
    j.push_back(other);
    normal.insert(normal.end(), {n.x, n.y});
    overlap.push_back(c.overlap);
    fn.push_back(faults.showElastic != 0.0 ? c.elastic : c.fn);
    ft.push_back(c.ft);
    rolling.push_back(swapped ? -c.rolling : c.rolling);
    sliding.push_back(c.sliding && faults.showSlidingAsSticking == 0.0);
  }
  arrays.add("contacts.i", i);
  arrays.add("contacts.j", j);
  arrays.add("contacts.normal", normal);
  arrays.add("contacts.overlap", overlap);
  arrays.add("contacts.normal_force", fn);
  arrays.add("contacts.tangential_force", ft);
  arrays.add("contacts.sliding", sliding);
  if (world.law.more.rolling != Rolling::none) arrays.add("contacts.rolling_torque", rolling);
}

Json bodiesOf(const Simulation& simulation, const Loads& loads, const Faults& faults) {
  Json list = Json::array();
  for (std::size_t b = 0; b < loads.force.size(); ++b) {
    const Body& body = simulation.world().bodies[b];
    const Vector force = loads.force[b];
    const double more =
        faults.showTorqueAboutOrigin != 0.0 ? crossgrain_worker::cross(body.centre, force) : 0.0;
    list.push_back({{"centre", {body.centre.x, body.centre.y}},
                    {"angle", body.angle},
                    {"velocity", {body.velocity.x, body.velocity.y}},
                    {"angular_velocity", body.spin},
                    {"force", {faults.showWallForce * force.x, faults.showWallForce * force.y}},
                    {"torque", faults.showWallTorque * loads.torque[b] + more}});
  }
  return list;
}

class PlantedEngine {
 public:
  explicit PlantedEngine(const Faults& faults) : faults_(faults) {}

  Json capabilities() const {
    Json effects;
    for (const char* name :
         {"normal_damping", "friction", "tangential_spring", "tangential_damping", "rotation",
          "bottom_friction", "bottom_spin_friction", "gravity", "moving_walls",
          "rolling_resistance", "cohesion"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    const Faults& f = faults_;
    Json options = {
        {"normal", {"linear", "hertz"}},
        {"damper", only("constant")},
        {"tangential", {"none", "coulomb", "viscous", "spring", "spring_dashpot"}},
        {"tension", only(declared(f.cutTension, "allow", "cut"))},
        {"coulomb_bound", only("compression")},
        {"dashpot", only(declared(f.dashpotOutside, "inside", "outside"))},
        {"spring_reset", only(declared(f.springOnly, "total", "spring_only"))},
        {"spring_update", only(declared(f.springBefore, "after", "before"))},
        {"lever_arm", only(declared(f.leverMiddle, "radius", "overlap_middle"))},
        {"velocity_arm", only("lever_arm")},
        {"history", only("displacement")},
        {"damping_velocity", only(declared(f.lagged, "predicted", "lagged"))},
        {"integrator", only(declaredIntegrator())},
        {"rolling", rollingKinds},
        {"rolling_length", only(declared(f.rollLength - 1.0, "effective", "twice_effective"))},
        {"rolling_stiffness", only("length_square")},
        {"rolling_damper", only("constant")},
        {"rolling_load", only("compression")},
        {"rolling_dashpot", only(declared(f.rollDashpotOutside, "inside", "outside"))},
        {"rolling_reset", only(declared(f.rollSpringOnly, "total", "spring_only"))},
        {"cohesion", cohesionKinds},
        {"cohesion_area", only("lens")},
        {"jkr_end", only("largest_pull")},
        {"cohesion_load", only("without_pull")},
        {"unloading_stiffness", only(declared(f.lagDeepest, "current", "lagged"))}};
    Json settings = Json::array();
    if (f.threads != 0.0)
      settings.push_back({{"name", "threads"},
                          {"default", 1.0},
                          {"unit", "-"},
                          {"doc", "that share the work of a step"},
                          {"choices", Json::array()}});
    if (f.leverMiddle != 0.0 && f.declares != 0.0) options["plane_arm"] = only("surface");
    return {
        {"version", "1"},           {"effects", effects},
        {"law_options", options},   {"precisions", only(declared(f.floatState, "double", "float"))},
        {"instant_contacts", true}, {"accumulated_contacts", false},
        {"warm_handover", false},   {"checkpoints", true},
        {"sliding_flags", true},    {"settings", settings}};
  }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    World loaded = worldOf(scene, arrays, faults_);
    loaded.backwards = faults_.threads > 1.0 && settings.value("threads", 1.0) > 1.0;
    if (simulation_ && faults_.loadGrows != 0.0) loaded.rough = simulation_->world().disks;
    auto next = std::make_unique<Simulation>(std::move(loaded), faults_);
    if (simulation_ && faults_.loadRemembers != 0.0) next->takeSprings(*simulation_);
    simulation_ = std::move(next);
    before_ = loadsOf(*simulation_);
    wallSeconds_ = cpuSeconds_ = 0.0;
    advances_ = 0;
    shown_ = 0.0;
    const World& world = simulation_->world();
    const Law& law = world.law;
    bool moving = false;
    for (const Body& body : world.bodies) moving = moving || body.moves();
    Json effects = Json::array();
    for (const auto& [name, on] :
         {std::pair("normal_damping", law.gn > 0.0),
          {"friction", law.friction},
          {"tangential_spring", law.friction && law.spring},
          {"tangential_damping", law.friction && law.dashpot && law.gt != 0.0},
          {"rotation", world.turns},
          {"bottom_friction", world.plate.present},
          {"bottom_spin_friction", world.plate.present && world.plate.spin && world.turns},
          {"gravity", world.gravity.x != 0.0 || world.gravity.y != 0.0},
          {"moving_walls", moving},
          {"rolling_resistance", law.more.rolling != Rolling::none},
          {"cohesion", law.more.cohesion != Cohesion::none}})
      if (on) effects.push_back(name);
    return {{"engine", "planted"},
            {"version", "1"},
            {"dt", world.dt},
            {"precision", declared(faults_.floatState, "double", "float")},
            {"effects", effects},
            {"integrator", declaredIntegrator()},
            {"pairs", Json::array()},
            {"deviations", Json::array()},
            {"velocity_lag", declaresEuler() ? 0.5 * world.dt : 0.0}};
  }

  double advance(double t) {
    using Clock = std::chrono::steady_clock;
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    long long until = std::llround(t / simulation_->world().dt);
    const double reached = static_cast<double>(until) * simulation_->world().dt;
    if (everyNth(faults_.shortAdvanceEvery, ++advances_)) --until;
    if (faults_.mostSteps > 0.0)
      until = std::min(until, static_cast<long long>(simulation_->steps() + faults_.mostSteps));
    while (static_cast<long long>(simulation_->steps()) < until) {
      if (faults_.showLate != 0.0) before_ = loadsOf(*simulation_);
      simulation_->step();
    }
    wallSeconds_ += std::chrono::duration<double>(Clock::now() - wall).count();
    cpuSeconds_ += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    shown_ = reached;
    return reached;
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) {
    const Loads loads = faults_.showLate != 0.0 ? before_ : loadsOf(*simulation_);
    addDisks(arrays, *simulation_, faults_);
    if (contacts == "instant") addContacts(arrays, *simulation_, loads, faults_);
    const Json bodies = bodiesOf(*simulation_, loads, faults_);
    if (faults_.lookForgets != 0.0) simulation_->forgetSprings();
    const double time = faults_.shortAdvanceEvery > 0.0 ? shown_ : simulation_->now();
    return {{"position_time", time},
            {"velocity_time", time},
            {"contact_time", time},
            {"contact_interval", 0.0},
            {"bodies", bodies}};
  }

  void checkpoint(const std::string& path) { writeParts(path, *simulation_); }

  /// Reads a file that checkpoint() of the same scene wrote.
  void restore(const std::string& path) {
    readParts(path, *simulation_);
    simulation_->restored();
    before_ = loadsOf(*simulation_);
  }

  Json stats() const {
    return {{"steps", simulation_->steps()},
            {"contact_evaluations", simulation_->evaluations()},
            {"wall_seconds", wallSeconds_},
            {"cpu_seconds", cpuSeconds_},
            {"counters", Json::object()}};
  }

 private:
  /// Value that it declares for something changed: its own if it declares its changes, else the
  /// right one.
  const char* declared(double changed, const char* right, const char* done) const {
    return changed != 0.0 && faults_.declares != 0.0 ? done : right;
  }
  const char* declaredIntegrator() const {
    const char* const other = faults_.integrator == 1.0 ? "velocity_verlet" : "semi_implicit_euler";
    return declared(faults_.integrator, "position_verlet", other);
  }
  /// Its velocities are then half a step older than its positions.
  bool declaresEuler() const { return std::string(declaredIntegrator()) == "semi_implicit_euler"; }

  Faults faults_;
  std::unique_ptr<Simulation> simulation_;
  Loads before_;
  unsigned long long advances_ = 0;
  double shown_ = 0.0;  ///< the time that was said to be reached [s]
  double wallSeconds_ = 0.0, cpuSeconds_ = 0.0;
};

}  // namespace
}  // namespace crossgrain::planted

int main(int argc, char** argv) {
  using namespace crossgrain::planted;
  return servePlanted<PlantedEngine, Faults>("planted_engine", argc, argv);
}
