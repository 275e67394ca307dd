#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/stability/overview.hpp"
#include "reports/stability/report.hpp"
#include "reports/stability/table.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

/// The clause that says what is lacking, of "X cannot run FILE: CLAUSE; HINT".
std::string shortReason(const StabilityRun& run) {
  const auto clause = run.reason.find(".toml: ");
  if (run.verdict != StabilityVerdict::refused || clause == std::string::npos) return run.reason;
  const std::string rest = run.reason.substr(clause + 7);
  return rest.substr(0, rest.find("; list "));
}

std::string valueOf(const StabilityRun& run) {
  if (!run.value) return {};
  return *run.value > 1e300 ? "beyond numbers" : readable(run.value);
}

/// Of a case told otherwise: its limit is not the case's.
bool hasOwnLimit(const StabilityRun& run) {
  return std::isfinite(run.limit) && !std::isfinite(run.degradedLimit);
}

/// "3.2 × its limit", "step 120"
Json cellOf(const StabilityRun* run) {
  if (!run) return {{"text", absentText}, {"class", ""}, {"lines", Json::array()}};
  Json lines = Json::array();
  if (const std::string value = valueOf(*run); !value.empty()) lines.push_back(value);
  if (hasOwnLimit(*run)) lines.push_back("rounding may do " + readable(run->limit));
  if (run->step && run->verdict != StabilityVerdict::stable)
    lines.push_back("from step " + readableCount(stepOf(*run)));
  if (!run->value) lines.push_back(mathHtml(shortReason(*run)));
  return {{"text", inWords(run->verdict)},
          {"class", styleOf(run->verdict).cssClass},
          {"lines", std::move(lines)}};
}

/// @param runFor  the run of an engine, or null
Json cellsOf(const StabilityResults& results, const auto& runFor) {
  Json cells = Json::array();
  for (const EngineRow& engine : results.engines) cells.push_back(cellOf(runFor(engine.name)));
  return cells;
}

/// Every verdict of an engine in a case at a glance: "3 of 4 stable".
std::string tallyOf(const StabilityResults& results, const std::string& engine,
                    const HardGroup& group) {
  int stable = 0, judged = 0;
  for (const HardCase* variant : group.variants)
    if (const StabilityRun* run = runOf(results, engine, *variant)) {
      stable += run->verdict == StabilityVerdict::stable;
      judged += isJudged(run->verdict);
    }
  return judged > 1 ? fmt::format("{} of {} stable", stable, judged) : std::string();
}

