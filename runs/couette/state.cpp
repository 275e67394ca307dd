#include "runs/couette/state.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/regime.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/summary.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

std::optional<double> meanOf(const json& series, const char* name) {
  const std::vector<double> values = presentNumbers(series.value(name, json::array()));
  if (values.empty()) return std::nullopt;
  return estimateMean(values).mean;
}

/// Samples in the time in which the wheel's rim passes one disk, at least one.
std::size_t rimPassesADisk(const Case& setup, const json& series) {
  const std::vector<double> times = presentNumbers(series.value("t_s", json::array()));
  if (times.size() < 2) return 1;
  const double interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double rim = std::abs(setup.cell.omega) * setup.cell.innerRadius;
  const double window = 2.0 * setup.particles.smallRadius / rim / interval;
  return static_cast<std::size_t>(std::max(1L, std::lround(window)));
}

}  // namespace

json couetteRegime(const Case& setup, const std::vector<Profile>& profiles, const json& series) {
  RegimeFigures figures;
  figures.wheelContacts = meanOf(series, "wheel_contacts");
  const auto slip = meanOf(series, "wheel_slip"), shear = meanOf(series, "shear_share");
  if (slip && shear) figures.motion = WheelMotion{*slip, *shear};
  figures.inertialNumber = inertialNumber(ringsOf(setup), profiles, diskDensity(setup));
  figures.blockedShare = blockedShare(presentNumbers(series.value("shear_share", json::array())),
                                      rimPassesADisk(setup, series));
  const RegimeVerdict verdict = regimeOf(figures);
  return {{"name", verdict.regime ? json(toString(*verdict.regime)) : json(nullptr)},
          {"reason", verdict.reason},
          {"wheel_contacts", toJson(figures.wheelContacts)},
          {"wheel_slip", toJson(slip)},
          {"shear_share", toJson(shear)},
          {"inertial_number", toJson(figures.inertialNumber)},
          {"blocked_share", toJson(figures.blockedShare)}};
}

json couetteSteadiness(const Case& setup, const json& series) {
  json rows = json::array();
  for (const char* name : watchedSeries) {
    const std::vector<double> values = presentNumbers(series.value(name, json::array()));
    if (values.empty()) continue;
    const RelativeDrift drift =
        relativeDrift(values, setup.averaging.confidence, largestUnseenDrift);
    rows.push_back({{"quantity", name},
                    {"verdict", toString(drift.verdict)},
                    {"change", toJson(drift.change)},
                    {"half_width", toJson(drift.half)},
                    {"excluded", toJson(drift.excluded)}});
  }
  return rows;
}

}  // namespace crossgrain::inline runs
