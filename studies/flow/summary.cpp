#include "studies/flow/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/fits.hpp"
#include "averaging/regime.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "cases/time_step.hpp"
#include "results/run.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

namespace {

std::optional<double> ringMean(const std::vector<Profile>& profiles, std::string_view field,
                               std::size_t ring) {
  const Profile* profile = profileOf(profiles, field);
  return profile && ring < profile->mean.size() ? profile->mean[ring] : std::nullopt;
}

std::optional<double> largestOf(const Numbers& list) {
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
std::optional<CheckRow> wallCheck(const Case& setup, const std::vector<Profile>& profiles,
                                  const RunSeries& series, const std::vector<WallBalance>& wall) {
  const Profile* field = profileOf(profiles, "stress_rr");
  const Numbers& pressures = valuesOf(series, "outer_pressure");
  if (!field || !field->mean.back() || wall.empty() || pressures.size() != wall.size()) return {};
  const Rings rings = ringsOf(setup);
  const double nearer = rings.outerRadius() / rings.centre(rings.count() - 1);
  std::vector<double> pressure, along, hoop, target;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    if (!pressures[k]) continue;
    pressure.push_back(*pressures[k]);
    along.push_back(wall[k].alongBranches);
    hoop.push_back(wall[k].hoopTerm);
    target.push_back(pressure.back() * nearer - hoop.back());
  }
  if (target.empty()) return {};
  const MeanEstimate found = estimateMean(along), expected = estimateMean(target);
  CheckRow check{"wall_pressure",
                 "σ_rr in the outermost ring, forces taken along branches, against P R_o/r − "
                 "∫(r − r₁)σ_φφ dr/(r Δr), which the pressure P on the ring calls for [N/m²]",
                 {found.mean},
                 {found.standardError},
                 {expected.mean},
                 expected.standardError,
                 {}};
  const double p = estimateMean(pressure).mean;
  if (!(p > 0.0)) return check;
  const double hoopMean = estimateMean(hoop).mean;
  const auto percent = [p](double part) { return 100.0 * part / p; };
  check.note = fmt::format(
      "The averaged σ_rr of that ring ({}) is {:+.1f} % off P: {:+.1f} % as its mean radius is "
      "smaller than R_o, {:+.1f} % by the hoop stress in it, {:+.1f} % as the weights share a "
      "disk's stress otherwise than its branches do and disks at a wall all stand alike, {:+.1f} % "
      "left (what flows and accelerates).",
      field->method, percent(*field->mean.back() - p), percent((nearer - 1.0) * p),
      percent(-hoopMean), percent(*field->mean.back() - found.mean),
      percent(found.mean - expected.mean));
  return check;
}

/// A parameter of a fit, or why there is none; χ²/dof where the points have errors.
FitRow fitRow(const Fit& fit, const std::string& parameter, const std::string& name,
              const std::string& label, const std::string& unit,
              std::optional<double> expected = {}) {
  FitRow row;
  row.name = name;
  row.label = label;
  row.unit = unit;
  row.reason = fit.reason;
  row.expected = expected;
  if (!fit.converged) return row;
  const auto found = std::ranges::find(fit.parameters, parameter, &FitParameter::name);
  if (found == fit.parameters.end()) throw std::logic_error("no fit parameter " + parameter);
  row.value = found->value;
  if (found->period > 0.0) row.period = found->period;
  row.standardError = found->standardError;
  if (fit.weighted) row.chi2PerDof = fit.chi2 / fit.dof;
  return row;
}

/// ρ of a small disk [kg/m³].
double diskDensity(const Case& setup) {
  const Particles& disks = couetteIn(setup).particles;
  const double area = std::numbers::pi * disks.smallRadius * disks.smallRadius;
  return disks.smallMass / (area * couetteIn(setup).cell.height);
}

/// Samples in the time in which the wheel's rim passes one disk, at least one.
std::size_t rimPassesADisk(const Case& setup, const RunSeries& series) {
  const std::vector<double> times = presentNumbers(valuesOf(series, "t_s"));
  if (times.size() < 2) return 1;
  const double interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double rim = couetteIn(setup).cell.rimSpeed();
  const double window = 2.0 * couetteIn(setup).particles.smallRadius / rim / interval;
  return static_cast<std::size_t>(std::max(1L, std::lround(window)));
}

}  // namespace

