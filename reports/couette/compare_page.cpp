#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/packings.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/figures.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/report.hpp"
#include "reports/couette/state_view.hpp"
#include "reports/lockstep/view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

const FitRow* fitOf(const EngineRuns& engine, const std::string& name) {
  const auto found = std::ranges::find(engine.fits(), name, &FitRow::name);
  return found == engine.fits().end() ? nullptr : &*found;
}

Json fitCell(const FitRow* fit) {
  if (!fit) return {{"value", absentText}, {"lines", Json::array()}};
  const auto value = finite(fit->value), chi2 = finite(fit->chi2PerDof);
  std::vector<std::string> lines;
  if (value && chi2) lines.push_back("χ²/dof " + readable(chi2));
  if (fit->packings && fit->ofPackings && *fit->packings < *fit->ofPackings)
    lines.push_back(
        fmt::format("{} of {} packings can be fitted", *fit->packings, *fit->ofPackings));
  if (!value) lines.push_back(fit->reason);
  std::erase(lines, std::string());
  return {{"value", readable(value, fit->standardError)}, {"lines", lines}};
}

Json fitRows(const Engines& engines) {
  std::vector<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const FitRow& fit : engine.fits())
      if (std::ranges::find(names, fit.name) == names.end()) names.push_back(fit.name);
  Json rows = Json::array();
  for (const std::string& name : names) {
    Json row = {{"label", mathHtml(name)},
                {"unit", ""},
                {"expected", absentText},
                {"cells", Json::array()}};
    for (const EngineRuns& engine : engines) {
      const FitRow* fit = fitOf(engine, name);
      row["cells"].push_back(fitCell(fit));
      if (!fit) continue;
      if (!fit->label.empty()) row["label"] = mathHtml(fit->label);
      if (fit->unit != "-" && fit->unit != "1") row["unit"] = fit->unit;
      if (finite(fit->expected)) row["expected"] = readableSetting(fit->expected);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Checks of a single number: found, and expected, of each engine's first finished packing.
Json numberCheckRows(const Engines& engines) {
  Json rows = Json::array();
  for (const EngineRuns& engine : engines)
    for (const CheckRow& check : engine.finished.front()->checks) {
      if (check.value.size() != 1) continue;
      rows.push_back({{"check", mathHtml(check.label)},
                      {"engine", engine.name},
                      {"found", readable(at(check.value, 0), at(check.standardError, 0))},
                      {"expected", readable(at(check.reference, 0), check.referenceError)},
                      {"note", mathHtml(check.note.value_or(""))}});
    }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Json& a, const Json& b) { return a.at("check") < b.at("check"); });
  return rows;
}

std::string instantOf(const CompareResults& results, const Engines& engines) {
  for (const EngineRuns& engine : engines)
    for (const CouetteRun* run : engine.runs)
      if (run->picture && results.region)
        return fmt::format("after {:.3g} s", run->picture->time);
      else if (run->picture && std::isfinite(run->picture->rotation))
        return fmt::format("after {:.3g} rotations of the wheel", run->picture->rotation);
  return "at one instant";
}

/// Engines that have a picture of that kind, in the page's order.
std::vector<std::string> enginesIn(const Illustrations& shown, Picture::Shows shows) {
  std::vector<std::string> names;
  for (const Picture& picture : shown.pictures)
    if (picture.shows == shows) names.push_back(picture.engine);
  return names;
}

std::string forcesNote(const Illustrations& shown) {
  const auto names = enginesIn(shown, Picture::Shows::forces);
  if (names.empty()) return {};
  return fmt::format(
      "The contact forces at the same instant: lines between the centres, width and darkness "
      "proportional to the normal force, all pictures on one scale: the widest line is the force "
      "that 99 % of {}'s contacts lie below.",
      names.front());
}

void addPictures(Json& view, const CompareResults& results, const Engines& engines,
                 const Illustrations& shown) {
  view["origins"] = pictureViews(shown, Picture::Shows::origins);
  view["hasPictures"] = !view["origins"].empty();
  view["originsNote"] = fmt::format(
      "Where the disks of the same packing are {}, coloured by where they started: twelve sectors "
      "of angle{}, paler in every other band of two diameters.{}",
      instantOf(results, engines), results.region ? " about the origin" : "",
      results.region ? "" : " What was a straight sector bends where the cell shears.");
  view["forces"] = pictureViews(shown, Picture::Shows::forces);
  view["hasForces"] = !view["forces"].empty();
  view["forcesNote"] = forcesNote(shown);
}

}  // namespace

void addFitsAndNumberChecks(Json& view, const Engines& engines) {
  Engines withData;
  for (const EngineRuns& engine : engines)
    if (!engine.finished.empty()) withData.push_back(engine);
  view["numberChecks"] = numberCheckRows(withData);
  view["hasNumberChecks"] = !view["numberChecks"].empty();
  view["fitTable"] = {{"columns", columnsView(withData)}, {"fits", fitRows(withData)}};
  view["hasFits"] = !view["fitTable"]["fits"].empty();
}

void addFigures(Json& view, const Engines& engines, const Illustrations& shown) {
  view["bars"] = barsInWords(engines);
  view["profiles"] = figureViews(shown, "profile_");
  view["differences"] = figureViews(shown, "difference_");
  view["hasDifferences"] = !view["differences"].empty();
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

std::string comparePage(const CompareResults& results, const Illustrations& shown) {
  const Engines engines = engineRuns(results);
  Json view = studyView(results, shown);
  addSummary(view, results, engines);
  addOverview(view, compareOverview(results), results.engines);
  view["hasLockstep"] = results.lockstep.has_value();
  if (results.lockstep) addLockstep(view, *results.lockstep);
  view["columns"] = columnsView(engines);
  addEngineTable(view, engines);
  addStates(view, results, engines);
  addTroubles(view, engines);
  addAgreement(view, results, engines);
  view["averages"] = averagesInWords(results);
  addFitsAndNumberChecks(view, engines);
  addFigures(view, engines, shown);
  addPictures(view, results, engines, shown);
  addDetails(view, realisedOf(results, engines));
  view["packings"] = packingRows(results.packings);
  view["files"] = fmt::format(
      "Beside this page: results.json (everything), profiles.csv, distributions.csv, series.csv, "
      "regimes.csv, steadiness.csv, endpoints.csv and agreement.csv ({0} by {0}).",
      binWord(results));
  return render("report_compare.html", view);
}

}  // namespace crossgrain::reports
