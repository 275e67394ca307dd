#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/packings.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/effects/overview.hpp"
#include "reports/effects/report.hpp"
#include "reports/effects/views.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

std::vector<VariantSummary> variantsOf(const EffectsResults& results, const std::string& engine) {
  std::vector<VariantSummary> variants = variantSummaries(results);
  std::erase_if(variants, [&](const VariantSummary& variant) { return variant.engine != engine; });
  return variants;
}

std::string dearestInWords(const std::vector<VariantSummary>& variants) {
  const VariantSummary* dearest = nullptr;
  for (const VariantSummary& variant : variants)
    if (variant.saved && costsTime(variant) && (!dearest || *variant.saved > *dearest->saved))
      dearest = &variant;
  if (!dearest) return "none is shown to cost time";
  return fmt::format("the dearest is {}, {:.0f} % of a step", effectLabel(dearest->effect),
                     100.0 * *dearest->saved);
}

/// "1 of 3 effects of this scene changes a profile detectably, of 2 no change is told apart from
/// none (1 is shown within every margin)": three things, each counted by itself.
std::string changesInCounts(const std::vector<VariantSummary>& variants) {
  const auto count = [&](const auto& is) {
    return static_cast<std::size_t>(std::ranges::count_if(variants, is));
  };
  const std::size_t changing = count(&VariantSummary::changesSomething);
  const std::size_t open = count([](const VariantSummary& variant) {
    return variant.decidable() && !variant.changesSomething();
  });
  const std::size_t within = count(&VariantSummary::withinMargins);
  const std::size_t untold = variants.size() - changing - open;
  std::string words =
      fmt::format("{} of {} of this scene {} a profile detectably", changing,
                  counted(variants.size(), "effect"), changing == 1 ? "changes" : "change");
  if (open > 0) words += fmt::format(", of {} no change is told apart from none", open);
  if (untold > 0) words += fmt::format(", of {} it cannot be told", untold);
  if (within > 0)
    words += fmt::format(" ({} {} shown within every margin)", within, within == 1 ? "is" : "are");
  return words;
}

std::string leadOf(const std::string& engine, std::vector<VariantSummary> variants) {
  const std::size_t all = variants.size();
  std::erase_if(variants, [](const VariantSummary& variant) { return !variant.ran(); });
  const std::string notRun =
      variants.size() == all
          ? std::string()
          : fmt::format(" Not measured: {}.", counted(all - variants.size(), "effect"));
  if (variants.empty())
    return fmt::format("Nothing could be switched off on {}.{}", engine, notRun);
  if (std::ranges::none_of(variants, &VariantSummary::decidable))
    return fmt::format("On {}, of {} of this scene {}.{}", engine,
                       counted(variants.size(), "effect"), dearestInWords(variants), notRun);
  return fmt::format("On {}, {}; {}.{}", engine, changesInCounts(variants),
                     dearestInWords(variants), notRun);
}

std::string sentenceOf(const VariantSummary& variant) {
  std::string effect = effectLabel(variant.effect);
  effect[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(effect[0])));
  if (!variant.ran())
    return fmt::format("{}: {}: {}.", effect, nameOf(variant.status), variant.reason);
  const std::string changes = changesInWords(variant);
  return fmt::format("{} {}{}{}.", effect, costInWords(variant), changes.empty() ? "" : "; ",
                     changes);
}

Json sentencesOf(const EffectsResults& results, const std::string& engine) {
  Json sentences = Json::array();
  for (const VariantSummary& variant : variantsOf(results, engine))
    sentences.push_back(sentenceOf(variant));
  return sentences;
}

/// What the figures rest on.
Json basis(const EffectsResults& results) {
  const CouetteAveraging& averaging = results.averaging;
  Json sentences = Json::array();
  if (results.packings.size() < 4)
    sentences.push_back(
        "Fewer than 4 packings: what an effect changes cannot be told from the scatter between "
        "packings.");
  sentences.push_back(fmt::format(
      "Changes are in % of the profile's largest value with everything on. {}; rotations averaged "
      "in each run: {}, after {} of settling.",
      counted(results.packings.size(), "packing"), readableSetting(averaging.rotations),
      readableSetting(averaging.settleRotations)));
  return sentences;
}

