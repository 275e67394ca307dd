#include <cmath>
#include <map>
#include <numbers>

#include "results/schema.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

constexpr double wheelRadius = 0.1032, ringRadius = 0.2524, smallDiameter = 0.0074, wheelRate = 0.1,
                 cellHeight = 0.006;

/// Fields of made-up physics over r̃, the same for all engines but for a factor.
std::map<std::string, double (*)(double x, double nu)> thesisShapes() {
  using std::exp;
  return {
      {"volume_fraction", [](double x, double nu) { return nu - 0.2 * exp(-x); }},
      {"azimuthal_velocity",
       [](double x, double) { return wheelRate * wheelRadius * 0.6 * exp(-x / 1.9); }},
      {"spin",
       [](double x, double) { return 2.0 * exp(-x) * std::cos(std::numbers::pi * x + 1.8); }},
      {"density", [](double, double nu) { return 1000.0 * nu; }},
      {"coordination", [](double x, double) { return 3.5 - exp(-x); }},
      {"fabric_trace", [](double x, double nu) { return (3.5 - exp(-x)) * (nu - 0.2 * exp(-x)); }},
      {"fabric_deviator", [](double x, double) { return 0.8 * exp(-0.1 * x); }},
      {"fabric_angle", [](double, double) { return 1.0; }},
      {"stress_angle", [](double, double) { return 0.8; }},
      {"strain_angle", [](double, double) { return 0.7; }},
      {"dynamic_stress_rr", [](double x, double) { return 1e-3 * exp(-x); }},
      {"dynamic_stress_pp", [](double x, double) { return 2e-3 * exp(-x); }},
      {"dynamic_stress_rp", [](double x, double) { return -5e-4 * exp(-x); }},
      {"fluctuation_stress_rr", [](double x, double) { return 5e-4 * exp(-x); }},
      {"fluctuation_stress_pp", [](double x, double) { return 5e-4 * exp(-x); }},
      {"shear_rate", [](double x, double) { return -0.5 * exp(-x / 1.9); }},
      {"stress_rr", [](double, double nu) { return 1e3 * (nu - 0.78); }},
      {"stress_pp", [](double, double nu) { return 1e3 * (nu - 0.78); }},
      {"stress_rp",
       [](double x, double nu) {
         return 250.0 * (nu - 0.78) / std::pow(1.0 + x * smallDiameter / wheelRadius, 2);
       }},
      {"stress_pr",
       [](double x, double nu) {
         return 260.0 * (nu - 0.78) / std::pow(1.0 + x * smallDiameter / wheelRadius, 2);
       }},
      {"stress_trace", [](double, double nu) { return 2e3 * (nu - 0.78); }},
      {"stress_deviator", [](double x, double nu) { return 500.0 * (nu - 0.78) * exp(-0.1 * x); }},
      {"strain_trace", [](double, double nu) { return 1e-2 * (nu - 0.78); }},
      {"strain_deviator", [](double, double nu) { return 2e-3 * (nu - 0.78); }},
      {"bulk_modulus", [](double, double) { return 2.0e5; }},
      {"shear_modulus", [](double x, double) { return x < 8.0 ? 1.0e5 : 9.0e5; }},
      {"continuum_rotation", [](double x, double) { return -0.4 * exp(-x / 1.9); }},
      {"excess_rotation", [](double x, double) { return 0.3 * exp(-x) * std::cos(3.0 * x); }},
      {"couple_stress_zr", [](double x, double) { return 5e-4 * exp(-x); }},
      {"curvature_zr", [](double x, double) { return 7e-5 * exp(-x); }},
      {"torque_resistance", [](double x, double) { return 100.0 + 20.0 * x; }},
  };
}

std::vector<Profile> thesisProfiles(int count, double nu, double factor, RingPlaces& where) {
  where = {};
  std::vector<Profile> profiles;
  for (const char* method : {"slicing", "centre"})
    for (const auto& [field, shape] : thesisShapes()) {
      Profile profile{method, field, "", {}, {}, {}, {}};
      for (int k = 0; k < count; ++k) {
        const double r = wheelRadius + (k + 0.5) * (ringRadius - wheelRadius) / count;
        const double value = factor * shape((r - wheelRadius) / smallDiameter, nu);
        profile.mean.push_back(value);
        profile.standardError.push_back(0.01 * std::abs(value));
      }
      profiles.push_back(std::move(profile));
    }
  for (int k = 0; k < count; ++k) {
    where.r.push_back(wheelRadius + (k + 0.5) * (ringRadius - wheelRadius) / count);
    where.rTilde.push_back((where.r.back() - wheelRadius) / smallDiameter);
  }
  return profiles;
}

Distribution bell(const char* quantity, int ring, double spread) {
  Distribution one{quantity, ring, {{-1.5, 0.06, 50}}, {}, {}, 0.0, 1000.0};
  for (int k = 0; k < 50; ++k) {
    const double x = (-1.5 + (k + 0.5) * 0.06) / spread;
    one.density.push_back(std::exp(-0.5 * x * x) / (spread * std::sqrt(2.0 * std::numbers::pi)));
  }
  return one;
}

