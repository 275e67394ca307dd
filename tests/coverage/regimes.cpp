// coverage_regimes CASE FIRST LAST [KEY=VALUE …] >> regimes.jsonl
//   the regime of packings FIRST … LAST of a Couette case on the in-house engine, one line of JSON
//   each, and at the end, to stderr, how many block and how many may (95 %, one-sided)
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "adapters/registry.hpp"
#include "averaging/global.hpp"
#include "averaging/profiles.hpp"
#include "averaging/regime.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"

namespace {

using namespace crossgrain;
using nlohmann::json;

constexpr const char* engineName = "grain";

json toJson(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

json regimeOfPacking(const Case& setup, int index) {
  const auto engine = findEngine(engineName)->make();
  const double dt = timeStep(setup);
  const Packing packing = packingOf(setup, index, dt, *engine, [](double) {});
  const Scene scene = couetteScene(setup, packing, dt);
  engine->load(scene, {});

  const Rings rings(setup.cell.innerRadius, setup.cell.outerRadius, setup.averaging.rings,
                    setup.cell.height, 2.0 * setup.particles.smallRadius);
  ProfileAccumulator averaged(rings, {Weight(WeightMethod::slicing)}, scene);
  const double rotation = 2.0 * std::numbers::pi / std::abs(setup.cell.omega);
  const double length = setup.averaging.rotations;
  const int samples = static_cast<int>(std::lround(length * setup.averaging.snapshotsPerRotation));
  double now = setup.averaging.settleRotations * rotation;
  RegimeFigures figures;
  WheelMotion motion;
  double contacts = 0.0;
  std::vector<double> shear, pressure;
  for (int k = 0; k < samples; ++k) {
    engine->advance(now += length * rotation / samples);
    const Snapshot snapshot = engine->snapshot(ContactReport::instant);
    averaged.add(snapshot);
    contacts += contactsOf(scene, snapshot, wheelName).value_or(0.0) / samples;
    pressure.push_back(
        radialPressure(scene, snapshot, ringName, setup.cell.outerRadius, setup.cell.height)
            .value_or(0.0));
    const auto momentary = wheelMotion(scene, snapshot, rings, setup.cell.omega);
    if (!momentary) continue;
    motion.slip += momentary->slip / samples;
    motion.shear += momentary->shear / samples;
    shear.push_back(momentary->shear);
  }
  const Particles& disks = setup.particles;
  const double area = std::numbers::pi * disks.smallRadius * disks.smallRadius;
  const auto profiles = averaged.profiles();
  figures.wheelContacts = contacts;
  if (!shear.empty()) figures.motion = motion;
  figures.inertialNumber =
      inertialNumber(rings, profiles, disks.smallMass / (area * setup.cell.height));
  // Windows in which the rim passes one disk.
  const double window = samples * 2.0 * disks.smallRadius /
                        (2.0 * std::numbers::pi * length * setup.cell.innerRadius);
  figures.blockedFraction = blockedFraction(shear, static_cast<std::size_t>(std::lround(window)));
  const RegimeVerdict verdict = regimeOf(figures);
  double outer = 0.0;
  for (const double p : pressure) outer += p / samples;
  return {{"packing", index},
          {"regime", verdict.regime ? toString(*verdict.regime) : "unknown"},
          {"wheel_contacts", contacts},
          {"wheel_slip", motion.slip},
          {"shear_share", motion.shear},
          {"inertial_number", toJson(figures.inertialNumber)},
          {"blocked_share", toJson(figures.blockedFraction)},
          {"outer_pressure", outer}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw BadInput("usage: coverage_regimes CASE FIRST LAST [KEY=VALUE …]");
    const Case setup = loadCase(argv[1], {argv + 4, argv + argc}).front();
    int blocked = 0, packings = 0;
    for (int index = std::stoi(argv[2]); index <= std::stoi(argv[3]); ++index) {
      const json entry = regimeOfPacking(setup, index);
      std::cout << entry << std::endl;
      ++packings;
      blocked += entry["regime"] == "blocked";
    }
    // Clopper and Pearson (1934).
    const double most =
        blocked == packings ? 1.0 : gsl_cdf_beta_Pinv(0.95, blocked + 1, packings - blocked);
    std::cerr << fmt::format("{} of {} packings blocked; at most {:.2g} % do (95 %)\n", blocked,
                             packings, 100.0 * most);
  } catch (const std::exception& error) {
    std::cerr << "coverage_regimes: " << error.what() << '\n';
    return 2;
  }
}
