#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

/// One row per deviation; one that an engine reports again and again is shown once.
Json deviationRows(const std::vector<RealisedOf>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene, calledFor] : realised)
    for (const Json& deviation : list(*scene, "deviations")) {
      const auto value = number(deviation, "value");
      const std::string unit = text(deviation, "unit");
      const bool says = value && (*value != 0.0 || !unit.empty());
      Json row = {{"engine", engine},
                  {"name", spaced(text(deviation, "name"))},
                  {"value", says ? readable(value) + (unit.empty() || unit == "-" ? "" : " " + unit)
                                 : absentText},
                  {"note", text(deviation, "note")}};
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
    }
  return rows;
}

Json pairRows(const std::vector<RealisedOf>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene, calledFor] : realised)
    for (const Json& pair : list(*scene, "pairs")) {
      Json cells = Json::array();
      for (const char* constant : {"kn", "gn", "kt", "gt", "mu", "en", "et0"})
        cells.push_back(readableSetting(number(pair, constant)));
      Json row = {{"engine", engine}, {"pair", text(pair, "pair")}, {"cells", std::move(cells)}};
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
    }
  return rows;
}

bool holds(const Json& names, const std::string& name) {
  return std::ranges::find(names, Json(name)) != names.end();
}

/// How often an effect was called for, and simulated, in the scenes that one engine loaded.
struct EffectTally {
  std::size_t calledFor = 0, missing = 0, unasked = 0, scenes = 0;
};

EffectTally tallyOf(const std::string& effect, const std::vector<RealisedOf>& scenes) {
  EffectTally tally;
  for (const RealisedOf& scene : scenes) {
    const bool called = holds(*scene.calledFor, effect);
    const bool simulated = holds(list(*scene.realised, "effects"), effect);
    ++tally.scenes;
    tally.calledFor += called;
    tally.missing += called && !simulated;
    tally.unasked += simulated && !called;
  }
  return tally;
}

/// "", or " in 2 of 3 runs" where it is not all of them.
std::string share(std::size_t some, std::size_t all) {
  return some == all ? std::string() : fmt::format(" in {} of {}", some, counted(all, "run"));
}

Json effectCell(const EffectTally& tally) {
  std::vector<std::string> words;
  if (tally.missing < tally.calledFor)
    words.push_back("✓ simulated" + share(tally.calledFor - tally.missing, tally.calledFor));
  if (tally.missing > 0) words.push_back("✗ not simulated" + share(tally.missing, tally.calledFor));
  if (tally.unasked > 0)
    words.push_back("+ though not called for" + share(tally.unasked, tally.scenes));
  const bool differs = tally.missing + tally.unasked > 0;
  return {{"text", words.empty() ? absentText : fmt::format("{}", fmt::join(words, "; "))},
          {"class", differs ? "disagree" : ""}};
}

using ScenesOf = std::vector<std::pair<std::string, std::vector<RealisedOf>>>;

/// Each engine with the scenes whose effects are known, called for and simulated.
ScenesOf scenesByEngine(const std::vector<RealisedOf>& realised) {
  ScenesOf engines;
  for (const RealisedOf& entry : realised) {
    if (!entry.calledFor->is_array() || !member(*entry.realised, "effects").is_array()) continue;
    auto engine = std::ranges::find(engines, entry.engine, &ScenesOf::value_type::first);
    if (engine == engines.end()) engine = engines.insert(engine, {entry.engine, {}});
    engine->second.push_back(entry);
  }
  return engines;
}

/// "called for", "called for in 2 of 3 scenes" or a dash.
std::string calledForInWords(const std::string& effect, const std::set<const Json*>& scenes) {
  const auto calling = std::ranges::count_if(
      scenes, [&](const Json* calledFor) { return holds(*calledFor, effect); });
  if (calling == 0) return absentText;
  return std::cmp_equal(calling, scenes.size())
             ? "called for"
             : fmt::format("called for in {} of {} scenes", calling, scenes.size());
}

Json effectRows(const ScenesOf& engines) {
  std::vector<std::string> names;
  const auto add = [&](const Json& effects) {
    for (const Json& effect : effects)
      if (effect.is_string() && std::ranges::find(names, effect.get<std::string>()) == names.end())
        names.push_back(effect.get<std::string>());
  };
  std::set<const Json*> scenes;
  for (const auto& [engine, entries] : engines)
    for (const RealisedOf& entry : entries) {
      scenes.insert(entry.calledFor);
      add(*entry.calledFor);
    }
  for (const auto& [engine, entries] : engines)
    for (const RealisedOf& entry : entries) add(list(*entry.realised, "effects"));
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

void addDetails(Json& view, const std::vector<RealisedOf>& realised) {
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

Json packingRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& packing : list(results, "packings")) {
    const Json &index = member(packing, "index"), &seed = member(packing, "seed");
    rows.push_back({{"index", index.is_number() ? index.dump() : ""},
                    {"seed", seed.is_number() ? seed.dump() : ""},
                    {"hash", text(packing, "hash")},
                    {"source", member(packing, "from_cache") == Json(true) ? "earlier, kept"
                                                                           : "for this run"}});
  }
  return rows;
}

std::string averagesInWords(const Json& results) {
  const Json& averaging = member(results, "averaging");
  const std::string width = readable(number(member(results, "rings"), "width"));
  const std::string when = averagedRotations(results);
  return fmt::format("{} rings of width {} m, weights by {}, {} snapshots a run{}.",
                     list(member(results, "rings"), "r").size(), width, text(averaging, "method"),
                     readableCount(number(averaging, "snapshots")),
                     when.empty() ? std::string() : ", " + when);
}

}  // namespace crossgrain::reports