std::vector<Distribution> thesisDistributions() {
  std::vector<Distribution> all;
  for (const int ring : {0, 12}) {
    all.push_back(bell("radial_velocity", ring, ring == 0 ? 0.2 : 0.1));
    all.push_back(bell("azimuthal_velocity", ring, 0.3));
    all.push_back(bell("spin", ring, 0.3));
    Distribution directions{"contact_direction",
                            ring,
                            {{-std::numbers::pi, std::numbers::pi / 18.0, 36}},
                            {},
                            {},
                            0.0,
                            1e3};
    for (int k = 0; k < 36; ++k)
      directions.density.push_back((k == 26 ? 2.0 : 1.0) / (2.0 * std::numbers::pi));
    all.push_back(std::move(directions));
  }
  Distribution joint{"azimuthal_velocity_and_spin",
                     {},
                     {{-0.5, 0.04, 50}, {-1.5, 0.06, 50}},
                     std::vector(2500, 0.1),
                     {},
                     0.0,
                     1e3};
  joint.density[25 * 50 + 12] = 9.0;  // v_φ = 0, S = 0.03
  all.push_back(std::move(joint));
  return all;
}

ThesisCase thesisLeg(const std::string& name, double label) {
  ThesisCase setup;
  setup.name = name;
  setup.families = {"packings"};
  setup.label = label;
  setup.kn = 352.1;
  setup.mu = 0.44;
  setup.cell.small = static_cast<std::size_t>(std::lround(1e4 * label));
  setup.cell.innerRadius = wheelRadius;
  setup.cell.outerRadius = ringRadius;
  setup.cell.diameter = smallDiameter;
  setup.cell.height = cellHeight;
  setup.cell.omega = wheelRate;
  setup.settleRotations = 5.0;
  setup.averagedRotations = 3.0;
  return setup;
}

}  // namespace

ThesisResults thesisResults() {
  ThesisResults results;
  results.head.kind = "thesis";
  for (const double label :
       {0.789, 0.796, 0.798, 0.800, 0.804, 0.807, 0.809, 0.810, 0.811, 0.819, 0.828}) {
    const ThesisCase setup = thesisLeg("nu-" + std::to_string(label).substr(0, 5), label);
    const auto add = [&](const char* engine, int packing, double factor) {
      ThesisRun run;
      run.setup = setup.name;
      run.engine = engine;
      run.packing = packing;
      RingPlaces where;
      run.run.profiles = thesisProfiles(20, label, factor, where);
      RingAverages finer;
      finer.rings = 60;
      finer.profiles = thesisProfiles(60, label, factor, finer.places);
      run.finer = {std::move(finer)};
      run.run.distributions = thesisDistributions();
      const auto fit = [&](const char* name, double value) {
        FitRow row;
        row.name = name;
        row.value = value;
        run.run.fits.push_back(row);
      };
      fit("volume_fraction_outside", label + 0.03);
      fit("dilation", 0.2);
      fit("dilation_decay", 0.5);
      for (int k = 0; k < 8; ++k) {
        ThesisSpan span;
        span.from = k;
        span.to = k + 1.0;
        span.volumeFractionAtWheel = 0.7 - 0.1 * k / 8.0;
        span.volumeFractionOutside = label;
        span.wheelContacts = label < 0.8 && k > 3 ? 0.2 : 20.0;
        span.outerPressure = 1e3 * (label - 0.78);
        run.history.push_back(span);
      }
      results.runs.push_back(std::move(run));
    };
    add("alpha", 0, 1.0);
    add("alpha", 1, 1.1);
    if (label < 0.805) add("beta", 0, 1.05);
    results.cases.push_back(setup);
  }
  return results;
}

ThesisResults thesisClaims() {
  ThesisResults results;
  results.head.schema = schemaVersion;
  results.head.kind = "thesis";
  results.engines = {{"grain", "", "", "", Status::finished, ""},
                     {"yade", "", "", "", Status::finished, ""}};
  for (int k = 1; k <= 27; ++k)
    for (const char* engine : {"grain", "yade", "-"}) {
      if ((std::string_view(engine) == "-") != (k == 2)) continue;
      ClaimRow claim;
      claim.id = "C" + std::to_string(k);
      claim.claim = "The band is five diameters wide wherever the shear stress falls off.";
      claim.engine = engine;
      claim.interpretation = "default: wall spacing 2.5 mm";
      claim.verdict = std::array{Verdict::pass, Verdict::fail, Verdict::undecided}[k % 3];
      claim.figures = {{"exponent of σ_rφ in the bulk", "d", -1.98, 0.02, -2.25, -1.75}};
      claim.figures.front().verdict = claim.verdict;
      claim.why = "it is −1.98";
      if (k % 6 == 1) claim.reasons = {"The whole claim is reproduced under tension cut."};
      results.claims.push_back(claim);
      claim.interpretation = "wall spacing 7 mm";
      claim.verdict = Verdict::pass;
      results.claims.push_back(std::move(claim));
    }
  return results;
}

}  // namespace crossgrain::sample
