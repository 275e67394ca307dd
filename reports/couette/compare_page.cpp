#include <fmt/format.h>

#include <algorithm>

#include "reports/common/figures.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

const Json& fitOf(const EngineResults& engine, const std::string& name) {
  return findByText(engine.averages(), "fits", "name", name);
}

Json fitCell(const Json& fit) {
  const auto value = number(fit, "value");
  const auto chi2 = number(fit, "chi2_per_dof");
  const auto found = number(fit, "packings"), of = number(fit, "of_packings");
  std::vector<std::string> lines;
  if (value && chi2) lines.push_back("χ²/dof " + readable(chi2));
  if (found && of && *found < *of)
    lines.push_back(fmt::format("{} of {} packings can be fitted", *found, *of));
  if (!value) lines.push_back(text(fit, "reason"));
  std::erase(lines, std::string());
  return {{"value", readable(value, number(fit, "stderr"))}, {"lines", lines}};
}

Json fitRows(const Engines& engines) {
  std::vector<std::string> names;
  for (const EngineResults& engine : engines)
    for (const Json& fit : list(engine.averages(), "fits"))
      if (const std::string name = text(fit, "name"); std::ranges::find(names, name) == names.end())
        names.push_back(name);
  Json rows = Json::array();
  for (const std::string& name : names) {
    Json row = {{"label", mathHtml(name)},
                {"unit", ""},
                {"expected", absentText},
                {"cells", Json::array()}};
    for (const EngineResults& engine : engines) {
      const Json& fit = fitOf(engine, name);
      row["cells"].push_back(fitCell(fit));
      if (!fit.is_object()) continue;
      if (const std::string label = text(fit, "label"); !label.empty())
        row["label"] = mathHtml(label);
      if (const std::string unit = text(fit, "unit"); unit != "-" && unit != "1")
        row["unit"] = unit;
      if (const auto expected = number(fit, "expected"))
        row["expected"] = readableSetting(expected);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Checks of a single number: found, and expected, of each engine's first finished packing.
Json numberCheckRows(const Engines& engines) {
  Json rows = Json::array();
  for (const EngineResults& engine : engines)
    for (const Json& check : list(*engine.finished.front(), "checks")) {
      if (list(check, "value").size() != 1) continue;
      rows.push_back({{"check", mathHtml(text(check, "label"))},
                      {"engine", engine.name},
                      {"found", readable(number(list(check, "value")[0]),
                                         number(element(list(check, "stderr"), 0)))},
                      {"expected", readable(number(element(list(check, "reference"), 0)),
                                            number(check, "reference_stderr"))},
                      {"note", mathHtml(text(check, "note"))}});
    }
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    return text(a, "check") < text(b, "check");
  });
  return rows;
}

std::string instantOf(const Engines& engines) {
  for (const EngineResults& engine : engines)
    for (const Json* run : engine.runs)
      if (const auto rotation = number(member(*run, "picture"), "rotation"))
        return fmt::format("after {:.3g} rotations of the wheel", *rotation);
  return "at one instant";
}

void addPictures(Json& view, const Engines& engines, const Illustrations& shown) {
  view["origins"] = pictureViews(shown, Picture::Shows::origins);
  view["hasPictures"] = !view["origins"].empty();
  view["originsNote"] = fmt::format(
      "Where the disks of the same packing are {}, coloured by where they started: twelve sectors "
      "of angle, paler in every other band of two diameters. What was a straight sector bends "
      "where the cell shears.",
      instantOf(engines));
  view["forces"] = pictureViews(shown, Picture::Shows::forces);
  view["hasForces"] = !view["forces"].empty();
  view["forcesNote"] =
      "The contact forces at the same instant: lines between the centres, width and darkness "
      "proportional to the normal force, each picture on its own scale.";
}

}  // namespace

void addFitsAndNumberChecks(Json& view, const Engines& engines) {
  Engines withData;
  for (const EngineResults& engine : engines)
    if (!engine.finished.empty()) withData.push_back(engine);
  view["numberChecks"] = numberCheckRows(withData);
  view["hasNumberChecks"] = !view["numberChecks"].empty();
  view["fitTable"] = {{"columns", columnsView(withData)}, {"fits", fitRows(withData)}};
  view["hasFits"] = !view["fitTable"]["fits"].empty();
}

void addFigures(Json& view, const Engines& engines, const Illustrations& shown) {
  view["bars"] = barsInWords(engines);
  view["profiles"] = figureViews(shown, "profile_");
  view["checks"] = figureViews(shown, "check_");
  view["hasChecks"] = !view["checks"].empty() || view["hasNumberChecks"] == Json(true);
  view["series"] = figureViews(shown, "series_");
  view["distributions"] = figureViews(shown, "distribution_");
  view["hasDistributions"] = !view["distributions"].empty();
  view["hasSeries"] = !view["series"].empty();
  view["hasSettling"] = std::ranges::any_of(shown.figures, [](const Figure& figure) {
    return figure.name.starts_with("series_") && figure.panels.front().shaded.has_value();
  });
}

std::string comparePage(const Json& results, const Illustrations& shown) {
  const Engines engines = engineResults(results);
  std::vector<RealisedOf> realised;
  for (const EngineResults& engine : engines)
    if (engine.realised().is_object())
      realised.push_back({engine.name, &engine.realised(), &member(results, "effects")});

  Json view = commonView(results, shown);
  addSummary(view, results, engines);
  view["columns"] = columnsView(engines);
  addEngineTable(view, engines);
  addStates(view, results, engines);
  addTroubles(view, engines);
  addAgreement(view, results, engines);
  view["averages"] = averagesInWords(results);
  addFitsAndNumberChecks(view, engines);
  addFigures(view, engines, shown);
  addPictures(view, engines, shown);
  addDetails(view, realised);
  view["packings"] = packingRows(results);
  view["files"] =
      "Beside this page: results.json (everything), profiles.csv, distributions.csv, series.csv, "
      "regimes.csv, steadiness.csv and agreement.csv.";
  return render("report_compare.html", view);
}

}  // namespace crossgrain::reports