/// One engine: a sentence on each effect. Several: one on each engine, the others with its study.
void addEffectSummary(Json& view, const EffectsResults& results, const Engines& engines) {
  view["sentences"] = Json::array();
  if (engines.size() == 1) view["sentences"] = sentencesOf(results, engines.front().name);
  view["lead"] = engines.empty()
                     ? "Nothing ran."
                     : leadOf(engines.front().name, variantsOf(results, engines.front().name));
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].status != EngineStatus::refused)
      view["sentences"].push_back(leadOf(engines[k].name, variantsOf(results, engines[k].name)));
  for (const EngineRuns& engine : engines)
    if (engine.status == EngineStatus::refused)
      view["sentences"].push_back(
          fmt::format("{} refused the scene: {}", engine.name, engine.reason));
  for (const Json& sentence : basis(results)) view["sentences"].push_back(sentence);
}

std::string barsOf(const EffectsResults& results) {
  const std::size_t packings = results.packings.size();
  if (packings >= 4)
    return "in brackets the interval that the verdict rests on, over packings, each held against "
           "itself: it leaves out 0 exactly where the change is told apart";
  return packings > 1 ? "± one standard error of the change over packings, each packing held "
                        "against itself"
                      : "± one standard error within the two runs of one packing: it says nothing "
                        "about other packings";
}

Json switchRows(const EffectsResults& results) {
  Json rows = Json::array();
  for (const SwitchRow& one : results.switches)
    rows.push_back({{"label", variantLabel(one.effect)}, {"what", one.what}});
  return rows;
}

Json studies(const EffectsResults& results, const Engines& engines, const Illustrations& shown) {
  Json all = Json::array();
  for (std::size_t k = 0; k < engines.size(); ++k) {
    if (!wholeVariant(results, engines[k].name)) continue;
    const std::string prefix = fmt::format("effects_{}_", k + 1);
    all.push_back(
        {{"engine", engines[k].name},
         {"id", fmt::format("effects-{}", k + 1)},
         {"sentences", engines.size() > 1 ? sentencesOf(results, engines[k].name) : Json::array()},
         {"cost", figureViews(shown, prefix + "cost")},
         {"table", effectTable(results, engines[k].name)},
         {"profiles", figureViews(shown, prefix + "profile_")}});
    all.back()["hasSentences"] = !all.back()["sentences"].empty();
    all.back()["hasProfiles"] = !all.back()["profiles"].empty();
    // With too few packings no run is drawn grey.
    all.back()["hasFaint"] = std::ranges::any_of(
        variantsOf(results, engines[k].name), [](const VariantSummary& variant) {
          return variant.ran() &&
                 std::ranges::any_of(variant.changes, [](const FieldChange& change) {
                   return change.detected == std::optional(false);
                 });
        });
  }
  return all;
}

}  // namespace

std::string effectsPage(const EffectsResults& results, const Illustrations& shown) {
  const Engines engines = engineRuns(results, results.ensemble);
  Json view = studyView(results, shown);
  addEffectSummary(view, results, engines);
  addOverview(view, effectsOverview(results), results.engines);
  view["columns"] = columnsView(engines);
  addEngineTable(view, engines);
  addTroubles(view, engines);
  view["falseAlarm"] = fmt::format("{:.3g} %", 100.0 * (1.0 - results.averaging.confidence));
  view["rounds"] = readableCount(results.timing.rounds);
  view["seconds"] = readableSetting(results.timing.seconds);
  view["bars"] = barsOf(results);
  view["averages"] = averagesInWords(results);
  view["switches"] = switchRows(results);
  view["studies"] = studies(results, engines, shown);
  addDetails(view, realisedOf(results, engines));
  view["packings"] = packingRows(results.packings);
  view["files"] =
      "Beside this page: results.json (everything) and effects.csv (every ring of every field).";
  return render("report_effects.html", view);
}

}  // namespace crossgrain::reports
