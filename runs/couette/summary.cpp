#include "runs/couette/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/fits.hpp"
#include "averaging/regime.hpp"
#include "averaging/statistics.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

const Profile* find(const std::vector<Profile>& profiles, std::string_view field) {
  const auto found = std::ranges::find(profiles, field, &Profile::field);
  return found == profiles.end() ? nullptr : &*found;
}

std::optional<double> ringMean(const std::vector<Profile>& profiles, std::string_view field,
                               std::size_t ring) {
  const Profile* profile = find(profiles, field);
  return profile && ring < profile->mean.size() ? profile->mean[ring] : std::nullopt;
}

std::optional<double> meanOf(const json& list) {
  const std::vector<double> values = presentNumbers(list);
  if (values.empty()) return std::nullopt;
  return estimateMean(values).mean;
}

std::optional<double> largestOf(const json& list) {
  const std::vector<double> values = presentNumbers(list);
  if (values.empty()) return std::nullopt;
  return *std::ranges::max_element(values);
}

std::optional<double> times(const std::optional<double>& value, double factor) {
  if (!value) return std::nullopt;
  return *value * factor;
}

/// p = (σ_rr + σ_φφ)/2 of a ring [N/m²]; absent where it is not positive.
std::optional<double> pressure(const std::vector<Profile>& profiles, std::size_t ring) {
  const auto rr = ringMean(profiles, "stress_rr", ring);
  const auto pp = ringMean(profiles, "stress_pp", ring);
  if (!rr || !pp || *rr + *pp <= 0.0) return std::nullopt;
  return 0.5 * (*rr + *pp);
}

/// The pressure on the ring against σ_rr in the outermost ring along branches; why the field that
/// is averaged differs from the pressure, part by part.
std::optional<json> wallCheck(const Case& setup, const std::vector<Profile>& profiles,
                              const json& series, const std::vector<WallBalance>& wall) {
  const Profile* field = find(profiles, "stress_rr");
  const json& pressures = series["outer_pressure"];
  if (!field || !field->mean.back() || wall.empty() || pressures.size() != wall.size()) return {};
  const Rings rings = ringsOf(setup);
  const double nearer = rings.outerRadius() / rings.centre(rings.count() - 1);
  std::vector<double> pressure, along, hoop, wanted;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    if (!pressures[k].is_number()) continue;
    pressure.push_back(pressures[k].get<double>());
    along.push_back(wall[k].alongBranches);
    hoop.push_back(wall[k].hoopTerm);
    wanted.push_back(pressure.back() * nearer - hoop.back());
  }
  if (wanted.empty()) return {};
  const MeanEstimate found = estimateMean(along), expected = estimateMean(wanted);
  json check = {{"name", "wall_pressure"},
                {"label",
                 "σ_rr in the outermost ring, forces taken along branches, against P R_o/r − "
                 "∫(r − r₁)σ_φφ dr/(r Δr), which the pressure P on the ring calls for [N/m²]"},
                {"value", {found.mean}},
                {"reference", {expected.mean}},
                {"reference_stderr", toJson(expected.standardError)},
                {"stderr", {toJson(found.standardError)}}};
  const double p = estimateMean(pressure).mean;
  if (!(p > 0.0)) return check;
  const double hoopMean = estimateMean(hoop).mean;
  const auto percent = [p](double part) { return 100.0 * part / p; };
  check["note"] = fmt::format(
      "The averaged σ_rr of that ring ({}) is {:+.1f} % off P: {:+.1f} % as its mean radius is "
      "smaller than R_o, {:+.1f} % by the hoop stress in it, {:+.1f} % as the weights share a "
      "disk's "
      "stress otherwise than its branches do and disks at a wall all stand alike, {:+.1f} % left "
      "(what "
      "flows and accelerates).",
      field->method, percent(*field->mean.back() - p), percent((nearer - 1.0) * p),
      percent(-hoopMean), percent(*field->mean.back() - found.mean),
      percent(found.mean - expected.mean));
  return check;
}

json number(const std::string& name, const std::optional<double>& value) {
  return {{"name", name}, {"value", toJson(value)}, {"unit", "-"}};
}

}  // namespace

DistributionScales distributionScales(const Case& setup) {
  return {setup.cell.omega * setup.cell.innerRadius,
          1.0 / spinScale(ringsOf(setup), setup.cell.omega)};
}

double diskDensity(const Case& setup) {
  const Particles& disks = setup.particles;
  const double area = std::numbers::pi * disks.smallRadius * disks.smallRadius;
  return disks.smallMass / (area * setup.cell.height);
}

json headNumbers(const Case& setup, const std::vector<Profile>& profiles, const json& series,
                 const Realised& realised) {
  const double diameter = 2.0 * setup.particles.smallRadius;
  std::optional<double> stiffness, stressRatio, stepShare;
  // The engine's own k_n against the force p d h that the pressure sends through a disk, per
  // overlap d.
  const double kn = realised.pairs.empty() ? 0.0 : realised.pairs.front().kn;
  if (const auto p = pressure(profiles, 0); p && kn > 0.0)
    stiffness = kn / (*p * setup.cell.height);
  const auto rr = ringMean(profiles, "stress_rr", 0);
  const auto rp = ringMean(profiles, "stress_rp", 0);
  if (rr && rp && *rr > 0.0) stressRatio = *rp / *rr;
  if (realised.dt > 0.0 && setup.law.normal == NormalLaw::linear && !setup.particles.file)
    stepShare = realised.dt / contactTime(setup.law, lightestReducedMass(setup));
  return {number("inertial_number", inertialNumber(ringsOf(setup), profiles, diskDensity(setup))),
          number("kn_over_p", stiffness),
          number("mean_overlap_over_d", times(meanOf(series["mean_overlap"]), 1.0 / diameter)),
          number("max_overlap_over_d", times(largestOf(series["max_overlap"]), 1.0 / diameter)),
          number("sliding_fraction", meanOf(series["sliding_fraction"])),
          number("coordination", meanOf(series["coordination"])),
          number("stress_ratio_wheel", stressRatio),
          number("wheel_contacts", meanOf(series.value("wheel_contacts", json::array()))),
          number("wheel_slip", meanOf(series.value("wheel_slip", json::array()))),
          number("shear_share", meanOf(series.value("shear_share", json::array()))),
          number("dt_over_tc", stepShare)};
}

