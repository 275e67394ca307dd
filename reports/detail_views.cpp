#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/labels.hpp"
#include "reports/numbers.hpp"
#include "reports/page.hpp"
#include "reports/state_view.hpp"

namespace crossgrain::reports {

namespace {

/// One row per deviation; one that an engine reports again and again is shown once.
Json deviationRows(const std::vector<RealisedOf>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene] : realised)
    for (const Json& deviation : list(*scene, "deviations")) {
      const auto value = number(deviation, "value");
      const std::string unit = text(deviation, "unit");
      const bool says = value && (*value != 0.0 || !unit.empty());
      Json row = {{"engine", engine},
                  {"name", spaced(text(deviation, "name"))},
                  {"value", says ? readable(value) + (unit.empty() || unit == "-" ? "" : " " + unit)
                                 : std::string()},
                  {"note", text(deviation, "note")}};
      if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
    }
  return rows;
}

Json pairRows(const std::vector<RealisedOf>& realised) {
  Json rows = Json::array();
  for (const auto& [engine, scene] : realised)
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

Json effectCell(bool calledFor, bool simulated) {
  if (calledFor)
    return simulated ? Json{{"text", "✓ simulated"}, {"class", ""}}
                     : Json{{"text", "✗ not simulated"}, {"class", "disagree"}};
  return simulated ? Json{{"text", "+ though not called for"}, {"class", "disagree"}}
                   : Json{{"text", absentText}, {"class", ""}};
}

/// Each engine once, by its first realised scene that lists effects.
std::vector<RealisedOf> oncePerEngine(const std::vector<RealisedOf>& realised) {
  std::vector<RealisedOf> once;
  std::set<std::string> seen;
  for (const RealisedOf& entry : realised)
    if (member(*entry.realised, "effects").is_array() && seen.insert(entry.engine).second)
      once.push_back(entry);
  return once;
}

Json effectRows(const Json& calledFor, const std::vector<RealisedOf>& engines) {
  std::vector<std::string> names;
  const auto add = [&](const Json& effects) {
    for (const Json& effect : effects)
      if (effect.is_string() && std::ranges::find(names, effect.get<std::string>()) == names.end())
        names.push_back(effect.get<std::string>());
  };
  add(calledFor);
  for (const RealisedOf& engine : engines) add(list(*engine.realised, "effects"));
  Json rows = Json::array();
  for (const std::string& name : names) {
    Json cells = Json::array();
    for (const RealisedOf& engine : engines)
      cells.push_back(
          effectCell(holds(calledFor, name), holds(list(*engine.realised, "effects"), name)));
    rows.push_back({{"name", spaced(name)},
                    {"scene", holds(calledFor, name) ? "called for" : absentText},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

}  // namespace

void addDetails(Json& view, const Json& results, const std::vector<RealisedOf>& realised) {
  view["deviations"] = deviationRows(realised);
  view["hasDeviations"] = !view["deviations"].empty();
  view["pairs"] = pairRows(realised);
  view["hasPairs"] = !view["pairs"].empty();
  const auto engines = oncePerEngine(realised);
  view["effects"] = effectRows(list(results, "effects"), engines);
  view["hasEffects"] = !view["effects"].empty() && !engines.empty();
  view["effectColumns"] = Json::array();
  for (const RealisedOf& engine : engines) view["effectColumns"].push_back(engine.engine);
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
