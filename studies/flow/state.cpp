#include "studies/flow/state.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/regime.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

namespace {

/// Samples in the time in which the wheel's rim passes one disk, at least one.
std::size_t rimPassesADisk(const Case& setup, const RunSeries& series) {
  const std::vector<double> times = presentNumbers(valuesOf(series, "t_s"));
  if (times.size() < 2) return 1;
  const double interval = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  const double rim = std::abs(setup.cell.omega) * setup.cell.innerRadius;
  const double window = 2.0 * setup.particles.smallRadius / rim / interval;
  return static_cast<std::size_t>(std::max(1L, std::lround(window)));
}

}  // namespace

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
