#include <fmt/format.h>

#include <algorithm>

#include "reports/common/figures.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/effects/views.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

std::vector<EffectLeg> legsOf(const Json& results, const std::string& engine) {
  std::vector<EffectLeg> legs = effectLegs(results);
  std::erase_if(legs, [&](const EffectLeg& leg) { return leg.engine != engine; });
  return legs;
}

std::string dearestInWords(const std::vector<EffectLeg>& legs) {
  const EffectLeg* dearest = nullptr;
  for (const EffectLeg& leg : legs)
    if (leg.saved && costsTime(leg) && (!dearest || *leg.saved > *dearest->saved)) dearest = &leg;
  if (!dearest) return "none is shown to cost time";
  return fmt::format("the dearest is {}, {:.0f} % of a step", effectLabel(dearest->effect),
                     100.0 * *dearest->saved);
}

/// "1 of 3 effects of this scene changes a profile detectably, of 2 no change is told apart from
/// none (1 is shown within every margin)": three things, each counted by itself.
std::string changesInCounts(const std::vector<EffectLeg>& legs) {
  const auto count = [&](const auto& is) {
    return static_cast<std::size_t>(std::ranges::count_if(legs, is));
  };
  const std::size_t changing = count(&EffectLeg::changesSomething);
  const std::size_t open =
      count([](const EffectLeg& leg) { return leg.decidable() && !leg.changesSomething(); });
  const std::size_t within = count(&EffectLeg::withinMargins);
  const std::size_t untold = legs.size() - changing - open;
  std::string words =
      fmt::format("{} of {} of this scene {} a profile detectably", changing,
                  counted(legs.size(), "effect"), changing == 1 ? "changes" : "change");
  if (open > 0) words += fmt::format(", of {} no change is told apart from none", open);
  if (untold > 0) words += fmt::format(", of {} it cannot be told", untold);
  if (within > 0)
    words += fmt::format(" ({} {} shown within every margin)", within, within == 1 ? "is" : "are");
  return words;
}

std::string leadOf(const std::string& engine, std::vector<EffectLeg> legs) {
  const std::size_t all = legs.size();
  std::erase_if(legs, [](const EffectLeg& leg) { return !leg.ran(); });
  const std::string notRun =
      legs.size() == all ? std::string()
                         : fmt::format(" Not measured: {}.", counted(all - legs.size(), "effect"));
  if (legs.empty()) return fmt::format("Nothing could be switched off on {}.{}", engine, notRun);
  if (std::ranges::none_of(legs, &EffectLeg::decidable))
    return fmt::format("On {}, of {} of this scene {}.{}", engine, counted(legs.size(), "effect"),
                       dearestInWords(legs), notRun);
  return fmt::format("On {}, {}; {}.{}", engine, changesInCounts(legs), dearestInWords(legs),
                     notRun);
}

std::string sentenceOf(const EffectLeg& leg) {
  std::string effect = effectLabel(leg.effect);
  effect[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(effect[0])));
  if (!leg.ran()) return fmt::format("{}: {}: {}.", effect, leg.status, leg.reason);
  const std::string changes = changesInWords(leg);
  return fmt::format("{} {}{}{}.", effect, costInWords(leg), changes.empty() ? "" : "; ", changes);
}

Json sentencesOf(const Json& results, const std::string& engine) {
  Json sentences = Json::array();
  for (const EffectLeg& leg : legsOf(results, engine)) sentences.push_back(sentenceOf(leg));
  return sentences;
}

/// What the figures rest on.
Json basis(const Json& results) {
  const Json& averaging = member(results, "averaging");
  Json sentences = Json::array();
  if (list(results, "packings").size() < 4)
    sentences.push_back(
        "Fewer than 4 packings: what an effect changes cannot be told from the scatter between "
        "packings.");
  sentences.push_back(fmt::format(
      "Changes are in % of the profile's largest value with everything on. {}; rotations averaged "
      "in each run: {}, after {} of settling.",
      counted(list(results, "packings").size(), "packing"),
      readableSetting(number(averaging, "rotations")),
      readableSetting(number(averaging, "settle_rotations"))));
  return sentences;
}

/// One engine: a sentence on each effect. Several: one on each engine, the others with its study.
void addEffectSummary(Json& view, const Json& results, const Engines& engines) {
  view["sentences"] = Json::array();
  if (engines.size() == 1) view["sentences"] = sentencesOf(results, engines.front().name);
  view["lead"] = engines.empty()
                     ? "Nothing ran."
                     : leadOf(engines.front().name, legsOf(results, engines.front().name));
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].status != "refused")
      view["sentences"].push_back(leadOf(engines[k].name, legsOf(results, engines[k].name)));
  for (const EngineResults& engine : engines)
    if (engine.status == "refused")
      view["sentences"].push_back(
          fmt::format("{} refused the scene: {}", engine.name, text(*engine.entry, "reason")));
  for (const Json& sentence : basis(results)) view["sentences"].push_back(sentence);
}

std::string barsOf(const Json& results) {
  const std::size_t packings = list(results, "packings").size();
  if (packings >= 4)
    return "in brackets the interval that the verdict rests on, over packings, each held against "
           "itself: it leaves out 0 exactly where the change is told apart";
  return packings > 1 ? "± one standard error of the change over packings, each packing held "
                        "against itself"
                      : "± one standard error within the two runs of one packing: it says nothing "
                        "about other packings";
}

Json switchRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& one : list(results, "switches"))
    rows.push_back({{"label", legLabel(text(one, "effect"))}, {"what", text(one, "what")}});
  return rows;
}

Json studies(const Json& results, const Engines& engines, const Illustrations& shown) {
  Json all = Json::array();
  for (std::size_t k = 0; k < engines.size(); ++k) {
    if (!wholeLeg(results, engines[k].name).is_object()) continue;
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
    all.back()["hasFaint"] =
        std::ranges::any_of(legsOf(results, engines[k].name), [](const EffectLeg& leg) {
          return leg.ran() && std::ranges::any_of(leg.changes, [](const FieldChange& change) {
                   return change.detected == std::optional(false);
                 });
        });
  }
  return all;
}

}  // namespace

std::string effectsPage(const Json& results, const Illustrations& shown) {
  const Engines engines = engineResults(results);
  std::vector<RealisedOf> realised;
  for (const EngineResults& engine : engines)
    if (engine.realised().is_object())
      realised.push_back({engine.name, &engine.realised(), &member(results, "effects")});

  Json view = commonView(results, shown);
  addEffectSummary(view, results, engines);
  view["columns"] = columnsView(engines);
  addEngineTable(view, engines);
  addTroubles(view, engines);
  const double confidence = number(member(results, "averaging"), "confidence").value_or(0.95);
  const Json& timing = member(results, "timing");
  view["falseAlarm"] = fmt::format("{:.3g} %", 100.0 * (1.0 - confidence));
  view["rounds"] = readableCount(number(timing, "rounds"));
  view["seconds"] = readableSetting(number(timing, "seconds"));
  view["bars"] = barsOf(results);
  view["averages"] = averagesInWords(results);
  view["switches"] = switchRows(results);
  view["studies"] = studies(results, engines, shown);
  addDetails(view, realised);
  view["packings"] = packingRows(results);
  view["files"] =
      "Beside this page: results.json (everything) and effects.csv (every ring of every field).";
  return render("report_effects.html", view);
}

}  // namespace crossgrain::reports
