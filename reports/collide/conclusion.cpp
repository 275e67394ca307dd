#include <fmt/format.h>

#include <algorithm>

#include "reports/collide/overview.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

/// Of one engine: outcomes by number, and the places of what fell short.
struct EngineOutcomes {
  int held = 0, model = 0, fellShort = 0;
  Names shortIn;     ///< cases
  Names quantities;  ///< beyond their limits in these

  int judged() const { return held + model + fellShort; }
};

void addOnce(Names& names, std::string name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
}

EngineOutcomes outcomesOf(const CollideResults& results, const std::string& engine) {
  EngineOutcomes all;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve* curve : curvesOf(variant, engine)) {
      const SweepOutcome outcome = outcomeOf(*curve);
      all.held += outcome == SweepOutcome::held;
      all.model += outcome == SweepOutcome::modelDifference;
      if (outcome != SweepOutcome::fellShort) continue;
      ++all.fellShort;
      addOnce(all.shortIn, caseOf(results, variant));
      if (curve->ownScheme && curve->ownScheme->held == false)
        addOnce(all.quantities, "its own scheme");
      for (const CollisionQuantity& quantity : scoredQuantities())
        if (const auto& score = declaredScore(*curve).of[quantity.id];
            score && score->held == false)
          addOnce(all.quantities, quantityWords(quantity));
    }
  return all;
}

/// "grain holds all of 24 sweeps"
std::string whoHolds(const CollideResults& results) {
  SaidOf said;
  for (const EngineRow& engine : results.engines) {
    if (runsBesideItsPeer(results, engine.name)) continue;
    const EngineOutcomes all = outcomesOf(results, engine.name);
    if (all.judged() == 0) {
      said.add(engine.name, "nothing was judged");
      continue;
    }
    std::string words = all.held == all.judged()
                            ? allOf(static_cast<std::size_t>(all.judged()), "sweep") + " held"
                            : fmt::format("{} of {} sweeps held", all.held, all.judged());
    if (all.fellShort > 0)
      words += fmt::format(", {} fell short in {} ({})", all.fellShort,
                           listedShortly(all.shortIn, 2), listedShortly(all.quantities, 3));
    if (all.model > 0) words += fmt::format(", {} differ by their model", all.model);
    said.add(engine.name, words);
  }
  std::string sentence;
  for (const auto& [words, engines] : said.all())
    sentence += fmt::format("{}{}: {}", sentence.empty() ? "" : "; ", listed(engines), words);
  return sentence.empty() ? "No engine took part." : sentence + ".";
}

/// The conventions in which declared laws are others than the scene's, of what differs by its
/// model.
std::string whichConventions(const CollideResults& results) {
  Names parts;
  for (const EngineRow& engine : results.engines) {
    if (runsBesideItsPeer(results, engine.name)) continue;
    Names words;
    for (const CollisionVariant& variant : results.variants)
      for (const CollisionCurve* curve : curvesOf(variant, engine.name))
        if (outcomeOf(*curve) == SweepOutcome::modelDifference && curve->declared)
          for (const auto& [name, value] : curve->declared->law)
            if (std::holds_alternative<std::string>(value))  // constants follow from conventions
              addOnce(words, *lawWords(name, value));
    if (!words.empty())
      parts.push_back(fmt::format("{} has {}", engine.name, listedShortly(words, 3)));
  }
  if (parts.empty()) return {};
  std::string sentence = "Models differ because ";
  for (std::size_t k = 0; k < parts.size(); ++k) sentence += (k == 0 ? "" : "; ") + parts[k];
  return sentence + ".";
}

std::string nextStep(const CollideResults& results) {
  if (const std::string nothing = nothingJudged(results); !nothing.empty())
    return fmt::format("Nothing was judged: {}.", nothing);
  const CollideCount count = countOf(results);
  if (count.failed > 0) return "Next: see why sweeps failed, in the table of scores.";
  if (count.fellShort > 0)
    return "Next: see at which time steps what fell short does; an error that falls with the step "
           "asks for a smaller one, one that does not is a fault or another law.";
  if (count.modelDifference > 0)
    return "Next: where the scene's own law is needed, take an engine that has it.";
  return "Nothing here speaks against any of these engines at these time steps.";
}

}  // namespace

std::vector<std::string> collideConclusion(const CollideResults& results) {
  std::vector<std::string> sentences;
  for (std::string& sentence :
       std::vector{whoHolds(results), whichConventions(results), nextStep(results)})
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace crossgrain::reports
