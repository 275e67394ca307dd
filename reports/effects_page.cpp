#include <fmt/format.h>

#include <algorithm>

#include "reports/compare_views.hpp"
#include "reports/effect_views.hpp"
#include "reports/figures.hpp"
#include "reports/numbers.hpp"
#include "reports/page.hpp"

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
    if (leg.saved && (!dearest || *leg.saved > *dearest->saved)) dearest = &leg;
  if (!dearest || *dearest->saved <= 0.0) return "none costs time";
  return fmt::format("the dearest is {}, {:.0f} % of a step", effectLabel(dearest->effect),
                     100.0 * *dearest->saved);
}

std::string leadOf(const std::string& engine, std::vector<EffectLeg> legs) {
  std::erase_if(legs, [](const EffectLeg& leg) { return !leg.ran(); });
  if (legs.empty()) return fmt::format("Nothing could be switched off on {}.", engine);
  const auto changing =
      static_cast<std::size_t>(std::ranges::count_if(legs, &EffectLeg::changesSomething));
  const std::string effects = counted(legs.size(), "effect");
  if (std::ranges::none_of(legs, &EffectLeg::decidable))
    return fmt::format("On {}, of {} of this scene {}.", engine, effects, dearestInWords(legs));
  return fmt::format("On {}, {} of {} of this scene {} a profile detectably; {}.", engine, changing,
                     effects, changing == 1 ? "changes" : "change", dearestInWords(legs));
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
  return list(results, "packings").size() > 1
             ? "± one standard error of the change over packings, each packing held against itself"
             : "± one standard error within the two runs of one packing: it says nothing about "
               "other packings";
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
  }
  return all;
}

}  // namespace

std::string effectsPage(const Json& results, const Illustrations& shown) {
  const Engines engines = engineResults(results);
  std::vector<RealisedOf> realised;
  for (const EngineResults& engine : engines)
    if (engine.realised().is_object()) realised.push_back({engine.name, &engine.realised()});

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
  addDetails(view, results, realised);
  view["packings"] = packingRows(results);
  view["files"] =
      "Beside this page: results.json (everything) and effects.csv (every ring of every field).";
  return render("report_effects.html", view);
}

}  // namespace crossgrain::reports