std::vector<double> presentNumbers(const Numbers& values) {
  std::vector<double> present;
  for (const auto& value : values)
    if (value) present.push_back(*value);
  return present;
}

std::optional<double> meanOf(const Numbers& values) {
  const std::vector<double> present = presentNumbers(values);
  if (present.empty()) return std::nullopt;
  return estimateMean(present).mean;
}

DistributionScales distributionScales(const Case& setup) {
  const Cell& cell = couetteIn(setup).cell;
  return {cell.omega * cell.innerRadius, 1.0 / spinScale(ringsOf(setup), cell.omega)};
}

std::vector<HeadNumber> headNumbers(const Case& setup, const std::vector<Profile>& profiles,
                                    const RunSeries& series, const EffectiveParameters& effective) {
  const double diameter = 2.0 * couetteIn(setup).particles.smallRadius;
  std::optional<double> stiffness, stressRatio, stepFraction;
  // The engine's own k_n against the force p d h that the pressure sends through a disk, per
  // overlap d.
  const double kn = effective.pairs.empty() ? 0.0 : effective.pairs.front().kn;
  if (const auto p = pressure(profiles, 0); p && kn > 0.0)
    stiffness = kn / (*p * couetteIn(setup).cell.height);
  const auto rr = ringMean(profiles, "stress_rr", 0);
  const auto rp = ringMean(profiles, "stress_rp", 0);
  if (rr && rp && *rr > 0.0) stressRatio = *rp / *rr;
  if (effective.dt > 0.0 && setup.law.normal == NormalLaw::linear && !packingFile(setup))
    stepFraction = effective.dt / shortestContact(setup);
  const auto number = [](const char* name, const std::optional<double>& value) {
    return HeadNumber{name, "-", value, {}, {}};
  };
  const auto mean = [&](const char* name) { return meanOf(valuesOf(series, name)); };
  return {number("inertial_number", inertialNumber(ringsOf(setup), profiles, diskDensity(setup))),
          number("kn_over_p", stiffness),
          number("mean_overlap_over_d", times(mean("mean_overlap"), 1.0 / diameter)),
          number("max_overlap_over_d",
                 times(largestOf(valuesOf(series, "max_overlap")), 1.0 / diameter)),
          number("sliding_fraction", mean("sliding_fraction")),
          number("coordination", mean("coordination")),
          number("stress_ratio_wheel", stressRatio),
          number("wheel_contacts", mean("wheel_contacts")),
          number("wheel_slip", mean("wheel_slip")),
          number("shear_share", mean("shear_share")),
          number("dt_over_tc", stepFraction)};
}

std::vector<FitRow> couetteFits(const Case& setup, const std::vector<Profile>& profiles) {
  const Cell& cell = couetteIn(setup).cell;
  const Rings rings = ringsOf(setup);
  std::vector<FitRow> fits;
  if (const Profile* shear = profileOf(profiles, "stress_rp")) {
    // The outermost rings hold few contacts of each kind; the walls' rings feel ordering.
    std::vector<FitPoint> points = pointsOverRadius(rings, *shear);
    if (points.size() > 4) points = {points.begin() + 1, points.end() - 1};
    fits.push_back(fitRow(fitPowerLaw(points), "p", "stress_rp_exponent",
                          "exponent p of σ_rφ ∝ r^p", "-", -2.0));
  }
  if (const Profile* velocity = profileOf(profiles, "azimuthal_velocity")) {
    const double wheel = cell.omega * cell.innerRadius;
    const Fit fit = fitVelocityDecay(pointsOverRTilde(rings, *velocity, 1.0 / wheel));
    fits.push_back(fitRow(fit, "A", "velocity_amplitude", "A of v_φ/(ΩR_i) = A exp(−r̃/B)", "-"));
    fits.push_back(fitRow(fit, "B", "velocity_decay", "decay length B of v_φ", "d"));
  }
  if (const Profile* volume = profileOf(profiles, "volume_fraction")) {
    const Fit fit = fitDilation(pointsOverRTilde(rings, *volume));
    fits.push_back(
        fitRow(fit, "nu0", "volume_fraction_outside", "ν₀ of ν = ν₀ − B exp(−C r̃)", "-"));
    fits.push_back(fitRow(fit, "B", "dilation", "dilation B at the wheel", "-"));
    fits.push_back(
        fitRow(fit, "C", "dilation_decay", "C, inverse width of the dilated zone", "1/d"));
  }
  if (const Profile* spin = profileOf(profiles, "spin")) {
    const double scale = spinScale(rings, cell.omega);
    FitRow row;
    row.name = spinInRing1;
    row.label = "spin S d/(ΩD) in ring 1 (< 0: counter-rotates)";
    row.unit = "-";
    row.value = times(spin->mean[0], scale);
    row.standardError = times(spin->standardError[0], std::abs(scale));
    if (!row.value) row.reason = "no disks in ring 1";
    fits.push_back(std::move(row));
  }
  return fits;
}

