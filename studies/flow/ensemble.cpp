#include "studies/flow/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "averaging/trend.hpp"
#include "studies/flow/summary.hpp"

namespace crossgrain::inline studies {

namespace {

/// Angles next to the first one, not on the far side of ±π.
void unwrap(Numbers& angles, double period) {
  std::optional<double> first;
  for (auto& angle : angles) {
    if (!angle) continue;
    if (!first) first = angle;
    angle = *first + std::remainder(*angle - *first, period);
  }
}

/// Sets the mean and error over packings of one number per run. A fit that most packings refuse is
/// not one of the ensemble: those that let themselves be fitted are no sample of all.
/// @param least  packings that must have it
template <typename Row>
void setMean(Row& row, const Numbers& perPacking, std::size_t least) {
  const auto mean = ensembleMean(perPacking);
  const int found = mean ? mean->packings : 0;
  const bool says = mean && static_cast<std::size_t>(found) >= least;
  row.value = says ? std::optional(mean->mean) : std::nullopt;
  row.standardError = says ? mean->standardError : std::nullopt;
  row.packings = found;
}

/// A number of one row of each run, of those that have the row.
template <typename Row>
Numbers ofRow(const Runs& runs, std::vector<Row> FlowRun::*rows, const std::string& name,
              std::optional<double> Row::*number) {
  Numbers values;
  for (const FlowRun* run : runs)
    for (const Row& row : run->*rows)
      if (row.name == name) values.push_back(row.*number);
  return values;
}

std::vector<HeadNumber> meanHead(const Runs& runs) {
  std::vector<HeadNumber> rows = runs.front()->head;
  for (HeadNumber& row : rows)
    setMean(row, ofRow(runs, &FlowRun::head, row.name, &HeadNumber::value), 1);
  return rows;
}

std::vector<FitRow> meanFits(const Runs& runs) {
  std::vector<FitRow> rows = runs.front()->fits;
  for (FitRow& row : rows) {
    Numbers perPacking = ofRow(runs, &FlowRun::fits, row.name, &FitRow::value);
    std::string reason;
    for (const FlowRun* run : runs)
      for (const FitRow& other : run->fits) {
        if (other.name != row.name) continue;
        if (other.period) row.period = other.period;
        if (reason.empty()) reason = other.reason;
      }
    if (row.period) unwrap(perPacking, *row.period);
    setMean(row, perPacking, (perPacking.size() + 1) / 2);
    row.ofPackings = static_cast<int>(perPacking.size());
    const auto chi2 = ensembleMean(ofRow(runs, &FlowRun::fits, row.name, &FitRow::chi2PerDof));
    row.chi2PerDof = row.value && chi2 ? std::optional(chi2->mean) : std::nullopt;
    row.reason = row.value ? "" : reason;
  }
  return rows;
}

Profile meanProfile(const Runs& runs, const Profile& like) {
  std::vector<Numbers> perRing(like.mean.size());
  for (const FlowRun* run : runs) {
    const Profile* profile = profileOf(run->profiles, like.method, like.field);
    const Numbers mean = profile ? profile->mean : Numbers{};
    for (std::size_t ring = 0; ring < perRing.size(); ++ring)
      perRing[ring].push_back(ring < mean.size() ? mean[ring] : std::nullopt);
  }
  Profile result{like.method, like.field, like.unit, {}, {}, {}, {}};
  for (const Numbers& packings : perRing) {
    const auto mean = ensembleMean(packings);
    const bool scatters = mean && mean->standardError;
    result.mean.push_back(mean ? std::optional(mean->mean) : std::nullopt);
    result.standardError.push_back(mean ? mean->standardError : std::nullopt);
    result.nEff.push_back(mean ? std::optional<double>(mean->packings) : std::nullopt);
    result.dof.push_back(scatters ? std::optional<double>(mean->packings - 1) : std::nullopt);
  }
  return result;
}

/// Densities cell by cell, over packings. Bins are the same in all runs of a case.
Distribution meanDistribution(const Runs& runs, Distribution like) {
  const auto cells = like.density.size();
  std::vector<Numbers> perCell(cells);
  Numbers outside;
  like.samples = 0.0;
  for (const FlowRun* run : runs)
    for (const Distribution& other : run->distributions) {
      if (other.quantity != like.quantity || other.ring != like.ring) continue;
      for (std::size_t cell = 0; cell < cells; ++cell)
        perCell[cell].emplace_back(other.density[cell]);
      outside.emplace_back(other.outside);
      like.samples += other.samples;
    }
  like.standardError.clear();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto mean = ensembleMean(perCell[cell]);
    like.density[cell] = mean->mean;
    like.standardError.push_back(mean->standardError.value_or(NAN));
  }
  like.outside = ensembleMean(outside)->mean;
  return like;
}

constexpr int packingsForAMean = 4;

std::map<int, Regime> regimesByPacking(const Runs& runs) {
  std::map<int, Regime> regimes;
  for (const FlowRun* run : runs)
    if (run->regime && run->regime->regime) regimes[run->packing] = *run->regime->regime;
  return regimes;
}

/// One run's numbers of one series, or null.
const RelativeDrift* driftOf(const FlowRun& run, const std::string& quantity) {
  const auto found = std::ranges::find(run.steadiness, quantity, &SeriesDrift::quantity);
  return found == run.steadiness.end() ? nullptr : &found->drift;
}

RelativeDrift overPackings(const std::vector<std::optional<double>>& changes, double confidence) {
  RelativeDrift result;
  const auto mean = ensembleMean(changes);
  if (!mean || !mean->standardError) return result;
  result.change = mean->mean;
  result.half = studentQuantile(confidence, mean->packings - 1) * *mean->standardError;
  result.excluded = std::abs(*result.change) + *result.half;
  if (std::abs(*result.change) > *result.half)
    result.verdict = Drift::drifts;
  else if (*result.excluded <= largestUnseenDrift)
    result.verdict = Drift::notSeen;
  return result;
}

/// The same answer of all runs, in the same direction, with the least certain run's numbers.
RelativeDrift ofAllRuns(const std::vector<RelativeDrift>& drifts) {
  const RelativeDrift& first = drifts.front();
  const bool alike = std::ranges::all_of(drifts, [&](const RelativeDrift& drift) {
    return drift.verdict == first.verdict &&
           (drift.verdict != Drift::drifts || (drift.change < 0.0) == (first.change < 0.0));
  });
  RelativeDrift result = *std::ranges::max_element(
      drifts, {}, [](const RelativeDrift& drift) { return drift.half.value_or(0.0); });
  result.verdict = alike ? first.verdict : Drift::cannotTell;
  return result;
}

}  // namespace

