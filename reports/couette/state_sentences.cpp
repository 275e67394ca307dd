#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/packings.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;
using Names = std::vector<std::string>;

/// What a packing does in each regime, as a verb; of several packings.
struct Verb {
  std::optional<Regime> regime;  ///< absent: it could not be told
  const char *one, *many;
};
constexpr Verb verbs[] = {
    {Regime::blocked, "stands still", "stand still"},
    {Regime::collisional, "is carried by collisions", "are carried by collisions"},
    {Regime::flowing, "flows", "flow"},
    {{}, "shows too little to tell", "show too little to tell"},
};

/// Engines by regime, of one packing.
using ByRegime = std::map<std::optional<Regime>, Names>;

std::map<int, ByRegime> regimesByPacking(const Engines& engines) {
  std::map<int, ByRegime> packings;
  for (const EngineRuns& engine : engines)
    for (const CouetteRun* run : engine.finished)
      if (run->regime) packings[run->packing][run->regime->regime].push_back(engine.name);
  return packings;
}

/// "stands still on a, b; flows on c", or "flows on every engine" of those that finished anything.
std::string doesWhat(const ByRegime& engines, std::size_t all, bool many) {
  Names parts;
  for (const Verb& verb : verbs) {
    const auto found = engines.find(verb.regime);
    if (found == engines.end()) continue;
    const bool every = all > 1 && found->second.size() == all;
    parts.push_back(
        fmt::format("{} on {}", many ? verb.many : verb.one,
                    every ? "every engine" : fmt::format("{}", fmt::join(found->second, ", "))));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

void addRegimes(Names& sentences, const Engines& engines) {
  const auto packings = regimesByPacking(engines);
  if (packings.empty()) return;
  const auto all = static_cast<std::size_t>(
      std::ranges::count_if(engines, [](const auto& engine) { return !engine.finished.empty(); }));
  // Packings that do the same are told together, those that flow everywhere last.
  std::map<std::string, std::vector<int>> alike;
  for (const auto& [packing, byRegime] : packings)
    alike[doesWhat(byRegime, all, false)].push_back(packing);
  const auto flows = [&](const std::vector<int>& group) {
    const ByRegime& first = packings.at(group.front());
    return first.size() == 1 && first.begin()->first == Regime::flowing;
  };
  for (const bool last : {false, true})
    for (const auto& [what, group] : alike) {
      if (flows(group) != last) continue;
      const bool many = group.size() > 1;
      const std::string does = doesWhat(packings.at(group.front()), all, many);
      sentences.push_back(
          alike.size() == 1 && many
              ? fmt::format("All {} packings {}.", group.size(), does)
              : fmt::format("Packing{} {} {}.", many ? "s" : "", indicesInWords(group), does));
    }
  Names mixed;
  for (const EngineRuns& engine : engines) {
    std::set<Regime> regimes;
    for (const CouetteRun* run : engine.finished)
      if (run->regime && run->regime->regime) regimes.insert(*run->regime->regime);
    if (regimes.size() > 1) mixed.push_back(engine.name);
  }
  if (!mixed.empty())
    sentences.push_back(
        fmt::format("Means over packings mix regimes on {}: they describe none of them.",
                    fmt::join(mixed, ", ")));
}

std::string packingsInWords(const std::vector<int>& indices) {
  return fmt::format("packing{} {}", indices.size() > 1 ? "s" : "", fmt::join(indices, ", "));
}

void addPairs(Names& sentences, const CompareResults& results, const std::string& reference) {
  Names pairs;
  for (const RegimesOfPair& pair : results.regimes) {
    if (pair.differ.empty() || (pair.a != reference && pair.b != reference)) continue;
    pairs.push_back(fmt::format("{} on {}", pair.a == reference ? pair.b : pair.a,
                                packingsInWords(pair.differ)));
  }
  if (!pairs.empty())
    sentences.push_back(fmt::format(
        "Not in the same regime as {}: {}. What is said of these pairs below compares different "
        "states.",
        reference, fmt::join(pairs, "; ")));
}

/// How one engine's answers on its series add up.
struct Answers {
  Names drifts;                    ///< "outer pressure falls by 40 ± 8 %"
  std::optional<double> excluded;  ///< the largest change that is not excluded in any series
  std::string worst;               ///< in which
  bool seenNone = true;            ///< every series: no drift seen
};

std::map<std::string, Answers> answersByEngine(const std::vector<EngineDrift>& steadiness) {
  std::map<std::string, Answers> engines;
  for (const EngineDrift& row : steadiness) {
    Answers& answers = engines[row.engine];
    const std::string quantity = spaced(row.quantity);
    const auto change = finite(row.drift.change), half = finite(row.drift.half);
    const auto excluded = finite(row.drift.excluded);
    answers.seenNone = answers.seenNone && row.drift.verdict == Drift::notSeen;
    if (row.drift.verdict == Drift::drifts && change && half)
      answers.drifts.push_back(
          fmt::format("{} {} by {} ± {} %", quantity, *change < 0.0 ? "falls" : "rises",
                      readablePercent(std::abs(*change)), readablePercent(*half)));
    if (excluded && *excluded > answers.excluded.value_or(-1.0)) {
      answers.excluded = excluded;
      answers.worst = quantity;
    }
  }
  return engines;
}

void addSteadiness(Names& sentences, const CompareResults& results, const Engines& engines) {
  const auto answers = answersByEngine(results.steadiness);
  Names drifts, none, open;
  std::optional<double> largest;
  std::string series;
  for (const EngineRuns& engine : engines) {
    const auto found = answers.find(engine.name);
    if (found == answers.end()) continue;
    const Answers& here = found->second;
    if (!here.drifts.empty()) {
      drifts.push_back(fmt::format("on {} {}", engine.name, fmt::join(here.drifts, ", ")));
    } else if (here.seenNone && here.excluded) {
      none.push_back(
          fmt::format("{} (down to {} %)", engine.name, readablePercent(*here.excluded)));
    } else {
      open.push_back(engine.name);
      if (here.excluded && *here.excluded > largest.value_or(-1.0)) {
        largest = here.excluded;
        series = here.worst;
      }
    }
  }
  if (!drifts.empty())
    sentences.push_back(fmt::format("Not steady: {}, of the mean, over the averaged time.",
                                    fmt::join(drifts, "; ")));
  if (!none.empty())
    sentences.push_back(
        fmt::format("No drift seen over the averaged time: {}.", fmt::join(none, ", ")));
  if (!open.empty())
    sentences.push_back(
        fmt::format("Steady or not cannot be told of {}{}.", fmt::join(open, ", "),
                    largest ? fmt::format(": changes of {} by up to {} % are not excluded", series,
                                          readablePercent(*largest))
                            : std::string()));
}

std::string range(double from, double to) {
  return readableSetting(from) + " to " + readableSetting(to);
}

}  // namespace

std::string readablePercent(double fraction) {
  const double percent = 100.0 * fraction;
  return percent < 0.95 ? fmt::format("{:.1g}", percent) : fmt::format("{:.0f}", percent);
}

std::string averagedRotations(const CouetteAveraging& averaging) {
  const auto from = averaging.fromRotation, to = averaging.toRotation;
  if (!from || !to) return {};
  std::string words = fmt::format("rotations {} since the hand-over", range(*from, *to));
  if (const auto before = averaging.preparedRotations)
    words += fmt::format(", {} since the ring had closed", range(*before + *from, *before + *to));
  return words;
}

std::vector<std::string> stateSentences(const CompareResults& results, const Engines& engines) {
  Names sentences;
  addRegimes(sentences, engines);
  if (!engines.empty()) addPairs(sentences, results, engines.front().name);
  addSteadiness(sentences, results, engines);
  return sentences;
}

}  // namespace crossgrain::reports