json couetteFits(const Case& setup, const std::vector<Profile>& profiles) {
  const Rings rings = ringsOf(setup);
  json fits = json::array();
  if (const Profile* shear = find(profiles, "stress_rp")) {
    // The outermost rings hold few contacts of each kind; the walls' rings feel ordering.
    std::vector<FitPoint> points = pointsOverRadius(rings, *shear);
    if (points.size() > 4) points = {points.begin() + 1, points.end() - 1};
    fits.push_back(fitJson(fitPowerLaw(points), "p", "stress_rp_exponent",
                           "exponent p of σ_rφ ∝ r^p", "-", -2.0));
  }
  if (const Profile* velocity = find(profiles, "azimuthal_velocity")) {
    const double wheel = setup.cell.omega * setup.cell.innerRadius;
    const Fit fit = fitVelocityDecay(pointsOverRTilde(rings, *velocity, 1.0 / wheel));
    fits.push_back(fitJson(fit, "A", "velocity_amplitude", "A of v_φ/(ΩR_i) = A exp(−r̃/B)", "-",
                           std::nullopt));
    fits.push_back(fitJson(fit, "B", "velocity_decay", "decay length B of v_φ", "d", std::nullopt));
  }
  if (const Profile* volume = find(profiles, "volume_fraction")) {
    const Fit fit = fitDilation(pointsOverRTilde(rings, *volume));
    fits.push_back(
        fitJson(fit, "nu0", "volume_fraction_outside", "ν₀ of ν = ν₀ − B exp(−C r̃)", "-", {}));
    fits.push_back(fitJson(fit, "B", "dilation", "dilation B at the wheel", "-", {}));
    fits.push_back(
        fitJson(fit, "C", "dilation_decay", "C, inverse width of the dilated zone", "1/d", {}));
  }
  if (const Profile* spin = find(profiles, "spin")) {
    const double scale = spinScale(rings, setup.cell.omega);
    fits.push_back({{"name", "spin_ring_1"},
                    {"label", "spin S d/(ΩD) in ring 1 (< 0: counter-rotates)"},
                    {"unit", "-"},
                    {"value", toJson(times(spin->mean[0], scale))},
                    {"stderr", toJson(times(spin->standardError[0], std::abs(scale)))},
                    {"reason", spin->mean[0] ? "" : "no disks in ring 1"},
                    {"expected", nullptr}});
  }
  return fits;
}

json spinFits(const Case& setup, const LayerSpin& spin) {
  const auto points = spin.points(spinScale(ringsOf(setup), setup.cell.omega));
  if (points.empty()) return json::array();
  const Fit fit = fitSpinOscillation(points);
  return {fitJson(fit, "A", "spin_amplitude", "A of S d/(ΩD) = A exp(−B r̃) cos(π r̃ + φ)", "-", {}),
          fitJson(fit, "B", "spin_decay", "B of the spin, inverse decay length", "1/d", {}),
          fitJson(fit, "phi", "spin_phase", "phase φ of the spin", "rad", {})};
}

json couetteChecks(const Case& setup, const std::vector<Profile>& profiles, const json& series,
                   const std::vector<WallBalance>& wall) {
  const Rings rings = ringsOf(setup);
  json checks = json::array();
  const Profile* shear = find(profiles, "stress_pr");
  const std::vector<double> torque = presentNumbers(series["wheel_torque"]);
  if (shear && !torque.empty()) {
    const MeanEstimate wheel = estimateMean(torque);
    std::vector<std::optional<double>> carried, error;
    for (int ring = 0; ring < rings.count(); ++ring) {
      const auto k = static_cast<std::size_t>(ring);
      const double r = rings.centre(ring);
      const double factor = 2.0 * std::numbers::pi * r * r * rings.height();
      const auto dynamic = ringMean(profiles, "dynamic_stress_rp", k);
      carried.push_back(shear->mean[k]
                            ? std::optional((*shear->mean[k] + dynamic.value_or(0.0)) * factor)
                            : std::nullopt);
      error.push_back(times(shear->standardError[k], factor));
    }
    checks.push_back({{"name", "torque_balance"},
                      {"label",
                       "torque carried at each ring, (σ_φr + dynamic)·2πr²h, against the "
                       "wheel's [N m]"},
                      {"value", toJson(carried)},
                      {"reference", std::vector<double>(carried.size(), wheel.mean)},
                      {"reference_stderr", toJson(wheel.standardError)},
                      {"stderr", toJson(error)}});
  }
  if (const auto check = wallCheck(setup, profiles, series, wall)) checks.push_back(*check);
  return checks;
}

}  // namespace crossgrain::inline runs
