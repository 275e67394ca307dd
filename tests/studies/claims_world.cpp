#include "claims_world.hpp"

#include <algorithm>

namespace crossgrain::test {
namespace {

/// Between −1 and 1, another one for each run.
double noiseOf(const ThesisCase& setup, int packing) {
  return std::sin(12.9898 * (1000.0 * setup.label + 7.0 * packing + setup.cell.omega) +
                  0.1 * static_cast<double>(setup.cell.large));
}

/// 0 at 0.789, 1 at 0.828.
double denseness(const ThesisCase& setup) {
  return (setup.label - 0.789) / 0.039;
}

bool inBand(double x) {
  return x < 5.0;
}

void addStresses(ThesisRun& run, const ThesisCase& setup, double noise) {
  const double t = denseness(setup), p = 0.2 * (1.0 + 9.0 * t) * (1.0 + 0.02 * noise);
  const auto shear = [=](double x) {
    return 0.25 * p / std::pow(1.0 + x * setup.cell.diameter / setup.cell.innerRadius, 2);
  };
  const auto set = [&](const char* field, const Shape& shape) {
    setField(run, setup, field, shape);
  };
  set("stress_rr", [=](double) { return p; });
  set("stress_pp", [=](double) { return 1.02 * p; });
  set("stress_rp", shear);
  set("stress_pr", [=](double x) { return 1.03 * shear(x); });
  set("stress_trace", [=](double) { return 2.02 * p; });
  set("stress_deviator",
      [=](double x) { return 2.02 * p * (0.3 - 0.1 * t) * (inBand(x) ? 1.0 : 0.5); });
  const auto moving = [=](double x) { return 1e-3 * p * std::exp(-x / 3.0); };
  set("dynamic_stress_rr", moving);
  set("dynamic_stress_pp", [=](double x) { return 2.0 * moving(x); });
  set("dynamic_stress_rp", [=](double x) { return 0.5 * moving(x); });
  set("couple_stress_zr",
      [=](double x) { return x < 1.0 ? 1e-5 * p : 1e-6 * p * std::sin(9.0 * x); });
}

void addStructure(ThesisRun& run, const ThesisCase& setup, double noise) {
  const double t = denseness(setup);
  const auto trace = [=](double x) {
    return (2.0 + t - (inBand(x) ? 0.8 - 0.1 * x : 0.0) - (x > 19.0 ? 0.3 : 0.0)) *
           (1.0 + 0.01 * noise);
  };
  const auto set = [&](const char* field, const Shape& shape) {
    setField(run, setup, field, shape);
  };
  const auto degrees = [](double angle) { return [=](double) { return angle * pi / 180.0; }; };
  set("volume_fraction", [](double) { return 0.8; });
  set("density", [](double) { return 900.0; });
  set("fabric_trace", trace);
  set("coordination", [=](double x) { return trace(x) / 0.8; });
  set("fabric_deviator",
      [=](double x) { return trace(x) * (0.2 - 0.1 * t) * (inBand(x) ? 1.0 : 0.4); });
  set("fabric_angle", degrees(55.0 + noise));
  set("stress_angle", degrees(50.0 + noise));
  set("strain_angle", degrees(45.0 + noise));
  const auto strain = [=](double x) { return 1e-4 * (inBand(x) ? 1.5 - 0.4 * t : 1.0); };
  set("strain_trace", strain);
  set("strain_deviator", [=](double x) { return 0.1 * (1.0 + 0.01 * noise) * strain(x); });
  set("mean_field_modulus", [=](double x) { return 9000.0 * trace(x); });
  set("bulk_modulus", [=](double x) { return 9000.0 * trace(x) * (1.04 + 0.005 * noise); });
  set("shear_modulus",
      [=](double x) { return 9000.0 * trace(x) * (1.0 + 0.02 * noise) * (inBand(x) ? 1.0 : 3.0); });
  set("torque_resistance", [=](double x) { return 7000.0 * trace(x); });
}

void addMotion(ThesisRun& run, const ThesisCase& setup, double noise) {
  const double t = denseness(setup), omega = setup.cell.omega;
  const double wheel = omega * setup.cell.innerRadius;
  const double amplitude = (0.4 + 0.2 * t) * (1.0 + 0.01 * noise);
  const double spinScale = omega * 2.0 * setup.cell.innerRadius / setup.cell.diameter;
  const auto spin = [=](double x) {
    return spinScale * (1.0 + 0.01 * noise) * 0.24 * std::exp(-1.46 * x) * std::cos(pi * x + 1.79);
  };
  double mean = 0.0;
  for (int k = 0; k < 4; ++k) mean += 0.25 * spin((k + 0.5) * 1.008);
  const auto set = [&](const char* field, const Shape& shape) {
    setField(run, setup, field, shape);
  };
  set("azimuthal_velocity", [=](double x) { return wheel * amplitude * std::exp(-x / 1.5); });
  set("spin", spin);
  set("continuum_rotation", [=](double) { return 0.9 * mean; });
  set("excess_rotation", [=](double x) {
    return omega * (static_cast<int>(x) % 2 == 1 ? 1.0 : -1.0) * std::exp(-x / 2.0);
  });
  set("radial_velocity", [=](double) { return 1e-6 * noise * wheel; });
  set("fluctuation_stress_rr", [=](double x) {
    return 900.0 * std::pow(wheel * (0.1 * std::exp(-x / 4.0) + 0.005), 2) * (1.0 + 0.01 * noise);
  });
  setFit(run, "velocity_amplitude", amplitude);
  setFit(run, "velocity_decay", 1.5 * (1.0 + 0.01 * noise));
  setFit(run, "volume_fraction_outside", 0.845 + 0.001 * noise);
  setFit(run, "dilation", 0.25 + 0.001 * noise);
  setFit(run, "dilation_decay", 1.0 / (5.5 + 0.02 * noise));
  setFit(run, "spin_amplitude", 0.24 + 0.002 * noise);
  setFit(run, "spin_decay", 1.46 + 0.01 * noise);
  setFit(run, "spin_phase", 1.79 + 0.01 * noise);
  const auto layers = [](double height) {
    return [=](double x) { return 0.8 + height * std::sin(2.0 * pi * x + 0.3); };
  };
  run.run.profiles.push_back(
      profileOfShape("centre", "volume_fraction", setup, worldRings, layers(0.01 + 0.001 * noise)));
  RingAverages fine;
  fine.rings = 60;
  fine.profiles = {
      profileOfShape("slicing", "volume_fraction", setup, 60, layers(0.1)),
      profileOfShape("centre", "volume_fraction", setup, 60, layers(0.6 + 0.01 * noise)),
      profileOfShape("centre", "spin", setup, 60, spin)};
  run.finer.push_back(fine);
}

void addDistributions(ThesisRun& run, const ThesisCase& setup, double noise) {
  const double rest = 2.0 * (1.0 - 0.5 * denseness(setup)) * (1.0 + 0.005 * noise);
  setDistribution(run, "azimuthal_velocity_and_spin", {}, jointAxes, [=](double v, double s) {
    const double peak = rest * std::exp(-40.0 * (v * v + s * s));
    return 0.05 + peak + std::exp(-100.0 * std::pow(v - 1.0 - s, 2));
  });
  setDistribution(run, "azimuthal_velocity", 0, velocityAxis, [=](double v, double) {
    return 0.2 + rest * std::exp(-60.0 * v * v) + std::exp(-40.0 * std::pow(v - 0.5, 2)) +
           0.3 * std::exp(-100.0 * std::pow(v - 1.0, 2));
  });
  for (int ring = 0; ring < worldRings; ++ring)
    setDistribution(run, "contact_direction", ring, directionAxis, [=](double angle, double) {
      if (ring == worldRings - 1)
        return (1.0 + (0.4 + 0.01 * noise) * std::cos(6.0 * (angle - pi / 6.0))) / 2.0 / pi;
      const double strength = ring < 4 ? 0.35 + 0.01 * noise : 0.05;
      return (1.0 + strength * std::cos(2.0 * (angle - pi / 3.0))) / 2.0 / pi;
    });
}

void addHistory(ThesisRun& run, const ThesisCase& setup, double noise, int packing) {
  // The transition itself: one packing in three carries at 0.793.
  const bool carries = setup.label > 0.7935 || (setup.label > 0.7925 && packing % 3 == 0);
  for (int rotation = 0; rotation < 20; ++rotation) {
    ThesisSpan& span = run.history.emplace_back();
    span.from = rotation;
    span.to = rotation + 1;
    span.outerPressure = (1.0 + 9.0 * denseness(setup)) * (1.0 + 0.05 * noise);
    span.wheelContacts = carries || rotation < 3 ? 20.0 : 0.0;
    span.volumeFractionAtWheel = 0.6 + 0.002 * noise + 0.15 * std::exp(-rotation);
    span.volumeFractionOutside = 0.84 + 0.001 * std::exp(-rotation);
  }
}

}  // namespace

ThesisRun worldRun(const ThesisCase& setup, int packing) {
  const double noise = noiseOf(setup, packing);
  ThesisRun run;
  run.setup = setup.name;
  run.engine = "engine";
  run.packing = packing;
  run.run.engine = run.engine;
  addStresses(run, setup, noise);
  addStructure(run, setup, noise);
  addMotion(run, setup, noise);
  addDistributions(run, setup, noise);
  addHistory(run, setup, noise, packing);
  run.run.regime.emplace();
  run.run.regime->wheelContacts = 20.0;
  run.run.regime->blockedFraction = (setup.label > 0.8095 ? 0.8 : 0.1) + 0.02 * noise;
  setHead(run, "max_overlap_over_d", 1e-7 / setup.cell.diameter * (1.0 + 0.1 * noise));
  setHead(run, "mean_overlap_over_d", 1e-8 / setup.cell.diameter);
  run.run.effective.emplace();
  run.run.effective->dt = 4e-5;
  run.run.stats.emplace();
  run.run.stats->steps = 1'000'000;
  run.run.stats->cpuSeconds = 800.0 * (1.0 + 0.1 * noise);
  return run;
}

ThesisResults world(int packings) {
  ThesisResults results;
  const auto add = [&](const ThesisCase& setup) { results.cases.push_back(setup); };
  for (const TableRow& of : table32)
    add(worldCase(of, fmt::format("nu-{}-{}", of.nu, of.large), "packings"));
  for (const std::size_t k : {3, 8, 14})
    for (const double omega : {0.01, 0.03, 0.1, 0.3, 1.0})
      add(worldCase(table32[k], fmt::format("omega-{}-{}", omega, table32[k].nu), "rate", omega));
  ThesisCase soft = worldCase(table32[8], "kn-half", "kn");
  soft.kn = 176.05;
  ThesisCase slippery = worldCase(table32[8], "no-friction", "friction");
  slippery.mu = 0.0;
  ThesisCase smooth = worldCase(table32[8], "no-bottom", "bottom");
  smooth.bottomFriction = false;
  ThesisCase wide = worldCase(table32[8], "spacing-7mm", "spacing");
  wide.cell.wallSpacing = 0.007;
  for (const ThesisCase& setup : {soft, slippery, smooth, wide}) add(setup);
  for (const ThesisCase& setup : results.cases)
    for (int packing = 0; packing < packings; ++packing)
      results.runs.push_back(worldRun(setup, packing));
  return results;
}

void changeAll(ThesisResults& results, const Change& change) {
  for (ThesisRun& run : results.runs)
    change(run, *std::ranges::find(results.cases, run.setup, &ThesisCase::name));
}

void changeOne(ThesisResults& results, const Change& change) {
  changeAll(results, [&](ThesisRun& run, const ThesisCase& setup) {
    const bool examined = setup.name == "nu-0.804-410" || setup.name == "nu-0.796-407" ||
                          setup.name == "omega-0.01-0.804" || setup.name == "nu-0.81-407";
    if (examined && run.packing == 0) change(run, setup);
  });
}

ClaimRow rowOf(const std::vector<ClaimRow>& rows, const std::string& id,
               const std::string& interpretation) {
  for (const ClaimRow& row : rows)
    if (row.id == id && row.interpretation.starts_with(interpretation)) return row;
  ADD_FAILURE() << "no row of " << id << ", " << interpretation;
  return {};
}

}  // namespace crossgrain::test
