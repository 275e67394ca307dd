#include "studies/flow/notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/endpoints.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/paired_runs.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr double farMargins = 10.0;
/// Of the disks: what crosses the walls' circles and comes back is a tenth of that.
constexpr double goneFraction = 0.02;

/// Values that one of both lacks where the other has them: a packing on which neither has a value
/// is no difference.
struct OneSided {
  std::string who, other;
  int packings = 0;
};

/// Of the one that lacks it more often.
OneSided missingOfOne(const Case& setup, const CompareResults& results, const EndpointRow& row) {
  const auto valuesOf = [&](const std::string& engine) {
    return endpointByPacking(endpointNamed(setup, row.endpoint), setup,
                             runsFor(results.runs, engine, results.endpoints.surrogates),
                             packingsOf(results.runs));
  };
  const Numbers ours = valuesOf(row.a), theirs = valuesOf(row.b);
  OneSided a{row.a, row.b}, b{row.b, row.a};
  for (std::size_t k = 0; k < ours.size(); ++k) {
    a.packings += !ours[k] && theirs[k];
    b.packings += ours[k] && !theirs[k];
  }
  return a.packings > b.packings ? a : b;
}

void addFarEndpoints(const Case& setup, const CompareResults& results,
                     std::vector<AlarmRow>& alarms) {
  for (const EndpointRow& row : results.endpoints.rows) {
    const std::string words(endpointNamed(setup, row.endpoint).words);
    const auto alarm = [&](std::string what) {
      alarms.push_back({row.a, row.b, row.kind, std::move(what)});
    };
    if (row.verdict == Verdict::notMeasured) continue;  // its reason is in the files
    if (row.kind == PairKind::closedForm) continue;     // what is missing or far off is its answer
    const int packings = row.lost + row.packings;
    const OneSided missing = row.unpaired || row.lost == 0 || row.a == medianName
                                 ? OneSided()
                                 : missingOfOne(setup, results, row);
    if (2 * missing.packings > packings)
      alarm(fmt::format("{} has no {} on {} of {} packings where {} has", missing.who, words,
                        missing.packings, packings, missing.other));
    // Where margins are small beside the scatter (of a value near 0, relative ones are), ten of
    // them are chance: an interval that has 0 in it says so.
    else if (row.distance && std::abs(*row.distance) > farMargins && row.verdict != Verdict::fail &&
             row.differenceSeen())
      alarm(fmt::format("{} is {:.0f} margins off, which {} packing{} cannot prove", words,
                        std::abs(*row.distance), row.packings, row.packings == 1 ? "" : "s"));
  }
}

/// Fraction of the disks' area that is in the cell, mean over packings.
std::optional<double> filled(const Case& setup, const CompareResults& results,
                             const std::string& engine) {
  Numbers values;
  for (const FlowRun* run : finishedRuns(results.runs, engine))
    values.push_back(cellMean(setup, *run, "volume_fraction"));
  const auto mean = ensembleMean(values);
  return mean ? std::optional(mean->mean) : std::nullopt;
}

}  // namespace

std::vector<AlarmRow> alarmsOf(const Case& setup, const CompareResults& results) {
  std::vector<AlarmRow> alarms;
  addFarEndpoints(setup, results, alarms);
  for (const RegimesOfPair& pair : results.regimes) {
    if (2 * static_cast<int>(pair.differ.size()) > pair.packings)
      alarms.push_back(
          {pair.a, pair.b, pair.kind,
           fmt::format("another regime on {} of {} packings", pair.differ.size(), pair.packings)});
    if (!cellOf(setup)) continue;  // its bins may fill and empty
    const auto ours = filled(setup, results, pair.a), theirs = filled(setup, results, pair.b);
    if (ours && theirs && *theirs < (1.0 - goneFraction) * *ours)
      alarms.push_back({pair.a, pair.b, pair.kind,
                        fmt::format("{:.0f} % of the disks are gone from the cell",
                                    100.0 * (1.0 - *theirs / *ours))});
  }
  return alarms;
}

