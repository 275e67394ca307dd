#include "reports/cost/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

using Points = std::vector<CostPoint>;

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

std::string kindText(CostKind kind) {
  return kind == CostKind::collision ? "collisions" : toString(kind);
}

/// A fraction as people write it: 3.2 %, 0.0041 %, 2.1×10⁻⁷.
std::string percentText(std::optional<double> fraction) {
  if (!fraction) return absentText;
  if (*fraction == 0.0) return "0";
  constexpr double least = 1e-5;  // as a percentage
  if (*fraction < least) return readableSetting(std::stod(fmt::format("{:.1e}", *fraction)));
  const double percent = 100.0 * *fraction;
  return (percent < 99.5 ? fmt::format("{:.2g}", percent) : readable(percent)) + " %";
}

/// An accuracy that is wanted: 10 %, 0.1 %, 10⁻⁶.
std::string targetText(double target) {
  if (target >= 1e-4) return fmt::format("{:g} %", 100.0 * target);
  const std::string power = readableSetting(target);
  return power.starts_with("1×") ? power.substr(std::string("1×").size()) : power;
}

/// "3.2 % (1.4 % to 5.1 %)"
std::string intervalText(double value, double low, double high) {
  const std::string from = percentText(low), to = percentText(high);
  return from == to ? percentText(value)
                    : fmt::format("{} ({} to {})", percentText(value), from, to);
}

/// A point's error with what it lies between, or why it has none.
[[maybe_unused]] std::string errorText(const CostPoint& point) {
  if (point.status == CostStatus::notMeasured) return "not measured";
  if (!point.ran()) return std::string(nameOf(point.status));
  if (!point.error) return absentText;
  if (point.saysNothing())
    return percentText(point.error) + ", of one packing: no statistical error";
  return intervalText(*point.error, point.low(), point.high());
}

std::vector<double> targetsOf(const auto& rows) {
  std::vector<double> targets;
  for (const auto& row : rows) addOnce(targets, row.target);
  std::ranges::sort(targets, std::ranges::greater());
  return targets;
}

const CostPoint* pointAt(const CostResults& results, std::optional<std::size_t> place) {
  return place && *place < results.points.size() ? &results.points[*place] : nullptr;
}

const CostModel* modelOf(const CostResults& results, const CostCell& cell) {
  return cell.model && *cell.model < results.models.size() ? &results.models[*cell.model] : nullptr;
}

const CostCell* cellAt(const CostResults& results, const std::string& engine, CostKind kind,
                       CostBasis basis, double target) {
  for (const CostCell& cell : results.cells)
    if (cell.engine == engine && cell.kind == kind && cell.basis == basis && cell.target == target)
      return &cell;
  return nullptr;
}

/// The engine that reaches a target of the case's law for the least time; null: none does.
const CostCell* cheapestOf(const CostResults& results, CostKind kind, double target) {
  const CostCell* cheapest = nullptr;
  for (const CostCell& cell : results.cells)
    if (cell.kind == kind && cell.basis == CostBasis::scene && cell.target == target &&
        cell.verdict == CostVerdict::reached && cell.wallSeconds &&
        (!cheapest || *cell.wallSeconds < *cheapest->wallSeconds))
      cheapest = &cell;
  return cheapest;
}

/// Engines that have points, in the order of the results.
std::vector<std::string> enginesIn(const CostResults& results) {
  std::vector<std::string> engines;
  for (const EngineRow& engine : results.engines)
    if (std::ranges::find(results.points, engine.name, &CostPoint::engine) != results.points.end())
      engines.push_back(engine.name);
  return engines;
}

/// "Which setting … is decided for 31 of 36 against …"
std::string decidedText(const CostResults& results) {
  std::vector<std::string> parts;
  for (const CostBasis basis : costBases) {
    std::size_t all = 0, decided = 0;
    for (const CostCell& cell : results.cells)
      if (cell.basis == basis) ++all, decided += cell.decided();
    if (all > 0)
      parts.push_back(fmt::format(
          "{} of {} against {}", decided, all,
          basis == CostBasis::own ? "engines' own limits of small steps" : "the case's law"));
  }
  if (parts.empty()) return "Nothing was measured.";
  return fmt::format("Which setting reaches an accuracy for the least time is decided for {}.",
                     fmt::join(parts, " and "));
}

}  // namespace

