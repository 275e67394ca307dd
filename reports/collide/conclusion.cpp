#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "reports/collide/overview.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

/// Of a list in a sentence: the matrix above has all names.
constexpr std::size_t mostEngines = 5, mostCauses = 2;

/// What engines came to: their names by it.
struct Standings {
  Names hold, ownLaw, fallShort, unjudged;
};

/// What makes sweeps differ or fall short: in how many, and of which engines.
struct Cause {
  std::string words;
  int sweeps = 0;
  Names engines;
};
using Causes = std::vector<Cause>;

/// Engines that are asked: not the mirrors beside their peers.
Names asked(const CollideResults& results) {
  Names names;
  for (const EngineRow& engine : results.engines)
    if (!runsBesideItsPeer(results, engine.name)) names.push_back(engine.name);
  return names;
}

Standings standingsOf(const CollideResults& results) {
  Standings standings;
  for (const std::string& engine : asked(results)) {
    int held = 0, model = 0, fellShort = 0;
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine)) {
        const SweepOutcome outcome = outcomeOf(*curve);
        held += outcome == SweepOutcome::held;
        model += outcome == SweepOutcome::modelDifference;
        fellShort += outcome == SweepOutcome::fellShort;
      }
    Names& names = fellShort > 0 ? standings.fallShort
                   : model > 0   ? standings.ownLaw
                   : held > 0    ? standings.hold
                                 : standings.unjudged;
    names.push_back(engine);
  }
  return standings;
}

void count(Causes& causes, const std::string& words, const std::string& engine) {
  auto cause = std::ranges::find(causes, words, &Cause::words);
  if (cause == causes.end()) cause = causes.insert(causes.end(), {words, 0, {}});
  ++cause->sweeps;
  if (cause->engines.empty() || cause->engines.back() != engine) cause->engines.push_back(engine);
}

/// Of the sweeps that came out so, the most frequent cause first.
/// @param causesIn  of a sweep: its causes' words
Causes causesOf(const CollideResults& results, SweepOutcome outcome, const auto& causesIn) {
  Causes causes;
  for (const std::string& engine : asked(results))
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine))
        if (outcomeOf(*curve) == outcome)
          for (const std::string& words : causesIn(*curve)) count(causes, words, engine);
  std::ranges::stable_sort(causes, std::greater(), &Cause::sweeps);
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

/// "tension cut (yade and liggghts) and dashpot outside (yade)"
std::string told(const Causes& causes) {
  Names words;
  for (const Cause& cause : causes) {
    if (words.size() == mostCauses) break;
    words.push_back(fmt::format("{} ({})", cause.words, listedShortly(cause.engines, 3)));
  }
  return listed(words);
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
  const Standings standings = standingsOf(results);
  const auto names = [](const Names& all) { return listedShortly(all, mostEngines); };
  const std::string sentence = sentenceOf({{"held in every sweep", names(standings.hold)},
                                           {"true to a law of their own", names(standings.ownLaw)},
                                           {"fell short", names(standings.fallShort)},
                                           {"not judged", names(standings.unjudged)}});
  return sentence.empty() ? "No engine took part." : sentence;
}

std::string whatIsToBlame(const CollideResults& results) {
  return sentenceOf(
      {{"laws differ by", told(causesOf(results, SweepOutcome::modelDifference, conventionsIn))},
       {"what falls short most often", told(causesOf(results, SweepOutcome::fellShort, shortIn))}});
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
  const Names hold = standingsOf(results).hold;
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
