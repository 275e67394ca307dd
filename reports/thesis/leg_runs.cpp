#include "reports/thesis/leg_runs.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>

namespace crossgrain::reports {

namespace {

/// What rounding leaves between times that were typed in [rotations].
constexpr double sliverOfRotation = 1e-6;

/// Rotations that a run's history reaches to, or its leg's where it has none.
double reach(const LegRun& at) {
  return at.run->history.empty() ? at.leg->settleRotations + at.leg->averagedRotations
                                 : at.run->history.back().to;
}

}  // namespace

std::vector<LegRun> longestOfEachPacking(const std::vector<LegRun>& runs) {
  std::map<std::tuple<std::size_t, std::size_t, std::uint64_t, int>, LegRun> longest;
  for (const LegRun& at : runs) {
    const auto key =
        std::tuple(at.leg->cell.small, at.leg->cell.large, at.run->seed, at.run->packing);
    const auto [found, isNew] = longest.try_emplace(key, at);
    if (!isNew && reach(at) > reach(found->second)) found->second = at;
  }
  std::vector<LegRun> each;
  for (const auto& [key, at] : longest) each.push_back(at);
  return each;
}

const ThesisSpan* spanAt(const ThesisRun& run, double rotation) {
  for (const ThesisSpan& span : run.history)
    if (span.from < rotation - sliverOfRotation && rotation <= span.to + sliverOfRotation)
      return &span;
  return nullptr;
}

std::optional<double> fittedIn(const ThesisRun& run, std::string_view name) {
  const auto found = std::ranges::find(run.run.fits, name, &FitRow::name);
  return found == run.run.fits.end() ? std::nullopt : found->value;
}

}  // namespace crossgrain::reports
