#include "reports/cost/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {

namespace {

std::string kindText(CostKind kind) {
  return kind == CostKind::collision ? "collisions" : toString(kind);
}

/// A fraction as people write it: 3.2 %, 0.0041 %, 2.1×10⁻⁷.
std::string percentText(std::optional<double> fraction) {
  if (!fraction) return absentText;
  if (*fraction == 0.0) return "0";
  constexpr double least = 1e-5;  // as a percentage
  if (*fraction < least)
    return readableSetting(std::strtod(fmt::format("{:.1e}", *fraction).c_str(), nullptr));
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
std::string errorText(const CostPoint& point) {
  if (point.status == Status::notRun) return "not measured";
  if (!point.ran()) return std::string(nameOf(point.status, costStatusNames));
  if (!point.error) return absentText;
  if (point.saysNothing())
    return percentText(point.error) + ", of one packing: no statistical error";
  return intervalText(*point.error, point.low(), point.high()) +
         (point.worst ? fmt::format(", worst {}", percentText(point.worst)) : "");
}

/// Falling, each once.
std::vector<double> targetsOf(const std::vector<CostCell>& cells) {
  std::set<double, std::greater<>> targets;
  for (const CostCell& cell : cells) targets.insert(cell.target);
  return {targets.begin(), targets.end()};
}

const CostPoint* pointAt(const CostResults& results, std::optional<std::size_t> place) {
  return place && *place < results.points.size() ? &results.points[*place] : nullptr;
}

/// Of a cell, or of advice.
const CostModel* modelOf(const CostResults& results, const auto& of) {
  return of.model && *of.model < results.models.size() ? &results.models[*of.model] : nullptr;
}

/// "ψ_f: its limit of small steps is off by 25 % (24 % to 26 %)"
std::string modelText(const CostModel& model) {
  return fmt::format("{}: its limit of small steps is off by {}", measureText(model.measure),
                     intervalText(model.error, model.low, model.high));
}

/// "a tie with t_c/200, skin = 0.001": settings of which it is not known whether they take less.
std::string tieText(const std::vector<TiedSetting>& ties) {
  std::vector<std::string> names;
  for (const TiedSetting& one : ties) names.push_back(settingText(one.knob, one.setting));
  return names.empty() ? "" : fmt::format("a tie with {}", fmt::join(names, ", "));
}

/// "the cheapest engine", or that it ties with others.
std::string cheapestText(const CostResults& results, const Advice& advice) {
  if (!advice.cheapest) return "";
  std::vector<std::string> others;
  for (const Advice& one : results.advice)
    if (one.cheapest && one.target == advice.target && one.engine != advice.engine)
      others.push_back(one.engine);
  return others.empty()
             ? "the cheapest engine"
             : fmt::format("the cheapest engine, a tie with {}", fmt::join(others, ", "));
}

const CostCell* cellAt(const CostResults& results, const std::string& engine, CostKind kind,
                       CostBasis basis, double target) {
  for (const CostCell& cell : results.cells)
    if (cell.engine == engine && cell.kind == kind && cell.basis == basis && cell.target == target)
      return &cell;
  return nullptr;
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

/// What became of the points.
std::string countsText(const CostResults& results) {
  return fmt::format("{} ran, {} failed, {} refused, {} not measured",
                     results.count(Status::finished), results.count(Status::failed),
                     results.count(Status::refused), results.count(Status::notRun));
}

std::string asToml(const Advice& one, const CostResults& results) {
  std::string text = fmt::format("# {}, wanted {:g} %: {}", one.engine, 100.0 * one.target,
                                 nameOf(one.verdict, costVerdictNames));
  const bool reached = one.verdict == Verdict::pass;
  if (!one.setting.empty()) {
    std::vector<std::string_view> kinds;
    for (const CostKind kind : one.kinds) kinds.push_back(nameOf(kind));
    text += reached                               ? " by "
            : one.verdict == Verdict::notMeasured ? " far enough; the best so far is "
                                                  : "; the best is ";
    text += speaksForItself(one.knob) ? one.setting : one.knob + " " + one.setting;
    if (const auto time = one.time())
      text += fmt::format(
          ", {:.3g} s of {} per {}", *time, one.cpuSeconds ? "processor time" : "wall time",
          one.costKind() == CostKind::averages ? results.region ? "second of the scene" : "rotation"
                                               : "sweep of collisions");
    text += fmt::format(" (measured in {})", fmt::join(kinds, " and "));
    for (const std::string& more : {tieText(one.ties), cheapestText(results, one)})
      if (!more.empty()) text += "; " + more;
  }
  text += "\n";
  const CostModel* model = modelOf(results, one);
  if (model) text += fmt::format("# {}, {}\n", toString(model->kind), modelText(*model));
  if (const CostPoint* point = pointAt(results, one.obstacle); point && !model)
    text += fmt::format("# {}, {}: {:.2g} to {:.2g} of its scale{}\n", toString(point->kind),
                        point->measure, point->low(), point->high(),
                        reached ? ", which does not decide" : "");
  if (!one.decides.empty()) text += "# what would decide: " + one.decides + "\n";
  if (!reached) return text;
  text += one.fragment.empty() ? "# the case as it is: nothing to change\n" : one.fragment;
  return text.ends_with('\n') ? text : text + "\n";
}

/// Whether a point errs no less than another one, in a time that cannot be distinguished from its
/// own.
bool tiesWithABetter(const CostResults& results, std::size_t place, std::size_t other) {
  const CostPoint* one = pointAt(results, place);
  const CostPoint* better = pointAt(results, other);
  return one && better && one->counted() && better->counted() &&
         *better->counted() <= *one->counted() && better->timeInterval().ties(one->timeInterval());
}

}  // namespace

std::string costCsv(const CostResults& results) {
  std::string table =
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason,"
      "knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,low,high,"
      "equivalent,bound,worst,time_low_s,time_high_s,tied\n";
  std::vector<bool> onFront(results.points.size(), false), tied = onFront;
  for (const Front& front : results.fronts)
    for (const std::size_t place : front.points) {
      if (!front.engine.empty() || place >= onFront.size()) continue;
      onFront[place] = true;
      tied[place] = std::ranges::any_of(front.points, [&](std::size_t other) {
        return other != place && tiesWithABetter(results, place, other);
      });
    }
  for (std::size_t k = 0; k < results.points.size(); ++k) {
    const CostPoint& point = results.points[k];
    table += row(
        point.engine, point.setting, point.dt, point.error, toString(point.kind), point.wallSeconds,
        point.cpuSeconds, point.steps, point.contactEvaluations,
        std::string(nameOf(point.status, costStatusNames)), point.reason, point.knob, point.measure,
        point.statistical, point.systematic, point.referenceError, point.stepsPerContact,
        !point.ran() ? ""
        : onFront[k] ? "yes"
                     : "no",
        point.intervalLow, point.intervalHigh, "", "", point.worst, point.timeLow, point.timeHigh,
        !onFront[k] ? ""
        : tied[k]   ? "yes"
                    : "no");
  }
  return table;
}

std::string costText(const CostResults& results) {
  return decidedText(results) + "\n" + countsText(results) + "\n";
}

std::string costToml(const CostResults& results) {
  std::string text;
  for (const Advice& one : results.advice)
    if (one.target == results.target) text += (text.empty() ? "" : "\n") + asToml(one, results);
  return text;
}

namespace {

OverviewCell overviewCell(const CostResults& results, const CostCell* cost) {
  OverviewCell cell{Verdict::notMeasured, {}, "s", {}, {}, "accuracy"};
  if (!cost || cost->verdict == Verdict::notMeasured) return cell;
  cell.verdict = cost->verdict;
  if (cost->verdict == Verdict::pass) {
    cell.value = cost->time();
    cell.shown = shortDuration(cost->time());
    cell.words = settingText(cost->knob, cost->setting);
    if (!cost->ties.empty()) cell.words += ", " + tieText(cost->ties);
    return cell;
  }
  cell.unit = "%";
  const CostPoint* point = pointAt(results, cost->point);
  const auto show = [&](double error, const std::string& measure) {
    cell.value = 100.0 * error;
    cell.shown = percentText(error) + " off";
    cell.words = measureText(withoutOwn(measure));
  };
  if (const CostModel* model = modelOf(results, *cost)) {
    cell.verdict = Verdict::modelDifference;
    show(model->error, model->measure);
  } else if (point && point->counted()) {
    show(*point->counted(), point->measure);
  }
  const CostCell* own = cellAt(results, cost->engine, cost->kind, CostBasis::own, cost->target);
  if (!own || own->verdict != Verdict::pass) return cell;
  cell.words += fmt::format("{}its own law: {}", cell.words.empty() ? "" : "; ",
                            settingText(own->knob, own->setting));
  if (own->time()) cell.words += ", " + shortDuration(own->time());
  return cell;
}

/// In each kind of error the finest accuracy that anyone reaches, and who does for the least time,
/// with those that tie.
std::string finestReached(const CostResults& results) {
  std::vector<std::string> parts;
  for (const CostKind kind : kindsIn(results.points)) {
    const CostCell* finest = nullptr;
    const auto counts = [&](const CostCell& cell) {
      return cell.kind == kind && cell.basis == CostBasis::scene && cell.time() &&
             cell.verdict == Verdict::pass;
    };
    const auto rank = [](const CostCell& cell) { return std::pair(cell.target, *cell.time()); };
    for (const CostCell& cell : results.cells)
      if (counts(cell) && (!finest || rank(cell) < rank(*finest))) finest = &cell;
    if (!finest) {
      parts.push_back(fmt::format("{} by no engine as far as measured", kindText(kind)));
      continue;
    }
    std::vector<std::string> ties;
    for (const CostCell& cell : results.cells)
      if (counts(cell) && cell.target == finest->target && cell.engine != finest->engine &&
          cell.timeInterval().ties(finest->timeInterval()))
        ties.push_back(cell.engine);
    parts.push_back(fmt::format(
        "{} {} by {} with {} ({} for {}{})", kindText(kind), targetText(finest->target),
        finest->engine, settingText(finest->knob, finest->setting), shortDuration(finest->time()),
        timeUnit(results, kind), ties.empty() ? "" : fmt::format("; a tie with {}", listed(ties))));
  }
  if (parts.empty()) return "Nothing was measured.";
  return fmt::format("Finest accuracy of the case's law that is reached, for the least time: {}.",
                     listed(parts));
}

std::string nextStep(const CostResults& results) {
  if (const std::size_t left = results.count(Status::notRun))
    return fmt::format(
        "Next: the same command with --budget {:.0f}s measures the {} that did not fit into the "
        "budget.",
        std::ceil(results.budgetForTheRest.value_or(0.0) / 10.0) * 10.0, counted(left, "point"));
  return "Next: take the setting that you need from the end of this page.";
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
           fmt::format(
               "Which setting brings the error of {} below {} for the least time? Time of {}.",
               kindText(kind), targetText(target), timeUnit(results, kind)),
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
  overview.conclusion = {finestReached(results), nextStep(results)};
  return overview;
}

namespace {

/// The setting that reaches an accuracy, or the verdict with the best setting below it.
Cell verdictCell(const auto& of, std::string remark = {}) {
  const std::string setting = settingText(of.knob, of.setting);
  const bool reached = of.verdict == Verdict::pass;
  return {reached ? setting : std::string(nameOf(of.verdict, costVerdictNames)),
          {reached || setting.empty() ? "" : "best: " + setting, std::move(remark)},
          of.verdict,
          true};
}

std::string decidesText(const std::string& decides) {
  return decides.empty() ? "" : "would decide: " + decides;
}

/// "1.2 ms (1.1 ms to 1.3 ms)"
std::string timeText(const CostTime& time) {
  if (!time.time() || !time.timeLow || !time.timeHigh) return readableDuration(time.time());
  return fmt::format("{} ({} to {})", readableDuration(time.time()), readableDuration(time.timeLow),
                     readableDuration(time.timeHigh));
}

/// Per kind of error, basis, engine and target: the setting that reaches it for the least time.
Table accuracyTable(const CostResults& results) {
  Table table{{{"engine", Column::Kind::engines},
               "accuracy",
               "setting",
               {"time", Column::Kind::number},
               {"error", Column::Kind::remark}},
              {}};
  for (const CostKind kind : kindsIn(results.points))
    for (const CostBasis basis : costBases) {
      std::string group =
          fmt::format("{}, compared with {}; time of {}", kindText(kind),
                      basis == CostBasis::own ? "the engine's own limit" : "the case's law",
                      timeUnit(results, kind));
      for (const CostCell& cell : results.cells) {
        if (cell.kind != kind || cell.basis != basis) continue;
        const CostModel* model = modelOf(results, cell);
        const CostPoint* point = pointAt(results, cell.point);
        std::string error;
        if (model)
          error = modelText(*model);
        else if (point)
          error = fmt::format("{}: {}", measureText(withoutOwn(point->measure)), errorText(*point));
        table.rows.push_back(
            {{cell.engine, targetText(cell.target), verdictCell(cell, tieText(cell.ties)),
              timeText(cell), Cell(error, {decidesText(cell.decides)})},
             std::exchange(group, {})});
      }
    }
  table.note =
      "In all measures of a kind of error, with the measure that decides and the interval of its "
      "error. Its own limit: the engine's small steps, or the oracle of the law that it declares; "
      "what is left is discretisation. The case's law: the model difference is included. Reached: "
      "the upper end of the interval is below. Not reached: every setting tried is shown to lie "
      "above, or the engine's limit of small steps does. A setting whose step makes up for an "
      "error of the model counts with both. Undecided: the interval holds the accuracy. Time: of "
      "the processor, with its 95 % interval; settings whose intervals overlap are a tie. Only "
      "measured settings: nothing is interpolated.";
  return table;
}

/// Per engine and target the recommended setting, with its fragment to paste.
Blocks adviceBlocks(const CostResults& results) {
  Table table{{{"engine", Column::Kind::engines},
               "accuracy",
               "setting",
               {"time", Column::Kind::number},
               {"averages", Column::Kind::remark}},
              {}};
  Blocks fragments;
  for (const Advice& one : results.advice) {
    const CostPoint* obstacle = pointAt(results, one.obstacle);
    std::string time = absentText;
    if (one.time() && one.costKind())
      time = fmt::format("{} for {}", timeText(one), timeUnit(results, *one.costKind()));
    const CostModel* model = modelOf(results, one);
    std::string remark = tieText(one.ties);
    if (const std::string cheapest = cheapestText(results, one); !cheapest.empty())
      remark += (remark.empty() ? "" : "; ") + cheapest;
    Cell rest(model      ? modelText(*model)
              : obstacle ? fmt::format("{}, {}: {}", toString(obstacle->kind),
                                       measureText(obstacle->measure), errorText(*obstacle))
                         : "",
              {decidesText(one.decides)});
    table.rows.push_back(
        {{one.engine, targetText(one.target), verdictCell(one, remark), time, rest}});
    if (one.verdict != Verdict::pass) continue;
    fragments.push_back(Heading{fmt::format("{} for {}: {}", one.engine, targetText(one.target),
                                            settingText(one.knob, one.setting))});
    fragments.push_back(Code{one.fragment.empty() ? "# the case as it is" : one.fragment});
  }
  table.note =
      "The cheapest setting that collisions show to reach the accuracy of the case's law and that "
      "averages do not contradict; the last column has what stands in the way, or an average whose "
      "scatter cannot decide.";
  if (fragments.empty()) fragments = {Paragraph{"No engine is shown to reach any accuracy."}};
  fragments.insert(fragments.begin(), std::move(table));
  return fragments;
}

/// Settings other than time steps: their time and errors.
Table settingTable(const CostResults& results) {
  Table table{{{"number", Column::Kind::number},
               {"engine", Column::Kind::engines},
               "setting",
               "error of",
               {"time", Column::Kind::number},
               {"error", Column::Kind::remark}},
              {}};
  const auto settings = otherSettings(results.points);
  for (const CostPoint& point : results.points) {
    const auto place = std::ranges::find(settings, OtherSetting{point.knob, point.setting});
    if (place == settings.end()) continue;
    table.rows.push_back({{fmt::to_string(place - settings.begin() + 1), point.engine,
                           settingText(point.knob, point.setting),
                           toString(point.kind) + ", " + measureText(point.measure),
                           timeText(point), errorText(point)}});
  }
  table.note = "The number is that in the plots.";
  return table;
}

/// What failed, was refused or did not fit, alike reasons together.
Table notRunTable(const CostResults& results) {
  Table table{{{"engine", Column::Kind::engines},
               "error",
               "setting",
               "status",
               {"reason", Column::Kind::remark},
               "measures"},
              {}};
  const CostPoint* last = nullptr;
  const auto key = [](const CostPoint& point) {
    return std::tie(point.engine, point.kind, point.knob, point.setting, point.status,
                    point.reason);
  };
  for (const CostPoint& point : results.points) {
    if (point.ran()) continue;
    if (last && key(*last) == key(point)) {
      table.rows.back().cells.back().text += "; " + measureText(point.measure);
      continue;
    }
    last = &point;
    table.rows.push_back(
        {{point.engine, toString(point.kind), settingText(point.knob, point.setting),
          errorText(point), point.reason, measureText(point.measure)}});
  }
  return table;
}

Table referenceTable(const CostResults& results) {
  Table table{{"error", "reference", "setting", {"its own error", Column::Kind::number}, "note"},
              {}};
  for (const CostReference& reference : results.references)
    table.rows.push_back({{toString(reference.kind), reference.engine, reference.setting,
                           percentText(reference.error), reference.note}});
  for (const Startup& startup : results.startup)
    table.rows.push_back(
        {{"start-up", startup.engine, "", "",
          fmt::format("started in {}, loaded the scene in {}, which is no part of any other time",
                      readableDuration(startup.start), readableDuration(startup.load))}});
  return table;
}

/// What became of the points, and which engines refused.
std::vector<std::string> costSentences(const CostResults& results) {
  std::string counts = fmt::format("{} points: {}", results.points.size(), countsText(results));
  if (results.count(Status::notRun) > 0 && results.budgetForTheRest)
    counts += fmt::format(
        ", for they did not fit into the budget of {}; they would with --resume and a budget of "
        "about {}",
        readableDuration(results.budget),
        readableDuration(std::ceil(*results.budgetForTheRest / 10.0) * 10.0));
  std::vector<std::string> sentences = {decidedText(results), counts + "."};
  for (const EngineRow& engine : results.engines)
    if (engine.status == Status::refused)
      sentences.push_back(fmt::format("{} refused the scene: {}", engine.name, engine.reason));
  return sentences;
}

std::string whatErrorsAre(const CostResults& results, CostKind kind) {
  if (kind == CostKind::collision)
    return "Two bodies collide, or one and a wall, over a whole curve of Ψ_i, beginning anywhere "
           "in "
           "a step; the error is the root mean square distance from the oracle, in units of the "
           "range of its curve, of the pair and of the step up to a tenth shorter for which it is "
           "largest. Worst: of a single collision.";
  if (kind == CostKind::trajectory)
    return "Packings over a time short against their chaos; the error is the root mean square "
           "distance of the bodies, in diameters, from a run at a much smaller step, mean over "
           "packings.";
  if (results.region)
    return "The case's endpoints, against a reference on the same packings: the mean paired "
           "difference, in units of the reference's size or, of an endpoint with an absolute "
           "margin, of ten margins.";
  return "Profiles and fitted numbers of a sheared cell, against a reference on the same packings: "
         "the mean paired difference, in units of the profile's largest value.";
}

}  // namespace

Report reportOf(const CostResults& results) {
  Report report{{results.head, results.engines, costOverview(results)}};
  report.elapsed = results.elapsed;
  report.notes = costSentences(results);
  std::ranges::copy(results.notes, std::back_inserter(report.notes));
  report.figures = costFigures(results);
  report.tables = {{"cost.csv", costCsv(results)}};
  report.section("accuracy", "Which setting reaches an accuracy for the least time").blocks = {
      accuracyTable(results)};
  for (const CostKind kind : kindsIn(results.points))
    report.section("kind-" + toString(kind), "Error against time: " + kindText(kind)).blocks = {
        Paragraph{whatErrorsAre(results, kind)},
        drawingsOf(report.figures, "cost_" + toString(kind))};
  const auto addTable = [&](const std::string& id, const std::string& title, Table table) {
    if (!table.rows.empty()) report.section(id, title).blocks = {std::move(table)};
  };
  addTable("others", "What other settings change", settingTable(results));
  addTable("references", "References and start-up", referenceTable(results));
  addTable("notrun", "What did not run", notRunTable(results));
  report.section("reading", "How to read it").blocks = {List{
      {{"Three kinds of error",
        "never mixed: of a collision, of a trajectory, of averages. Times of one kind are of the "
        "same piece of work; those of different kinds cannot be compared."},
       {"The Pareto front",
        "the points that no other is shown to beat in both processor time and error. Times whose "
        "intervals overlap are a tie: both stay."},
       {"Intervals",
        "an error lies between itself less and plus its statistical error and the uncertainty of "
        "its reference. A setting is recommended only if the upper end meets the accuracy. A point "
        "below one of its two uncertainties may be chance; it counts, and is drawn (▽), at its "
        "upper end."},
       {"Averages",
        "have a systematic part, which belongs to the setting, and a statistical part, which falls "
        "with the root of the simulated time and of the number of packings. Packings scatter them "
        "by more than most settings change them."}}}};
  report.section("advice", "Advice: settings to paste").blocks = adviceBlocks(results);
  return report;
}

}  // namespace crossgrain::reports
