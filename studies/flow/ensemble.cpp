#include <algorithm>
#include <cmath>

#include "studies/flow/agreement_table.hpp"
#include "studies/flow/paired_rings.hpp"

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

std::vector<HeadNumber> meanHead(const Runs& runs) {
  std::vector<HeadNumber> rows;
  for (HeadNumber row : runs.front()->head) {
    Numbers perPacking;
    for (const FlowRun* run : runs)
      for (const HeadNumber& other : run->head)
        if (other.name == row.name) perPacking.push_back(other.value);
    setMean(row, perPacking, 1);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<FitRow> meanFits(const Runs& runs) {
  std::vector<FitRow> rows;
  for (FitRow row : runs.front()->fits) {
    Numbers perPacking, chi2;
    std::string reason;
    for (const FlowRun* run : runs)
      for (const FitRow& other : run->fits) {
        if (other.name != row.name) continue;
        perPacking.push_back(other.value);
        chi2.push_back(other.chi2PerDof);
        if (other.period) row.period = other.period;
        if (reason.empty()) reason = other.reason;
      }
    if (row.period) unwrap(perPacking, *row.period);
    setMean(row, perPacking, (perPacking.size() + 1) / 2);
    row.ofPackings = static_cast<int>(perPacking.size());
    const auto mean = ensembleMean(chi2);
    row.chi2PerDof = row.value && mean ? std::optional(mean->mean) : std::nullopt;
    row.reason = row.value ? "" : reason;
    rows.push_back(std::move(row));
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

}  // namespace crossgrain::inline studies
