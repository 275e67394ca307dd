#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/stability/table.hpp"

namespace crossgrain::reports {

namespace {

const VerdictLook& lookOf(const Json& run) {
  return verdictLooks[verdictRank(text(run, "verdict"))];
}

/// The clause that says what is lacking, of "X cannot run FILE: CLAUSE; HINT".
std::string shortReason(const Json& run) {
  const std::string reason = text(run, "reason");
  const auto clause = reason.find(".toml: ");
  if (text(run, "verdict") != "refused" || clause == std::string::npos) return reason;
  const std::string rest = reason.substr(clause + 7);
  return rest.substr(0, rest.find("; list "));
}

std::string valueOf(const Json& run) {
  const auto value = number(run, "value");
  if (!value) return {};
  return *value > 1e300 ? "beyond numbers" : readable(value);
}

/// "3.2 × its limit", "step 120"
Json cellOf(const Json& run) {
  if (run.is_null()) return {{"text", absentText}, {"class", ""}, {"lines", Json::array()}};
  Json lines = Json::array();
  const VerdictLook& look = lookOf(run);
  if (const std::string value = valueOf(run); !value.empty()) lines.push_back(value);
  if (const auto step = number(run, "step"); step && look.name != "stable")
    lines.push_back("from step " + readableCount(step));
  if (!number(run, "value")) lines.push_back(mathHtml(shortReason(run)));
  return {{"text", fmt::format("{} {}", look.mark, look.name)},
          {"class", look.cssClass},
          {"lines", std::move(lines)}};
}

Json cellsOf(const Json& results, const std::vector<EngineResults>& engines, const auto& runFor) {
  Json cells = Json::array();
  for (const EngineResults& engine : engines) cells.push_back(cellOf(runFor(results, engine)));
  return cells;
}

/// Every verdict of an engine in a case at a glance: "3 of 4 stable".
std::string tallyOf(const Json& results, const std::string& engine, const HardGroup& group) {
  int stable = 0, judged = 0;
  for (const Json* variant : group.variants) {
    const Json& run = runOf(results, engine, *variant);
    stable += text(run, "verdict") == "stable";
    judged += verdictRank(text(run, "verdict")) > 0;
  }
  return judged > 1 ? fmt::format("{} of {} stable", stable, judged) : std::string();
}

Json matrixOf(const Json& results, const std::vector<HardGroup>& groups,
              const std::vector<EngineResults>& engines) {
  Json rows = Json::array();
  for (const HardGroup& group : groups) {
    Json cells = cellsOf(results, engines, [&](const Json& all, const EngineResults& engine) {
      return worstRun(all, engine.name, group);
    });
    for (std::size_t e = 0; e < engines.size(); ++e)
      if (const std::string tally = tallyOf(results, engines[e].name, group); !tally.empty())
        cells[e]["lines"].insert(cells[e]["lines"].begin(), tally);
    rows.push_back({{"id", fmt::format("case_{}", rows.size() + 1)},
                    {"name", spaced(group.name)},
                    {"measure", spaced(text(*group.variants.front(), "measure"))},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

std::string unitOf(const Json& of) {
  const std::string unit = text(of, "unit");
  return unit == "-" ? "" : unit;
}

std::string limitsOf(const Json& variant) {
  const std::string unit = unitOf(variant);
  return fmt::format("{}{}{}, degraded up to {}", readableSetting(number(variant, "limit")),
                     unit.empty() ? "" : " ", unit,
                     readableSetting(number(variant, "degraded_limit")));
}

/// Their titles are "ENGINE: CASE" or "ENGINE: CASE, VARIANT".
Json pictureViewsOf(const Illustrations& shown, const std::string& name) {
  Json views = Json::array();
  for (Json& view : pictureViews(shown, Picture::Shows::worst)) {
    const std::string title = text(view, "alt") + ",";
    if (title.find(": " + name + ",") != std::string::npos) views.push_back(std::move(view));
  }
  return views;
}

Json casesOf(const Json& results, const std::vector<HardGroup>& groups,
             const std::vector<EngineResults>& engines, const Illustrations& shown) {
  Json views = Json::array();
  for (const HardGroup& group : groups) {
    const Json& first = *group.variants.front();
    Json rows = Json::array();
    for (const Json* variant : group.variants)
      rows.push_back(
          {{"name", text(*variant, "variant")},
           {"otherMeasure", text(*variant, "measure") == text(first, "measure")
                                ? ""
                                : spaced(text(*variant, "measure"))},
           {"limit", readableSetting(number(*variant, "limit"))},
           {"degraded", readableSetting(number(*variant, "degraded_limit"))},
           {"cells", cellsOf(results, engines, [&](const Json& all, const EngineResults& engine) {
              return runOf(all, engine.name, *variant);
            })}});
    Json pictures = pictureViewsOf(shown, group.name);
    const std::size_t index = views.size() + 1;
    Json figures = Json::array();
    for (Json& view : figureViews(shown, fmt::format("stability_{}", index)))
      if (text(view, "file") == fmt::format("stability_{}", index))
        figures.push_back(std::move(view));
    views.push_back({{"id", fmt::format("case_{}", index)},
                     {"name", spaced(group.name)},
                     {"tests", text(first, "tests")},
                     {"measure", spaced(text(first, "measure"))},
                     {"what", text(first, "what")},
                     {"unit", unitOf(first)},
                     {"limits", limitsOf(first)},
                     {"why", text(first, "why")},
                     {"file", text(first, "file")},
                     {"toml", text(first, "toml")},
                     {"variants", std::move(rows)},
                     {"hasPictures", !pictures.empty()},
                     {"pictures", std::move(pictures)},
                     {"hasFigures", !figures.empty()},
                     {"figures", std::move(figures)}});
  }
  return views;
}

void addSummary(Json& view, const Json& results, const std::vector<EngineResults>& engines) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::map<std::string, int> all;
  for (const Json& run : list(results, "runs")) {
    ++counts[text(run, "engine")][text(run, "verdict")];
    ++all[text(run, "verdict")];
  }
  const int judged = all["stable"] + all["degraded"] + all["unstable"];
  view["lead"] =
      fmt::format("{} of {} runs of hard cases stayed within their limits.", all["stable"], judged);
  view["sentences"] = Json::array();
  for (const EngineResults& engine : engines) {
    std::vector<std::string> words;
    for (const auto& [verdict, count] : counts[engine.name])
      words.push_back(fmt::format("{} {}", count, verdict));
    view["sentences"].push_back(fmt::format("{}: {}.", engine.name, fmt::join(words, ", ")));
  }
}

Json scoreRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& run : list(results, "runs")) {
    const VerdictLook& look = lookOf(run);
    rows.push_back({{"engine", text(run, "engine")},
                    {"case", spaced(text(run, "case"))},
                    {"variant", text(run, "variant")},
                    {"verdict", fmt::format("{} {}", look.mark, look.name)},
                    {"class", look.cssClass},
                    {"measure", spaced(text(run, "measure"))},
                    {"value", valueOf(run)},
                    {"limit", readableSetting(number(run, "limit"))},
                    {"degraded", readableSetting(number(run, "degraded_limit"))},
                    {"unit", unitOf(run)},
                    {"step", number(run, "step") ? readableCount(number(run, "step")) : ""},
                    {"reason", shortReason(run)}});
  }
  return rows;
}

}  // namespace

std::string stabilityPage(const Json& results, const Illustrations& shown) {
  const std::vector<EngineResults> engines = engineResults(results);
  const std::vector<HardGroup> groups = hardGroups(results);
  Json view = commonView(results, shown);
  addSummary(view, results, engines);
  view["engines"] = columnsView(engines);
  for (std::size_t k = 0; k < engines.size(); ++k)
    for (const char* key : {"version", "summary"})
      view["engines"][k][key] = text(*engines[k].entry, key);
  view["map"] = figureViews(shown, "stability_map");
  view["matrix"] = matrixOf(results, groups, engines);
  view["cases"] = casesOf(results, groups, engines, shown);
  view["scores"] = scoreRows(results);
  view["files"] = "Beside this page: results.json (everything) and stability.csv.";
  return render("report_stability.html", view);
}

}  // namespace crossgrain::reports