std::vector<FitRow> spinFits(const Case& setup, const LayerSpin& spin) {
  const auto points = spin.points(spinScale(ringsOf(setup), couetteIn(setup).cell.omega));
  if (points.empty()) return {};
  const Fit fit = fitSpinOscillation(points);
  return {fitRow(fit, "A", "spin_amplitude", "A of S d/(ΩD) = A exp(−B r̃) cos(π r̃ + φ)", "-"),
          fitRow(fit, "B", "spin_decay", "B of the spin, inverse decay length", "1/d"),
          fitRow(fit, "phi", "spin_phase", "phase φ of the spin", "rad")};
}

std::vector<CheckRow> couetteChecks(const Case& setup, const std::vector<Profile>& profiles,
                                    const RunSeries& series, const std::vector<WallBalance>& wall) {
  const Rings rings = ringsOf(setup);
  std::vector<CheckRow> checks;
  const Profile* shear = profileOf(profiles, "stress_pr");
  const std::vector<double> torque = presentNumbers(valuesOf(series, "wheel_torque"));
  if (shear && !torque.empty()) {
    const MeanEstimate wheel = estimateMean(torque);
    CheckRow check;
    check.name = "torque_balance";
    check.label =
        "torque carried at each ring, (σ_φr + dynamic)·2πr²h, against the "
        "wheel's [N m]";
    check.referenceError = wheel.standardError;
    for (int ring = 0; ring < rings.count(); ++ring) {
      const auto k = static_cast<std::size_t>(ring);
      const double r = rings.centre(ring);
      const double factor = 2.0 * std::numbers::pi * r * r * rings.height();
      const auto dynamic = ringMean(profiles, "dynamic_stress_rp", k);
      check.value.push_back(shear->mean[k]
                                ? std::optional((*shear->mean[k] + dynamic.value_or(0.0)) * factor)
                                : std::nullopt);
      check.standardError.push_back(times(shear->standardError[k], factor));
      check.reference.emplace_back(wheel.mean);
    }
    checks.push_back(std::move(check));
  }
  if (auto check = wallCheck(setup, profiles, series, wall)) checks.push_back(std::move(*check));
  return checks;
}

RegimeRow couetteRegime(const Case& setup, const std::vector<Profile>& profiles,
                        const RunSeries& series) {
  RegimeFigures figures;
  figures.wheelContacts = meanOf(valuesOf(series, "wheel_contacts"));
  const auto slip = meanOf(valuesOf(series, "wheel_slip"));
  const auto shear = meanOf(valuesOf(series, "shear_share"));
  if (slip && shear) figures.motion = WheelMotion{*slip, *shear};
  figures.inertialNumber = inertialNumber(ringsOf(setup), profiles, diskDensity(setup));
  figures.blockedFraction = blockedFraction(presentNumbers(valuesOf(series, "shear_share")),
                                            rimPassesADisk(setup, series));
  const RegimeVerdict verdict = regimeOf(figures);
  return {verdict.regime, verdict.reason,         figures.wheelContacts,  slip,
          shear,          figures.inertialNumber, figures.blockedFraction};
}

std::vector<SeriesDrift> couetteSteadiness(const Case& setup, const RunSeries& series) {
  std::vector<SeriesDrift> rows;
  for (const char* name : watchedSeries) {
    const std::vector<double> values = presentNumbers(valuesOf(series, name));
    if (!values.empty())
      rows.push_back({name, relativeDrift(values, setup.averaging.confidence, largestUnseenDrift)});
  }
  return rows;
}

}  // namespace crossgrain::inline studies
