#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <ranges>

#include "reports/collide/overview.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

/// Of a list in a sentence: the matrix above has all names.
constexpr std::size_t mostEngines = 5, mostOfACause = 2, mostCauses = 2;

/// How an engine's sweeps came out.
struct Standing {
  std::string engine;
  int held = 0, model = 0, fellShort = 0;
  int judged() const { return held + model + fellShort; }
};

/// What may make sweeps differ or fall short.
struct Cause {
  std::string words;
  int excess = 0;  ///< of sweeps that it could explain over sweeps that hold in spite of it
  Names engines;   ///< whose sweeps it could explain
};
using Causes = std::vector<Cause>;

/// Engines that are asked: not the mirrors beside their peers.
Names asked(const CollideResults& results) {
  Names names;
  for (const EngineRow& engine : results.engines)
    if (!runsBesideItsPeer(results, engine.name)) names.push_back(engine.name);
  return names;
}

std::vector<Standing> standingsOf(const CollideResults& results) {
  std::vector<Standing> standings;
  for (const std::string& engine : asked(results)) {
    Standing& standing = standings.emplace_back(Standing{engine});
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine)) {
        const SweepOutcome outcome = outcomeOf(*curve);
        standing.held += outcome == SweepOutcome::held;
        standing.model += outcome == SweepOutcome::modelDifference;
        standing.fellShort += outcome == SweepOutcome::fellShort;
      }
  }
  return standings;
}

Cause& causeOf(Causes& causes, const std::string& words) {
  const auto found = std::ranges::find(causes, words, &Cause::words);
  return found == causes.end() ? causes.emplace_back(Cause{words, 0, {}}) : *found;
}

/// Of the sweeps that came out so, the likeliest cause first: what is in as many sweeps that hold
/// explains nothing.
/// @param causesIn  of a sweep: its causes' words
Causes causesOf(const CollideResults& results, SweepOutcome outcome, const auto& causesIn) {
  Causes causes;
  for (const std::string& engine : asked(results))
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine)) {
        const bool explained = outcomeOf(*curve) == outcome;
        if (!explained && outcomeOf(*curve) != SweepOutcome::held) continue;
        for (const std::string& words : causesIn(*curve)) {
          Cause& cause = causeOf(causes, words);
          cause.excess += explained ? 1 : -1;
          if (explained && (cause.engines.empty() || cause.engines.back() != engine))
            cause.engines.push_back(engine);
        }
      }
  std::erase_if(causes, [](const Cause& cause) { return cause.excess <= 0; });
  std::ranges::stable_sort(causes, std::greater(), &Cause::excess);
  return causes;
}

/// Conventions of the declared law that are not the scene's; its constants follow from these.
Names conventionsIn(const CollisionCurve& curve) {
  Names words;
  if (curve.declared)
    for (const auto& [name, value] : curve.declared->law)
      if (std::holds_alternative<std::string>(value)) words.push_back(*lawWords(name, value));
  return words;
}

/// Quantities beyond their limits.
Names shortIn(const CollisionCurve& curve) {
  Names words;
  if (curve.ownScheme && curve.ownScheme->held == false) words.push_back("its own scheme");
  for (const CollisionQuantity& quantity : scoredQuantities())
    if (const auto& score = declaredScore(curve).of[quantity.id]; score && score->held == false)
      words.push_back(quantityWords(quantity));
  return words;
}

/// "tension cut (two engines) and dashpot outside (one of them)"
std::string told(const Causes& causes) {
  Names words;
  for (const Cause& cause : causes | std::views::take(mostCauses))
    words.push_back(
        fmt::format("{} ({})", cause.words, listedShortly(cause.engines, mostOfACause)));
  return listed(words);
}

/// "siconos (44 of 45 sweeps) and grain (2 of 242)"
std::string toldShort(std::vector<Standing> standings) {
  std::erase_if(standings, [](const Standing& one) { return one.fellShort == 0; });
  std::ranges::stable_sort(standings, std::greater(), [](const Standing& one) {
    return static_cast<double>(one.fellShort) / one.judged();
  });
  Names words;
  for (const Standing& one : standings)
    words.push_back(fmt::format("{} ({} of {}{})", one.engine, one.fellShort, one.judged(),
                                words.empty() ? " sweeps" : ""));
  return listedShortly(words, mostEngines);
}

/// Engines that hold in every sweep that was judged.
Names holdAll(const std::vector<Standing>& standings) {
  Names names;
  for (const Standing& one : standings)
    if (one.held > 0 && one.held == one.judged()) names.push_back(one.engine);
  return names;
}

/// "Held: grain; fell short: siconos." Of what has no words nothing is said.
std::string sentenceOf(const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string sentence;
  for (const auto& [what, words] : parts)
    if (!words.empty())
      sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", what, words);
  if (sentence.empty()) return {};
  sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
  return sentence + ".";
}

std::string whoHolds(const CollideResults& results) {
  const std::vector<Standing> standings = standingsOf(results);
  Names ownLaw, unjudged;
  for (const Standing& one : standings) {
    if (one.model > 0 && one.fellShort == 0) ownLaw.push_back(one.engine);
    if (one.judged() == 0) unjudged.push_back(one.engine);
  }
  const std::string sentence =
      sentenceOf({{"held in every sweep", listedShortly(holdAll(standings), mostEngines)},
                  {"true to a law of their own", listedShortly(ownLaw, mostEngines)},
                  {"fell short", toldShort(standings)},
                  {"not judged", listedShortly(unjudged, mostEngines)}});
  return sentence.empty() ? "No engine took part." : sentence;
}

std::string whatIsToBlame(const CollideResults& results) {
  const Causes quantities = causesOf(results, SweepOutcome::fellShort, shortIn);
  return sentenceOf(
      {{"laws differ most by",
        told(causesOf(results, SweepOutcome::modelDifference, conventionsIn))},
       {"what falls short most often", quantities.empty() ? "" : quantities.front().words}});
}

std::string nextStep(const CollideResults& results) {
  if (const std::string nothing = nothingJudged(results); !nothing.empty())
    return fmt::format("Nothing was judged: {}.", nothing);
  const CollideCount count = countOf(results);
  if (count.failed > 0) return "Next: see why sweeps failed, in the table of scores.";
  if (count.fellShort > 0)
    return "Next: see whether what falls short shrinks with the time step; if it does not, it is a "
           "fault or another law.";
  if (count.modelDifference == 0)
    return "Nothing here speaks against any of these engines at these time steps.";
  const Names hold = holdAll(standingsOf(results));
  return fmt::format("Next: where the scene's own law is needed, take {}.",
                     hold.empty() ? "an engine that has it" : listedShortly(hold, mostEngines));
}

}  // namespace

std::vector<std::string> collideConclusion(const CollideResults& results) {
  std::vector<std::string> sentences;
  for (std::string& sentence :
       std::vector{whoHolds(results), whatIsToBlame(results), nextStep(results)})
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace crossgrain::reports