namespace {

/// Over all snapshots of all finished runs of an engine.
std::optional<double> meanOf(const FlowStudy& study, const std::string& engine,
                             const char* series) {
  std::vector<double> values;
  for (const FlowRun& run : study.runs) {
    if (run.engine != engine || !run.finished() || !run.series) continue;
    for (const auto& value : valuesOf(*run.series, series))
      if (value) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

std::string firstOf(const std::vector<std::string>& names, std::string_view between) {
  constexpr std::size_t most = 3;
  if (names.size() <= most) return fmt::format("{}", fmt::join(names, between));
  return fmt::format("{} and {} more", fmt::join(std::span(names).first(most), between),
                     names.size() - most);
}

std::vector<std::string> remarkNotes(std::span<const FlowRun> runs, bool named) {
  std::vector<std::string> notes;
  for (const FlowRun& run : runs)
    for (const std::string& remark : run.remarks) {
      const Runs all = finishedRuns(runs, run.engine);
      std::vector<std::string> files;
      for (const FlowRun* other : all)
        if (std::ranges::find(other->remarks, remark) != other->remarks.end())
          files.push_back(other->files);
      std::string who = named ? run.engine : "";
      if (files.size() < all.size()) who += (named ? ", " : "") + firstOf(files);
      std::string note = who.empty() ? remark : who + ": " + remark;
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    }
  return notes;
}

namespace {

/// Basis of a pair's verdicts, and of how many runs.
struct PairBasis {
  Basis basis = Basis::paired;
  int a = 0, b = 0;
  std::vector<std::string> endpoints;
};

std::string describe(const PairBasis& found, const std::string& a, const std::string& b) {
  const auto runs = [](int count) { return counted(static_cast<std::size_t>(count), "run"); };
  const std::string& fewer = found.a < found.b ? a : b;
  const std::string& more = found.a < found.b ? b : a;
  switch (found.basis) {
    case Basis::paired:
      return fmt::format(
          "{} and {} have {} each: the first is compared with the first, and so on. Intervals "
          "hold whether or not they began from the same packings; they are narrower if they did.",
          a, b, runs(found.a));
    case Basis::independent:
      return fmt::format(
          "{} has {} and {} {}: they are compared as independent samples, each with its own "
          "scatter over packings.",
          a, runs(found.a), b, found.b);
    case Basis::oneScatter:
      return fmt::format(
          "{} has {}, too few to know its scatter over packings: it is taken to scatter as {} "
          "does.",
          fewer, runs(std::min(found.a, found.b)), more);
    case Basis::oneRunEach:
      return fmt::format(
          "{} and {} have one run each: intervals are those of the two runs' own series. They do "
          "not see how packings differ, so a verdict is on these two packings only.",
          a, b);
  }
  throw std::logic_error("no basis");
}

}  // namespace

std::vector<std::string> fileNotes(const CompareResults& results) {
  const auto ofFiles = [&](const std::string& engine) {
    const Runs runs = finishedRuns(results.runs, engine);
    return !runs.empty() && runs.front()->ofFiles();
  };
  std::map<std::pair<std::string, std::string>, std::vector<PairBasis>> pairs;
  for (const EndpointRow& row : results.endpoints.rows) {
    if (row.kind != PairKind::peer || row.verdict == Verdict::notMeasured) continue;
    if (!ofFiles(row.a) && !ofFiles(row.b)) continue;
    PairBasis own;
    own.a = static_cast<int>(finishedRuns(results.runs, row.a).size());
    if (row.unpaired) own = {row.unpaired->basis, row.unpaired->a, row.unpaired->b, {}};
    std::vector<PairBasis>& known = pairs[{row.a, row.b}];
    auto place = std::ranges::find_if(known, [&](const PairBasis& one) {
      return one.basis == own.basis && one.a == own.a && one.b == own.b;
    });
    if (place == known.end()) place = known.insert(known.end(), std::move(own));
    place->endpoints.push_back(row.endpoint);
    std::ranges::replace(place->endpoints.back(), '_', ' ');
  }
  std::vector<std::string> notes = remarkNotes(results.runs, true);
  for (const auto& [pair, all] : pairs)
    for (const PairBasis& one : all)
      notes.push_back(
          (all.size() > 1 ? fmt::format("In {}: ", fmt::join(one.endpoints, ", ")) : "") +
          describe(one, pair.first, pair.second));
  return notes;
}

std::vector<std::string> contactNotes(const FlowStudy& study) {
  std::vector<std::string> differ, same;
  for (const EngineRow& engine : study.engines) {
    const std::string& name = engine.name;
    const auto counted = meanOf(study, name, "coordination");
    const auto listed = meanOf(study, name, "pairs_listed");
    if (!counted || !listed) continue;
    if (*listed == *counted)
      same.push_back(name);
    else
      differ.push_back(fmt::format("{} {:.3g} instead of {:.3g}", name, *listed, *counted));
  }
  if (differ.empty() && same.empty()) return {};
  std::string outcome;
  if (!differ.empty()) outcome = fmt::format("{}", fmt::join(differ, ", "));
  if (!same.empty())
    outcome += fmt::format("{}no other for {}", differ.empty() ? "" : "; ", fmt::join(same, ", "));
  return {fmt::format(
      "Contacts are pairs that transmit a force. With every pair that an engine lists, the "
      "coordination C (and with it the trace of the fabric, νC) would be: {}.",
      outcome)};
}

namespace {

constexpr double measuringError = 0.15;
constexpr std::size_t bandRings = 3;

using ByPacking = std::map<int, Numbers>;

ByPacking velocitiesOf(const FlowStudy& study, const std::string& engine) {
  ByPacking found;
  for (const FlowRun* run : finishedRuns(study.runs, engine))
    if (const Profile* profile =
            profileOf(run->profiles, study.averaging.method, "azimuthal_velocity"))
      found[run->packing] = profile->mean;
  return found;
}

/// Paired difference of two engines in one ring, as a fraction of the first one's mean.
struct RingDifference {
  double fraction = 0.0;
  double halfWidth = INFINITY;  ///< of the 95 % interval; infinite with fewer than two packings
  bool holds() const {
    return std::abs(fraction) <= measuringError || std::abs(fraction) <= halfWidth;
  }
};

std::optional<RingDifference> difference(const ByPacking& from, const ByPacking& to,
                                         std::size_t ring) {
  Numbers differences, references;
  for (const auto& [packing, reference] : from) {
    const auto other = to.find(packing);
    if (other == to.end() || ring >= reference.size() || ring >= other->second.size()) continue;
    if (!reference[ring] || !other->second[ring]) continue;
    differences.emplace_back(*other->second[ring] - *reference[ring]);
    references.push_back(reference[ring]);
  }
  const auto mean = ensembleMean(differences);
  const auto reference = ensembleMean(references);
  if (!mean || reference->mean == 0.0) return std::nullopt;
  RingDifference result;
  result.fraction = mean->mean / std::abs(reference->mean);
  if (mean->standardError)
    result.halfWidth = studentQuantile(0.95, mean->packings - 1) * *mean->standardError /
                       std::abs(reference->mean);
  return result;
}

std::string percent(const RingDifference& d) {
  return std::isfinite(d.halfWidth)
             ? fmt::format("{:+.0f} ± {:.0f} %", 100.0 * d.fraction, 100.0 * d.halfWidth)
             : fmt::format("{:+.0f} %", 100.0 * d.fraction);
}

std::string mirrorSentence(const FlowStudy& study, const std::string& peer,
                           const ByPacking& reference, const ByPacking& measured, std::size_t ring,
                           const char* bin) {
  for (const EngineRow& engine : study.engines) {
    if (engine.mirrors != peer) continue;
    const ByPacking mirror = velocitiesOf(study, engine.name);
    const auto model = difference(reference, mirror, ring);
    const auto rest = difference(mirror, measured, ring);
    if (!model || !rest) continue;
    const char* reading = rest->holds() && !model->holds() ? "the model makes the difference"
                          : model->holds() && !rest->holds()
                              ? "what it mirrors is not what makes the difference"
                              : "it explains a part, as far as these packings show";
    return fmt::format(" Its mirror {} (same {}) is {} off the reference and {} off it: {}.",
                       engine.name, bin, percent(*model), percent(*rest), reading);
  }
  return " It has no mirror.";
}

}  // namespace

std::vector<std::string> velocityNotes(const CompareResults& study) {
  std::vector<std::string> notes;
  if (!study.endpoints.reference.empty()) return notes;
  const std::string& first = study.engines.front().name;
  const char* const bin = study.region ? "bin" : "ring";
  const ByPacking reference = velocitiesOf(study, first);
  for (const EngineRow& engine : study.engines) {
    const std::string& name = engine.name;
    if (name == first || !engine.mirrors.empty()) continue;
    const ByPacking measured = velocitiesOf(study, name);
    std::vector<std::string> differences;
    std::string beyond;
    for (std::size_t ring = 0; ring < bandRings; ++ring) {
      const auto found = difference(reference, measured, ring);
      if (!found || !std::isfinite(found->halfWidth)) continue;  // one packing has no interval
      differences.push_back(percent(*found));
      if (!found->holds() && beyond.empty())
        beyond = fmt::format(" In {} {} it is beyond both.", bin, ring + 1) +
                 mirrorSentence(study, name, reference, measured, ring, bin);
    }
    if (differences.empty()) continue;
    notes.push_back(
        fmt::format("v_φ of {} in {}s 1 to {} against {} (95 % interval over packings): {}. {}{}",
                    name, bin, differences.size(), first, fmt::join(differences, ", "),
                    beyond.empty() ? "Within 15 % or within the interval in each."
                                   : "Not within 15 % or the "
                                     "interval everywhere.",
                    beyond));
  }
  return notes;
}

}  // namespace crossgrain::inline studies
