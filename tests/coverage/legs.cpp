#include "tests/coverage/legs.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "averaging/global.hpp"
#include "averaging/profiles.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::coverage {

namespace {

constexpr const char* engineName = "grain";

std::unique_ptr<Engine> makeEngine() {
  return findEngine(engineName)->make();
}

/// Chaos makes another trajectory of it long before averaging begins.
void nudge(Packing& packing, int index) {
  std::mt19937_64 generator(static_cast<std::uint64_t>(index));
  std::uniform_real_distribution<double> shift(-1e-8, 1e-8);
  for (std::size_t i = 0; i < packing.disks.size(); ++i)
    packing.disks.position[i] +=
        2.0 * packing.disks.radius[i] * Vec2(shift(generator), shift(generator));
}

WindowRun entry(int index, const Leg& leg, int window, double rotations,
                const ProfileAccumulator& averaged, const Numbers& coordination) {
  WindowRun run;
  run.engine = engineName;
  run.packing = index;
  run.without = leg.name;
  run.profiles = averaged.profiles();
  if (const auto mean = meanOf(coordination)) run.head = {{"coordination", "-", mean, {}, {}}};
  run.window = window;
  run.rotations = rotations;
  return run;
}

}  // namespace

const std::vector<Leg>& legs() {
  static const std::vector<Leg> all = {
      {"", [](Case&) {}},
      {"again", [](Case&) {}, true},
      {"kn_plus_10", [](Case& c) { c.law.kn *= 1.1; }},
      {"mu_minus_10", [](Case& c) { c.law.mu *= 0.9; }},
      {"tension_cut", [](Case& c) { c.law.conventions.tension = Tension::cut; }},
  };
  return all;
}

const Leg& leg(const std::string& name) {
  const auto found = std::ranges::find(legs(), name, &Leg::name);
  if (found == legs().end()) throw std::invalid_argument("coverage: there is no leg " + name);
  return *found;
}

Packing prepared(const Case& setup, int index) {
  const auto engine = makeEngine();
  return packingOf(setup, index, timeStep(setup), *engine, [](double) {});
}

std::vector<WindowRun> run(const Case& setup, const Packing& packing, int index, const Leg& leg,
                           int windows, bool whole) {
  Case planted = setup;
  leg.plant(planted);
  Packing start = packing;
  if (leg.nudged) nudge(start, index);
  const Scene scene = couetteScene(planted, start, timeStep(setup));
  const auto engine = makeEngine();
  engine->load(scene, {});

  const double rotation = rotationTime(setup);
  const double length = couetteIn(setup).times.rotations;
  const int samples =
      static_cast<int>(std::lround(length * couetteIn(setup).times.snapshotsPerRotation));
  const double interval = length * rotation / samples;
  double now = couetteIn(setup).times.settleRotations * rotation;
  const auto methods = weightsOf(setup, std::span(setup.averaging.methods).first(1));
  ProfileAccumulator all(ringsOf(setup), methods, scene);
  std::vector<WindowRun> entries;
  for (int window = 0; window < windows; ++window) {
    ProfileAccumulator averaged(ringsOf(setup), methods, scene);
    Numbers coordination;
    for (int k = 0; k < samples; ++k) {
      engine->advance(now += interval);
      const Snapshot snapshot = engine->snapshot(ContactReport::instant);
      averaged.add(snapshot);
      coordination.push_back(globalNumbers(scene, snapshot).coordination);
      if (whole) all.add(snapshot);
    }
    entries.push_back(entry(index, leg, window, length, averaged, coordination));
  }
  if (whole) entries.push_back(entry(index, leg, windows, windows * length, all, {}));
  return entries;
}

}  // namespace crossgrain::coverage