std::string settingText(const std::string& knob, const std::string& setting) {
  const bool speaks = speaksForItself(knob) || knob.starts_with("effect:");
  std::string text = speaks || setting.starts_with(knob) ? setting : knob + " " + setting;
  const auto isLetter = [&](std::size_t k) {
    return k < text.size() && std::isalpha(static_cast<unsigned char>(text[k])) != 0;
  };
  for (std::size_t k = 2; k < text.size(); ++k)  // "t_c" keeps its mark
    if (text[k] == '_' && isLetter(k - 1) && isLetter(k - 2)) text[k] = ' ';
  return text;
}

std::string measureText(const std::string& measure) {
  constexpr std::string_view positions = "position_rms_";
  const std::string scene = withoutOwn(measure);
  if (scene != measure) return measureText(scene) + ", own limit";
  if (measure == "psi_f") return "Ψ_f";
  if (measure == "e_n") return measure;
  if (!measure.starts_with(positions)) return fieldWords(measure);
  const std::string whom = measure.substr(positions.size());
  return "positions, compared with " + (whom == "own" ? "itself" : whom);
}

std::string timeUnit(CostKind kind) {
  constexpr std::array units = {"one sweep of collisions", "the window", "one rotation"};
  return units[static_cast<std::size_t>(kind)];
}

std::vector<CostKind> kindsIn(const Points& points) {
  std::vector<CostKind> kinds;
  for (const CostPoint& point : points) addOnce(kinds, point.kind);
  return kinds;
}

std::vector<CostMeasure> measuresDrawn(const Points& points) {
  std::vector<CostMeasure> measures;
  for (const CostPoint& point : points)
    if (point.kind != CostKind::averages || !isOwn(point.measure))
      addOnce(measures, CostMeasure{point.kind, point.measure});
  return measures;
}

std::vector<OtherSetting> otherSettings(const Points& points) {
  std::vector<OtherSetting> settings;
  for (const CostPoint& point : points)
    if (point.counted() && !schemeOf(point.knob, point.setting))
      addOnce(settings, OtherSetting{point.knob, point.setting});
  return settings;
}

std::string costCsv(const CostResults& results) {
  std::string table =
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason,"
      "knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,"
      "low,high,equivalent,bound\n";
  std::vector<bool> onFront(results.points.size(), false);
  for (const Front& front : results.fronts)
    for (const std::size_t place : front.points)
      if (front.engine.empty() && place < onFront.size()) onFront[place] = true;
  for (std::size_t k = 0; k < results.points.size(); ++k) {
    const CostPoint& point = results.points[k];
    table += row(point.engine, point.setting, point.dt, point.error, toString(point.kind),
                 point.wallSeconds, point.cpuSeconds, point.steps, point.contactEvaluations,
                 std::string(nameOf(point.status)), point.reason, point.knob, point.measure,
                 point.statistical, point.systematic, point.referenceError, point.stepsPerContact,
                 !point.ran() ? ""
                 : onFront[k] ? "yes"
                              : "no",
                 point.intervalLow, point.intervalHigh, "", "");
  }
  return table;
}

std::string costText(const CostResults& results) {
  return fmt::format("{}\n{} ran, {} failed, {} refused, {} not measured\n", decidedText(results),
                     results.count(CostStatus::ran), results.count(CostStatus::failed),
                     results.count(CostStatus::refused), results.count(CostStatus::notMeasured));
}