std::optional<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs, const std::string& engine,
                                          const std::string& without) {
  const Runs finished = finishedRuns(runs, engine, without);
  if (finished.empty()) return std::nullopt;
  CouetteEnsemble ensemble;
  ensemble.engine = engine;
  ensemble.without = without;
  ensemble.packings = finished.size();
  for (const Profile& profile : finished.front()->profiles)
    ensemble.profiles.push_back(meanProfile(finished, profile));
  for (const Distribution& distribution : finished.front()->distributions)
    ensemble.distributions.push_back(meanDistribution(finished, distribution));
  ensemble.fits = meanFits(finished);
  ensemble.head = meanHead(finished);
  return ensemble;
}

std::vector<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs,
                                        const std::vector<std::string>& engines) {
  std::vector<CouetteEnsemble> ensemble;
  for (const std::string& engine : engines)
    if (auto entry = ensembleOf(runs, engine, "")) ensemble.push_back(std::move(*entry));
  return ensemble;
}

std::vector<RegimesOfPair> regimesOf(std::span<const FlowRun> runs,
                                     const std::vector<ComparedPair>& pairs,
                                     const std::vector<SurrogateEngine>& surrogates) {
  std::vector<RegimesOfPair> table;
  for (const ComparedPair& pair : pairs) {
    if (pair.ofFiles || !pair.others.empty()) continue;  // no packing's regime is theirs
    const auto ours = regimesByPacking(runsFor(runs, pair.a, surrogates));
    const auto theirs = regimesByPacking(runsFor(runs, pair.b, surrogates, pair.without));
    RegimesOfPair row{pair.a, pair.b, pair.kind, 0, {}};
    for (const auto& [packing, regime] : ours) {
      const auto other = theirs.find(packing);
      if (other == theirs.end()) continue;
      ++row.packings;
      if (other->second != regime) row.differ.push_back(packing);
    }
    if (row.packings > 0) table.push_back(std::move(row));
  }
  return table;
}

std::vector<EngineDrift> steadinessOf(std::span<const FlowRun> runs,
                                      const std::vector<std::string>& engines, double confidence) {
  std::vector<EngineDrift> table;
  const double shared = 1.0 - (1.0 - confidence) / static_cast<double>(std::size(watchedSeries));
  for (const std::string& engine : engines) {
    const Runs finished = finishedRuns(runs, engine);
    for (const char* quantity : watchedSeries) {
      EngineDrift row;
      row.engine = engine;
      row.quantity = quantity;
      std::vector<RelativeDrift> drifts;
      Numbers changes;
      for (const FlowRun* run : finished) {
        const RelativeDrift* drift = driftOf(*run, quantity);
        if (!drift) continue;
        drifts.push_back(*drift);
        changes.push_back(drift->change);
        if (drift->verdict == Drift::drifts) row.drifting.push_back(run->packing);
      }
      if (drifts.empty()) continue;
      const auto known =
          std::ranges::count_if(changes, [](const auto& c) { return c.has_value(); });
      row.drift = known >= packingsForAMean ? overPackings(changes, shared) : ofAllRuns(drifts);
      row.packings = static_cast<int>(drifts.size());
      table.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace crossgrain::inline studies