Json matrixOf(const StabilityResults& results, const std::vector<HardGroup>& groups) {
  Json rows = Json::array();
  for (const HardGroup& group : groups) {
    Json cells = cellsOf(
        results, [&](const std::string& engine) { return worstRun(results, engine, group); });
    for (std::size_t e = 0; e < results.engines.size(); ++e)
      if (const std::string tally = tallyOf(results, results.engines[e].name, group);
          !tally.empty())
        cells[e]["lines"].insert(cells[e]["lines"].begin(), tally);
    rows.push_back({{"id", fmt::format("case_{}", rows.size() + 1)},
                    {"name", spaced(group.name)},
                    {"measure", spaced(group.variants.front()->measure)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

std::string shownUnit(const std::string& unit) {
  return unit == "-" ? "" : unit;
}

std::string limitsOf(const HardCase& variant) {
  if (!std::isfinite(variant.limit)) return "of each run";
  const std::string unit = shownUnit(variant.unit);
  return fmt::format("{}{}{}, degraded up to {}", readableSetting(finite(variant.limit)),
                     unit.empty() ? "" : " ", unit, readableSetting(finite(variant.degradedLimit)));
}

/// Their titles are "ENGINE: CASE" or "ENGINE: CASE, VARIANT".
Json pictureViewsOf(const Illustrations& shown, const std::string& name) {
  Json views = Json::array();
  for (Json& view : pictureViews(shown, Picture::Shows::worst)) {
    const std::string title = view.at("alt").get<std::string>() + ",";
    if (title.find(": " + name + ",") != std::string::npos) views.push_back(std::move(view));
  }
  return views;
}

Json casesOf(const StabilityResults& results, const std::vector<HardGroup>& groups,
             const Illustrations& shown) {
  Json views = Json::array();
  for (const HardGroup& group : groups) {
    const HardCase& first = *group.variants.front();
    Json rows = Json::array();
    for (const HardCase* variant : group.variants)
      rows.push_back(
          {{"name", variant->variant},
           {"otherMeasure", variant->measure == first.measure ? "" : spaced(variant->measure)},
           {"limit", readableSetting(finite(variant->limit))},
           {"degraded", readableSetting(finite(variant->degradedLimit))},
           {"cells", cellsOf(results, [&](const std::string& engine) {
              return runOf(results, engine, *variant);
            })}});
    Json pictures = pictureViewsOf(shown, group.name);
    const std::size_t index = views.size() + 1;
    Json figures = Json::array();
    for (Json& view : figureViews(shown, fmt::format("stability_{}", index)))
      if (view.at("file") == fmt::format("stability_{}", index)) figures.push_back(std::move(view));
    views.push_back(
        {{"id", fmt::format("case_{}", index)},
         {"name", spaced(group.name)},
         {"tests", areTransforms(results) ? "However it is told, the same happens." : first.tests},
         {"measure", spaced(first.measure)},
         {"what", first.what},
         {"unit", shownUnit(first.unit)},
         {"limits", limitsOf(first)},
         {"why", first.why},
         {"file", first.file},
         {"toml", first.toml},
         {"variants", std::move(rows)},
         {"hasPictures", !pictures.empty()},
         {"pictures", std::move(pictures)},
         {"hasFigures", !figures.empty()},
         {"figures", std::move(figures)}});
  }
  return views;
}

void addSummary(Json& view, const StabilityResults& results) {
  using Counts = std::map<std::string_view, int>;  // by the verdicts' names
  std::map<std::string, Counts> counts;
  Counts all;
  for (const StabilityRun& run : results.runs) {
    ++counts[run.engine][nameOf(run.verdict)];
    ++all[nameOf(run.verdict)];
  }
  const int judged = all["stable"] + all["degraded"] + all["unstable"];
  view["lead"] =
      areTransforms(results)
          ? fmt::format("{} of {} cases told otherwise came out the same, but for rounding.",
                        all["stable"], judged)
          : fmt::format("{} of {} runs of hard cases stayed within their limits.", all["stable"],
                        judged);
  view["sentences"] = Json::array();
  for (const EngineRow& engine : results.engines) {
    std::vector<std::string> words;
    for (const auto& [verdict, count] : counts[engine.name])
      words.push_back(fmt::format("{} {}", count, verdict));
    view["sentences"].push_back(fmt::format("{}: {}.", engine.name, fmt::join(words, ", ")));
  }
}

Json engineRows(const std::vector<EngineRow>& engines) {
  const std::vector<LineStyle> styles = engineStyles(engines);
  Json rows = Json::array();
  for (std::size_t e = 0; e < engines.size(); ++e)
    rows.push_back({{"name", engines[e].name},
                    {"colour", styles[e].colour},
                    {"dashed", styles[e].dashed},
                    {"version", engines[e].version},
                    {"summary", engines[e].summary}});
  return rows;
}

Json scoreRows(const StabilityResults& results) {
  Json rows = Json::array();
  for (const StabilityRun& run : results.runs)
    rows.push_back({{"engine", run.engine},
                    {"case", spaced(run.name)},
                    {"variant", run.variant},
                    {"verdict", inWords(run.verdict)},
                    {"class", styleOf(run.verdict).cssClass},
                    {"measure", spaced(run.measure)},
                    {"value", valueOf(run)},
                    {"limit", readableSetting(finite(run.limit))},
                    {"degraded", readableSetting(finite(run.degradedLimit))},
                    {"unit", shownUnit(run.unit)},
                    {"step", run.step ? readableCount(stepOf(run)) : ""},
                    {"reason", shortReason(run)}});
  return rows;
}

}  // namespace

std::string stabilityPage(const StabilityResults& results, const Illustrations& shown) {
  const std::vector<HardGroup> groups = hardGroups(results);
  Json view = commonView(results.head, results.elapsed, {}, shown);
  addSummary(view, results);
  addOverview(view, stabilityOverview(results), results.engines);
  view["engines"] = engineRows(results.engines);
  view["map"] = figureViews(shown, "stability_map");
  view["matrix"] = matrixOf(results, groups);
  view["cases"] = casesOf(results, groups, shown);
  view["scores"] = scoreRows(results);
  view["files"] = "Beside this page: results.json (everything) and stability.csv.";
  return render("report_stability.html", view);
}

}  // namespace crossgrain::reports
