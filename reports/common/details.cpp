#include "reports/common/details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <set>
#include <utility>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "results/engine_fields.hpp"

namespace crossgrain::reports {

namespace {

/// One row per deviation; one that an engine reports again and again is shown once.
Json deviationRows(const std::vector<RealisedScene>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene, calledFor] : realised)
    for (const auto& [name, value, unit, note] : scene->deviations) {
      const bool says = std::isfinite(value) && (value != 0.0 || !unit.empty());
      Json row = {{"engine", engine},
                  {"name", spaced(name)},
                  {"value", says ? readable(value) + (unit.empty() || unit == "-" ? "" : " " + unit)
                                 : absentText},
                  {"note", note}};
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
    }
  return rows;
}

/// kn, gn, kt, gt, mu, en and et0. A constant of strength 0 is none; restitutions are of pairs
/// without a spring, the tangential one of those with friction.
Json constantsOf(const PairCoefficients& pair) {
  const bool springs = pair.kn > 0.0;
  Json cells = Json::array();
  for (const double constant : {pair.kn, pair.gn, pair.kt, pair.gt, pair.mu})
    cells.push_back(constant != 0.0 ? readableSetting(constant) : absentText);
  cells.push_back(springs ? absentText : readableSetting(pair.en));
  cells.push_back(springs || pair.mu == 0.0 ? absentText : readableSetting(pair.et0));
  return cells;
}

Json pairRows(const std::vector<RealisedScene>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene, calledFor] : realised)
    for (const PairCoefficients& pair : scene->pairs) {
      Json row = {{"engine", engine}, {"pair", pair.pair}, {"cells", constantsOf(pair)}};
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
    }
  return rows;
}

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

Names namesOfEffects(const Realised& realised) {
  Names names;
  for (const Effect effect : realised.effects) names.emplace_back(toString(effect));
  return names;
}

/// How often an effect was called for, and simulated, in the scenes that one engine loaded.
struct EffectTally {
  std::size_t calledFor = 0, missing = 0, unasked = 0, scenes = 0;
};

EffectTally tallyOf(const std::string& effect, const std::vector<RealisedScene>& scenes) {
  EffectTally tally;
  for (const RealisedScene& scene : scenes) {
    const bool called = holds(*scene.calledFor, effect);
    const bool simulated = holds(namesOfEffects(*scene.realised), effect);
    ++tally.scenes;
    tally.calledFor += called;
    tally.missing += called && !simulated;
    tally.unasked += simulated && !called;
  }
  return tally;
}

/// "", or " in 2 of 3 runs" where it is not all of them.
std::string partOf(std::size_t some, std::size_t all) {
  return some == all ? std::string() : fmt::format(" in {} of {}", some, counted(all, "run"));
}

Json effectCell(const EffectTally& tally) {
  std::vector<std::string> words;
  if (tally.missing < tally.calledFor)
    words.push_back("✓ simulated" + partOf(tally.calledFor - tally.missing, tally.calledFor));
  if (tally.missing > 0)
    words.push_back("✗ not simulated" + partOf(tally.missing, tally.calledFor));
  if (tally.unasked > 0)
    words.push_back("+ though not called for" + partOf(tally.unasked, tally.scenes));
  const bool differs = tally.missing + tally.unasked > 0;
  return {{"text", words.empty() ? absentText : fmt::format("{}", fmt::join(words, "; "))},
          {"class", differs ? "disagree" : ""}};
}

using ScenesOf = std::vector<std::pair<std::string, std::vector<RealisedScene>>>;

/// Each engine with the scenes whose effects are known, called for and simulated.
ScenesOf scenesByEngine(const std::vector<RealisedScene>& realised) {
  ScenesOf engines;
  for (const RealisedScene& entry : realised) {
    if (!entry.calledFor) continue;
    auto engine = std::ranges::find(engines, entry.engine, &ScenesOf::value_type::first);
    if (engine == engines.end()) engine = engines.insert(engine, {entry.engine, {}});
    engine->second.push_back(entry);
  }
  return engines;
}

/// "called for", "called for in 2 of 3 scenes" or a dash.
std::string calledForInWords(const std::string& effect, const std::set<const Names*>& scenes) {
  const auto calling = std::ranges::count_if(
      scenes, [&](const Names* calledFor) { return holds(*calledFor, effect); });
  if (calling == 0) return absentText;
  return std::cmp_equal(calling, scenes.size())
             ? "called for"
             : fmt::format("called for in {} of {} scenes", calling, scenes.size());
}

Json effectRows(const ScenesOf& engines) {
  Names names;
  const auto add = [&](const Names& effects) {
    for (const std::string& effect : effects)
      if (!holds(names, effect)) names.push_back(effect);
  };
  std::set<const Names*> scenes;
  for (const auto& [engine, entries] : engines)
    for (const RealisedScene& entry : entries) {
      scenes.insert(entry.calledFor);
      add(*entry.calledFor);
    }
  for (const auto& [engine, entries] : engines)
    for (const RealisedScene& entry : entries) add(namesOfEffects(*entry.realised));
  Json rows = Json::array();
  for (const std::string& name : names) {
    Json cells = Json::array();
    for (const auto& [engine, entries] : engines)
      cells.push_back(effectCell(tallyOf(name, entries)));
    rows.push_back({{"name", spaced(name)},
                    {"scene", calledForInWords(name, scenes)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

}  // namespace

void addDetails(Json& view, const std::vector<RealisedScene>& realised) {
  view["deviations"] = deviationRows(realised);
  view["hasDeviations"] = !view["deviations"].empty();
  view["pairs"] = pairRows(realised);
  view["hasPairs"] = !view["pairs"].empty();
  const ScenesOf engines = scenesByEngine(realised);
  view["effects"] = effectRows(engines);
  view["hasEffects"] = !view["effects"].empty();
  view["effectColumns"] = Json::array();
  for (const auto& [engine, entries] : engines) view["effectColumns"].push_back(engine);
}

}  // namespace crossgrain::reports