namespace {

OverviewCell overviewCell(const CostResults& results, const CostCell* cost) {
  OverviewCell cell{CellState::notMeasured, {}, "s", {}, {}, "accuracy"};
  if (!cost || cost->verdict == CostVerdict::notMeasured) return cell;
  if (cost->verdict == CostVerdict::reached) {
    cell.state = CellState::good;
    cell.value = cost->wallSeconds;
    cell.shown = shortDuration(cost->wallSeconds);
    cell.words = settingText(cost->knob, cost->setting);
    return cell;
  }
  cell.state = cost->verdict == CostVerdict::undecided ? CellState::undecided : CellState::bad;
  cell.unit = "%";
  const CostPoint* point = pointAt(results, cost->point);
  const auto show = [&](double error, const std::string& measure) {
    cell.value = 100.0 * error;
    cell.shown = percentText(error) + " off";
    cell.words = measureText(withoutOwn(measure));
  };
  if (const CostModel* model = modelOf(results, *cost)) {
    cell.state = CellState::modelDifference;
    show(model->error, model->measure);
  } else if (point && point->counted()) {
    show(*point->counted(), point->measure);
  }
  const CostCell* own = cellAt(results, cost->engine, cost->kind, CostBasis::own, cost->target);
  if (!own || own->verdict != CostVerdict::reached) return cell;
  cell.words += fmt::format("{}its own law: {}", cell.words.empty() ? "" : "; ",
                            settingText(own->knob, own->setting));
  if (own->wallSeconds) cell.words += ", " + shortDuration(own->wallSeconds);
  return cell;
}

/// In each kind of error the finest accuracy that anyone reaches, and who does for the least time.
std::string finestReached(const CostResults& results) {
  std::vector<std::string> parts;
  for (const CostKind kind : kindsIn(results.points)) {
    const CostCell* finest = nullptr;
    for (const double target : targetsOf(results.cells))
      if (const CostCell* cell = cheapestOf(results, kind, target)) finest = cell;
    parts.push_back(finest ? fmt::format("{} {} by {} with {} ({} for {})", kindText(kind),
                                         targetText(finest->target), finest->engine,
                                         settingText(finest->knob, finest->setting),
                                         shortDuration(finest->wallSeconds), timeUnit(kind))
                           : fmt::format("{} by no engine as far as measured", kindText(kind)));
  }
  if (parts.empty()) return "Nothing was measured.";
  return fmt::format("Finest accuracy of the case's law that is reached, for the least time: {}.",
                     listed(parts));
}

/// Whose law is off the case's by more than an accuracy that is wanted, in what, by how much.
std::string modelDifferences(const CostResults& results) {
  std::vector<std::string> parts;
  for (const std::string& engine : enginesIn(results)) {
    const CostModel* worst = nullptr;
    for (const CostCell& cell : results.cells)
      if (const CostModel* one = modelOf(results, cell);
          one && cell.engine == engine && (!worst || one->error > worst->error))
        worst = one;
    if (worst)
      parts.push_back(fmt::format("{} by {} in {}", engine, percentText(worst->error),
                                  measureText(withoutOwn(worst->measure))));
  }
  if (parts.empty()) return {};
  return fmt::format("No time step removes a model difference: {}.", listedShortly(parts, 3));
}

std::string nextStep(const CostResults& results) {
  const std::size_t left = results.count(CostStatus::notMeasured);
  if (left > 0 && results.budgetForTheRest)
    return fmt::format(
        "Next: the same command with --budget {:.0f}s measures the {} that did not fit into the "
        "budget.",
        std::ceil(*results.budgetForTheRest / 10.0) * 10.0, counted(left, "point"));
  if (std::ranges::any_of(results.cells, [](const CostCell& cell) {
        return cell.basis == CostBasis::scene && cell.verdict == CostVerdict::undecided;
      }))
    return "Next: what is undecided takes more packings or longer runs; the table below says "
           "which.";
  if (left > 0) return fmt::format("{} were not measured.", counted(left, "point"));
  return "Next: take the fragment of the setting that you need from the end of this page.";
}

}  // namespace

Overview costOverview(const CostResults& results) {
  Overview overview;
  const std::vector<CostKind> kinds = kindsIn(results.points);
  const std::vector<double> targets = targetsOf(results.cells);
  for (const CostKind kind : kinds)
    for (const double target : targets) {
      std::string shown = targetText(target);  // a number and its unit stay in one line
      if (const std::size_t at = shown.find(' '); at != std::string::npos)
        shown.replace(at, 1, "\u00a0");
      overview.columns.push_back(
          {fmt::format("{} {}", kindText(kind), shown),
           fmt::format("Which setting brings the error of {} below {} for the least time? Time of "
                       "{}.",
                       kindText(kind), targetText(target), timeUnit(kind)),
           "kind-" + toString(kind)});
    }
  for (const std::string& engine : enginesIn(results)) {
    OverviewRow row{engine, true, {}};
    for (const CostKind kind : kinds)
      for (const double target : targets)
        row.cells.push_back(
            overviewCell(results, cellAt(results, engine, kind, CostBasis::scene, target)));
    overview.rows.push_back(std::move(row));
  }
  for (std::string& sentence :
       std::vector{finestReached(results), modelDifferences(results), nextStep(results)})
    if (!sentence.empty()) overview.conclusion.push_back(std::move(sentence));
  return overview;
}

std::string costPage(const CostResults& results, const Illustrations& shown) {
  nlohmann::json view = commonView(results.head, results.elapsed, results.notes, shown);
  view["lead"] = decidedText(results);
  view["sentences"] = nlohmann::json::array();
  addOverview(view, costOverview(results), results.engines);
  view["figures"] = figureViews(shown, "cost_");
  view["files"] = "Beside this page: results.json (everything) and cost.csv (every point).";
  return render("report_cost.html", view);
}

}  // namespace crossgrain::reports
