#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;
using Names = std::vector<std::string>;

/// What a packing does in each regime, as a verb; of several packings.
struct Verb {
  const char *regime, *one, *many;
};
constexpr Verb verbs[] = {
    {"blocked", "stands still", "stand still"},
    {"collisional", "is carried by collisions", "are carried by collisions"},
    {"flowing", "flows", "flow"},
    {"", "shows too little to tell", "show too little to tell"},
};

/// Engines by regime ("" where it could not be told), of one packing.
using ByRegime = std::map<std::string, Names>;

std::map<long, ByRegime> regimesByPacking(const Engines& engines) {
  std::map<long, ByRegime> packings;
  for (const EngineResults& engine : engines)
    for (const Json* run : engine.finished) {
      const auto packing = number(*run, "packing");
      const Json& regime = member(*run, "regime");
      if (packing && regime.is_object())
        packings[static_cast<long>(*packing)][text(regime, "name")].push_back(engine.name);
    }
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
  std::map<std::string, std::vector<long>> alike;
  for (const auto& [packing, byRegime] : packings)
    alike[doesWhat(byRegime, all, false)].push_back(packing);
  const auto flows = [&](const std::vector<long>& group) {
    const ByRegime& first = packings.at(group.front());
    return first.size() == 1 && first.begin()->first == "flowing";
  };
  for (const bool last : {false, true})
    for (const auto& [what, group] : alike) {
      if (flows(group) != last) continue;
      const bool many = group.size() > 1;
      const std::string does = doesWhat(packings.at(group.front()), all, many);
      sentences.push_back(
          alike.size() == 1 && many
              ? fmt::format("All {} packings {}.", group.size(), does)
              : fmt::format("Packing{} {} {}.", many ? "s" : "", fmt::join(group, ", "), does));
    }
  Names mixed;
  for (const EngineResults& engine : engines) {
    std::set<std::string> names;
    for (const Json* run : engine.finished)
      if (const std::string name = text(member(*run, "regime"), "name"); !name.empty())
        names.insert(name);
    if (names.size() > 1) mixed.push_back(engine.name);
  }
  if (!mixed.empty())
    sentences.push_back(
        fmt::format("Means over packings mix regimes on {}: they describe none of them.",
                    fmt::join(mixed, ", ")));
}

std::string packingsInWords(const Json& indices) {
  Names words;
  for (const Json& index : indices) words.push_back(index.dump());
  return fmt::format("packing{} {}", words.size() > 1 ? "s" : "", fmt::join(words, ", "));
}

void addPairs(Names& sentences, const Json& results, const std::string& reference) {
  Names pairs;
  for (const Json& pair : list(results, "regimes")) {
    const std::string a = text(pair, "a"), b = text(pair, "b");
    if (list(pair, "differ").empty() || (a != reference && b != reference)) continue;
    pairs.push_back(
        fmt::format("{} on {}", a == reference ? b : a, packingsInWords(list(pair, "differ"))));
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

std::map<std::string, Answers> answersByEngine(const Json& results) {
  std::map<std::string, Answers> engines;
  for (const Json& row : list(results, "steadiness")) {
    Answers& answers = engines[text(row, "engine")];
    const std::string verdict = text(row, "verdict"), quantity = spaced(text(row, "quantity"));
    const auto change = number(row, "change"), half = number(row, "half_width");
    const auto excluded = number(row, "excluded");
    answers.seenNone = answers.seenNone && verdict == "no drift seen";
    if (verdict == "drifts" && change && half)
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

void addSteadiness(Names& sentences, const Json& results, const Engines& engines) {
  const auto answers = answersByEngine(results);
  Names drifts, none, open;
  std::optional<double> largest;
  std::string series;
  for (const EngineResults& engine : engines) {
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

std::string readablePercent(double share) {
  const double percent = 100.0 * share;
  return percent < 0.95 ? fmt::format("{:.1g}", percent) : fmt::format("{:.0f}", percent);
}

std::string averagedRotations(const Json& results) {
  const Json& averaging = member(results, "averaging");
  const auto from = number(averaging, "from_rotation"), to = number(averaging, "to_rotation");
  if (!from || !to) return {};
  std::string words = fmt::format("rotations {} since the hand-over", range(*from, *to));
  if (const auto before = number(averaging, "prepared_rotations"))
    words += fmt::format(", {} since the ring had closed", range(*before + *from, *before + *to));
  return words;
}

std::vector<std::string> stateSentences(const Json& results, const Engines& engines) {
  Names sentences;
  addRegimes(sentences, engines);
  if (!engines.empty()) addPairs(sentences, results, engines.front().name);
  addSteadiness(sentences, results, engines);
  return sentences;
}

}  // namespace crossgrain::reports
