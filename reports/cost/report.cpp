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

#include "reports/common/blocks.hpp"

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

/// An error as the results have it: of rigid bodies "0.32 margins", else a percentage.
std::string amountText(const CostResults& results, std::optional<double> error) {
  if (!results.inMargins || !error) return percentText(error);
  return readable(error) + " margins";
}

/// Likewise an accuracy.
std::string wantText(const CostResults& results, double target) {
  if (!results.inMargins) return targetText(target);
  return fmt::format("{:g} {}", target, target == 1.0 ? "margin" : "margins");
}

/// "--budget 48h", rounded up.
std::string budgetOption(double seconds) {
  const auto [unit, size] = seconds <= 120.0    ? std::pair("s", 1.0)
                            : seconds <= 7200.0 ? std::pair("m", 60.0)
                                                : std::pair("h", 3600.0);
  return fmt::format("--budget {:.0f}{}", std::max(1.0, std::ceil(seconds / size)), unit);
}

/// "3.2 % (1.4 % to 5.1 %)"
std::string intervalText(const CostResults& results, double value, double low, double high) {
  if (amountText(results, low) == amountText(results, high)) return amountText(results, value);
  const double scale = results.inMargins ? 1.0 : 100.0;
  return readableInterval(scale * value, scale * low, scale * high,
                          results.inMargins ? " margins" : " %");
}

/// A point's error with its interval, or the reason why it has none.
std::string errorText(const CostResults& results, const CostPoint& point) {
  if (point.status == Status::notRun) return "not measured";
  if (!point.ran()) return std::string(nameOf(point.status, costStatusNames));
  if (!point.error) return absentText;
  if (point.saysNothing())
    return percentText(point.error) + ", of one packing: no statistical error";
  return intervalText(results, *point.error, point.low(), point.high()) +
         (point.worst ? fmt::format(", worst {}", percentText(point.worst)) : "");
}

const CostPoint* pointAt(const CostResults& results, std::optional<std::size_t> place) {
  return place && *place < results.points.size() ? &results.points[*place] : nullptr;
}

/// Settings of an engine with a measured error, of a kind or of all; without an engine, of all
/// together.
std::size_t settingsTried(const CostResults& results, const std::string& engine,
                          std::optional<CostKind> kind = {}) {
  std::set<std::tuple<std::string, std::string, std::string>> settings;
  for (const CostPoint& point : results.points)
    if (point.measured() && (engine.empty() || point.engine == engine) &&
        (!kind || point.kind == *kind))
      settings.emplace(point.engine, point.knob, point.setting);
  return settings.size();
}

/// Of a cell, or of advice.
const CostModel* modelOf(const CostResults& results, const auto& of) {
  return of.model && *of.model < results.models.size() ? &results.models[*of.model] : nullptr;
}

/// "ψ_f: its limit of small steps is off by 25 % (24 % to 26 %)"
std::string modelText(const CostResults& results, const CostModel& model) {
  return fmt::format("{}: its limit of small steps is off by {}", measureText(model.measure),
                     intervalText(results, model.error, model.low, model.high));
}

/// "a tie with t_c/200 or skin = 0.001, dt/2": settings of which it is not known whether they take
/// less.
std::string tieText(const std::vector<TiedSetting>& ties) {
  Names names;
  for (const TiedSetting& one : ties) names.push_back(settingText(one.knob, one.setting));
  return names.empty() ? "" : fmt::format("a tie with {}", fmt::join(names, " or "));
}

/// "1.2 ms (1.1 ms to 1.3 ms)"
std::string timeText(const CostTime& time) {
  if (!time.time() || !time.timeLow || !time.timeHigh) return readableDuration(time.time());
  return withEnds(readableDuration(time.time()), readableDuration(time.timeLow),
                  readableDuration(time.timeHigh));
}

/// "the cheapest engine", or that it ties with others.
std::string cheapestText(const CostResults& results, const Advice& advice) {
  if (!advice.cheapest) return "";
  Names others;
  for (const Advice& one : results.advice)
    if (one.cheapest && one.target == advice.target && one.engine != advice.engine)
      others.push_back(one.engine);
  return others.empty()
             ? "the cheapest engine"
             : fmt::format("the cheapest engine, a tie with {}", fmt::join(others, ", "));
}

/// Engines that have points, in the order of the results.
Names enginesIn(const CostResults& results) {
  Names engines;
  for (const EngineRow& engine : results.engines)
    if (std::ranges::find(results.points, engine.name, &CostPoint::engine) != results.points.end())
      engines.push_back(engine.name);
  return engines;
}

/// "Which setting … is decided for 31 of 36 against …"
std::string decidedText(const CostResults& results) {
  Names parts;
  for (const CostBasis basis : costBases) {
    std::size_t all = 0, decided = 0;
    for (const CostCell& cell : results.cells)
      if (cell.basis == basis) ++all, decided += cell.decided();
    if (all > 0)
      parts.push_back(fmt::format("{} of {} against {}", decided, all,
                                  basis == CostBasis::own ? "engines' own limits of small steps"
                                  : results.inMargins     ? "the closed forms"
                                                          : "the case's law"));
  }
  if (parts.empty()) return "Nothing was measured.";
  return fmt::format("Which setting reaches an accuracy for the least time is decided for {}.",
                     fmt::join(parts, " and "));
}

/// Number of points by status.
std::string countsText(const CostResults& results) {
  return fmt::format("{} ran, {} failed, {} refused, {} not measured",
                     results.count(Status::finished), results.count(Status::failed),
                     results.count(Status::refused), results.count(Status::notRun));
}

std::string asToml(const Advice& one, const CostResults& results) {
  std::string text = fmt::format(
      "# {}, wanted {}: {}", one.engine,
      results.inMargins ? wantText(results, one.target) : fmt::format("{:g} %", 100.0 * one.target),
      nameOf(one.verdict, costVerdictNames));
  const bool reached = one.verdict == Verdict::pass;
  if (!one.setting.empty()) {
    std::vector<std::string_view> kinds;
    for (const CostKind kind : one.kinds) kinds.push_back(nameOf(kind));
    text += reached ? " by "
            : one.verdict == Verdict::notMeasured
                ? " far enough; the best so far is "
                : fmt::format(", the best of {} is ",
                              counted(settingsTried(results, one.engine), "setting"));
    text += speaksForItself(one.knob) || one.setting.starts_with(one.knob)
                ? one.setting
                : one.knob + " " + one.setting;
    if (const auto time = one.time())
      text += fmt::format(
          ", {:.3g} s of {} per {}", *time, one.cpuSeconds ? "processor time" : "wall time",
          one.costKind() == CostKind::averages ? "second of the scene" : "sweep of collisions");
    text += fmt::format(" (measured in {})", fmt::join(kinds, " and "));
    for (const std::string& more : {tieText(one.ties), cheapestText(results, one)})
      if (!more.empty()) text += "; " + more;
  }
  text += "\n";
  const CostModel* model = modelOf(results, one);
  if (model) text += fmt::format("# {}, {}\n", toString(model->kind), modelText(results, *model));
  if (const CostPoint* point = pointAt(results, one.obstacle); point && !model)
    text += fmt::format("# {}, {}: {} {}{}\n", toString(point->kind), point->measure,
                        readableRange(point->low(), point->high()),
                        results.inMargins ? "margins" : "of its scale",
                        !reached            ? ""
                        : results.inMargins ? " at a smaller step"
                                            : ", which does not decide");
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

/// "t_c/2.5 (2 ms); unstable from 2.5 ms on"
OverviewCell stabilityCell(const CostResults& results, const std::string& engine) {
  OverviewCell cell{Verdict::notMeasured, {}, "s", {}, {}, "advice"};
  const LargestStep* const found = findBy(results.largestSteps, engine, &LargestStep::engine);
  if (!found) return cell;
  cell.verdict = std::nullopt;
  cell.value = found->stable;
  cell.shown = found->stable ? readableDuration(found->stable) : "none of those tried";
  if (found->stable && found->contactTime)
    cell.words = fmt::format("t_c/{:.3g}{}", *found->contactTime / *found->stable,
                             found->kind == CostKind::trajectory ? " on short paths" : "");
  if (found->unstable)
    cell.words += fmt::format("{}unstable at {}", cell.words.empty() ? "" : "; ",
                              readableDuration(found->unstable));
  else
    cell.words += "; the largest that was tried";
  return cell;
}

/// "0.41 margins off": the largest error of rigid bodies' case as it is.
OverviewCell ownCell(const CostResults& results, const std::string& engine) {
  OverviewCell cell{Verdict::notMeasured, {}, "margins", {}, {}, "trade"};
  for (const CostPoint* point : largestErrors(results)) {
    if (point->engine != engine || !point->fragment.empty()) continue;
    cell.verdict = point->high() <= 1.0 ? Verdict::pass : Verdict::fail;
    cell.value = point->error;
    cell.shown = amountText(results, point->error) + " off";
    cell.words = timeText(*point);
  }
  return cell;
}

/// "0.41 ms": the step of an engine's setting, where all its points have the same.
std::string stepText(const CostResults& results, const Advice& advice) {
  for (const CostPoint& point : results.points)
    if (point.engine == advice.engine && point.knob == advice.knob &&
        point.setting == advice.setting && point.dt)
      return readableDuration(point.dt);
  return {};
}

/// "but dt/8: creep 3.2 margins": of what rigid bodies reach, a smaller step that does not.
std::string obstacleText(const CostResults& results, const Advice& advice) {
  const CostPoint* point = pointAt(results, advice.obstacle);
  if (!results.inMargins || !point) return {};
  return fmt::format("{}{}: {} {}", advice.verdict == Verdict::pass ? "but " : "",
                     settingText(point->knob, point->setting), measureText(point->measure),
                     amountText(results, point->error));
}

/// The cheapest setting for an accuracy, or the obstacle to it.
OverviewCell adviceCell(const CostResults& results, const Advice& advice) {
  OverviewCell cell{advice.verdict, {}, "s", {}, {}, "advice"};
  if (advice.verdict == Verdict::notMeasured) return cell;
  if (advice.verdict == Verdict::pass) {
    cell.value = advice.time();
    cell.shown = settingText(advice.knob, advice.setting);
    cell.words = fmt::format("{}; {}", stepText(results, advice), timeText(advice));
    for (const std::string& more :
         {tieText(advice.ties), cheapestText(results, advice), obstacleText(results, advice)})
      if (!more.empty()) cell.words += "; " + more;
    return cell;
  }
  cell.unit = results.inMargins ? "margins" : "%";
  const auto show = [&](double error, const std::string& measure) {
    cell.value = results.inMargins ? error : 100.0 * error;
    cell.shown = amountText(results, error) + " off";
    cell.words = measureText(withoutOwn(measure));
  };
  const CostPoint* point = pointAt(results, advice.obstacle);
  if (const CostModel* model = modelOf(results, advice)) {
    cell.verdict = Verdict::modelDifference;
    show(model->error, model->measure);
    cell.words += ", whatever the step";
  } else if (point && point->counted()) {
    show(*point->counted(), point->measure);
    cell.words +=
        fmt::format("; the best of {}", counted(settingsTried(results, advice.engine), "setting"));
  }
  return cell;
}

/// "1 %: grain with t_c/200 (0.01 ms; 1.2 s (1.1 s to 1.3 s) for a second of the scene)"; of ties
/// all.
std::string cheapestOf(const CostResults& results, double target) {
  Names names;
  for (const Advice& one : results.advice)
    if (one.target == target && one.cheapest)
      names.push_back(fmt::format("{} with {} (step {}; {} for {}{})", one.engine,
                                  settingText(one.knob, one.setting), stepText(results, one),
                                  timeText(one), timeUnit(*one.costKind()),
                                  one.ties.empty() ? "" : "; " + tieText(one.ties)));
  const std::string found = names.empty()
                                ? fmt::format("no setting ({} tried)", settingsTried(results, ""))
                            : names.size() == 1 ? names.front()
                                                : fmt::format("a tie of {}", listed(names));
  return fmt::format("{}: {}", wantText(results, target), found);
}

/// The accuracies of the first matrix: those of the cells and the one asked for, falling.
std::vector<double> answerTargets(const CostResults& results) {
  std::set<double, std::greater<>> targets;
  for (const CostCell& cell : results.cells) targets.insert(cell.target);
  if (results.target) targets.insert(*results.target);
  return {targets.begin(), targets.end()};
}

/// Engines without an endpoint, with the budget that has room for one; empty: there is none such.
/// Where what all share took longer than predicted, and is kept, that is less than was given.
std::string missingAnswersText(const CostResults& results) {
  std::vector<std::string> budgets, engines, again;
  for (const MissingAnswer& one : results.missingAnswers) {
    engines.push_back(one.engine);
    if (one.budget <= results.budget)
      again.push_back(one.engine);
    else
      budgets.push_back(fmt::format("{} for {}", budgetOption(one.budget), one.engine));
  }
  if (engines.empty()) return {};
  if (!again.empty())
    budgets.insert(budgets.begin(), fmt::format("the same command again for {}, as what ran longer "
                                                "than predicted is kept",
                                                listed(again)));
  return fmt::format("{} was measured within the budget of {}; predicted: {}.{}",
                     results.lacksEndpoints() ? "No endpoint of the scene"
                                              : fmt::format("No endpoint of {}", listed(engines)),
                     readableDuration(results.budget), listed(budgets),
                     results.lacksEndpoints() ? " Sizes and threads were not timed." : "");
}

std::string nextStep(const CostResults& results) {
  if (const std::size_t left = results.count(Status::notRun))
    return fmt::format(
        "Next: the same command with {} measures the {} that did not fit into the budget.",
        budgetOption(results.budgetForTheRest.value_or(0.0)), counted(left, "point"));
  return "Next: take the setting that you need from the advice on this page.";
}

/// An engine per row: its largest stable step, and for each wanted accuracy the setting that the
/// advice has for it, with step and time.
Overview costOverview(const CostResults& results) {
  Overview overview;
  const std::vector<double> targets = answerTargets(results);
  if (results.inMargins)
    overview.columns.push_back({"the case as it is",
                                "Its largest error, and the time of a second of the scene.",
                                "trade"});
  else
    overview.columns.push_back({"largest stable step",
                                "The largest time step at which the scene runs as smaller ones do.",
                                "advice"});
  for (const double target : targets) {
    std::string shown = wantText(results, target);  // a number and its unit stay in one line
    if (const std::size_t at = shown.find(' '); at != std::string::npos)
      shown.replace(at, 1, "\u00a0");
    overview.columns.push_back(
        {shown,
         fmt::format("The cheapest setting whose errors are below {}.", wantText(results, target)),
         "advice"});
  }
  for (const std::string& engine : enginesIn(results)) {
    OverviewRow row{
        engine,
        true,
        {results.inMargins ? ownCell(results, engine) : stabilityCell(results, engine)}};
    for (const double target : targets) {
      const Advice* const advice = findIf(results.advice, [&](const Advice& one) {
        return one.engine == engine && one.target == target;
      });
      row.cells.push_back(advice ? adviceCell(results, *advice) : OverviewCell{});
    }
    overview.rows.push_back(std::move(row));
  }
  if (const std::string missing = missingAnswersText(results); !missing.empty())
    overview.conclusion.push_back(missing);
  Names cheapest;
  for (const double target : targets) cheapest.push_back(cheapestOf(results, target));
  if (!cheapest.empty())
    overview.conclusion.push_back(
        fmt::format("Cheapest engine and setting for {}.", fmt::join(cheapest, "; ")));
  overview.conclusion.push_back(nextStep(results));
  return overview;
}

/// The setting that reaches an accuracy, or the verdict with the best setting below it.
Cell verdictCell(const CostResults& results, const auto& of, std::string remark = {}) {
  const std::string setting = settingText(of.knob, of.setting);
  const bool reached = of.verdict == Verdict::pass;
  std::optional<CostKind> kind;
  if constexpr (requires { of.kind; }) kind = of.kind;
  return {reached ? setting : std::string(nameOf(of.verdict, costVerdictNames)),
          {reached || setting.empty()
               ? ""
               : fmt::format("best of {}: {}",
                             counted(settingsTried(results, of.engine, kind), "setting"), setting),
           std::move(remark)},
          of.verdict,
          true};
}

std::string decidesText(const std::string& decides) {
  return decides.empty() ? "" : "would decide: " + decides;
}

/// Per kind of error, basis, engine and target: the setting that reaches it for the least time.
Table accuracyTable(const CostResults& results) {
  Table table{{engineNames("engine"), "accuracy", "setting", numbers("time"), remarks("error")}};
  for (const CostKind kind : kindsIn(results.points))
    for (const CostBasis basis : costBases) {
      std::string group = fmt::format(
          "{}, compared with {}; time of {}", kindText(kind),
          basis == CostBasis::own ? "the engine's own limit" : "the case's law", timeUnit(kind));
      for (const CostCell& cell : results.cells) {
        if (cell.kind != kind || cell.basis != basis) continue;
        const CostModel* model = modelOf(results, cell);
        const CostPoint* point = pointAt(results, cell.point);
        std::string error;
        if (model)
          error = modelText(results, *model);
        else if (point)
          error = fmt::format("{}: {}", measureText(withoutOwn(point->measure)),
                              errorText(results, *point));
        table.rows.push_back(
            {{cell.engine, targetText(cell.target), verdictCell(results, cell, tieText(cell.ties)),
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
  Table table{{engineNames("engine"), "accuracy", "setting", numbers("time"),
               remarks(results.inMargins ? "in the way" : "averages")}};
  Blocks fragments;
  for (const Advice& one : results.advice) {
    const CostPoint* obstacle = pointAt(results, one.obstacle);
    std::string time = absentText;
    if (one.time() && one.costKind())
      time = fmt::format("{} for {}", timeText(one), timeUnit(*one.costKind()));
    const CostModel* model = modelOf(results, one);
    std::string remark = tieText(one.ties);
    if (const std::string cheapest = cheapestText(results, one); !cheapest.empty())
      remark += (remark.empty() ? "" : "; ") + cheapest;
    Cell rest(model               ? modelText(results, *model)
              : results.inMargins ? obstacleText(results, one)
              : obstacle
                  ? fmt::format("{}, {}: {}", toString(obstacle->kind),
                                measureText(obstacle->measure), errorText(results, *obstacle))
                  : "",
              {decidesText(one.decides)});
    table.rows.push_back({{one.engine, wantText(results, one.target),
                           verdictCell(results, one, remark), time, rest}});
    if (one.verdict != Verdict::pass) continue;
    fragments.push_back(
        Heading{fmt::format("{} for {}: {}", one.engine, wantText(results, one.target),
                            settingText(one.knob, one.setting))});
    fragments.push_back(Code{one.fragment.empty() ? "# the case as it is" : one.fragment});
  }
  table.note = results.inMargins
                   ? "The cheapest setting with which every endpoint is that near its closed form; "
                     "the last column has the endpoint that is in the way."
                   : "The cheapest setting that collisions show to reach the accuracy of the "
                     "case's law and that "
                     "averages do not contradict; the last column has what stands in the way, or "
                     "an average whose "
                     "scatter cannot decide.";
  if (fragments.empty()) fragments = {Paragraph{"No engine is shown to reach any accuracy."}};
  fragments.insert(fragments.begin(), std::move(table));
  return fragments;
}

/// Settings other than time steps: their time and errors.
Table settingTable(const CostResults& results) {
  Table table{{numbers("number"), engineNames("engine"), "setting", "error of", numbers("time"),
               remarks("error")}};
  const auto settings = otherSettings(results.points);
  for (const CostPoint& point : results.points) {
    const auto place = std::ranges::find(settings, OtherSetting{point.knob, point.setting});
    if (place == settings.end()) continue;
    table.rows.push_back({{fmt::to_string(place - settings.begin() + 1), point.engine,
                           settingText(point.knob, point.setting),
                           toString(point.kind) + ", " + measureText(point.measure),
                           timeText(point), errorText(results, point)}});
  }
  table.note = "The number is that in the plots.";
  return table;
}

/// Speeds and sizes that collisions have, of a run of the scene.
Table impactTable(const CostResults& results) {
  Table table{{"pair", numbers("new contacts"), numbers("median v_n [m/s]"),
               numbers("95 % below [m/s]"), numbers("lightest pair, m₁₂ [kg]")}};
  for (const PairImpacts& pair : results.impacts.pairs)
    table.rows.push_back(
        {{pair.pair, readableCount(static_cast<double>(pair.contacts)), readable(pair.median),
          readable(pair.fast), readable(1.0 / (1.0 / pair.mass[0] + 1.0 / pair.mass[1]))}});
  table.note = fmt::format(
      "Of contacts that began in {} of the flow on the in-house engine; collisions have the median "
      "speed and, of laws under which they depend on it, the 95th percentile, unless cost.speed "
      "says another one. A kind of pair that did not meet has the speed of the most frequent one.",
      readableDuration(results.impacts.seconds));
  if (table.rows.empty() && results.impacts.seconds > 0.0) {
    table.rows.push_back({{"all", "0", absentText, absentText, absentText}});
    table.note = fmt::format(
        "No contact began in {} of the flow: collisions have the root mean square speed of the "
        "bodies, {} m/s, or 0.01 m/s where they rest.",
        readableDuration(results.impacts.seconds), readable(results.impacts.rmsSpeed));
  }
  return table;
}

/// Points that failed, were refused or did not fit, equal reasons together.
Table notRunTable(const CostResults& results) {
  Table table{{engineNames("engine"), "error", "setting", "status", remarks("reason"), "measures"}};
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
          errorText(results, point), point.reason, measureText(point.measure)}});
  }
  return table;
}

Table referenceTable(const CostResults& results) {
  Table table{{"error", "reference", "setting", numbers("its own error"), "note"}};
  for (const CostReference& reference : results.references)
    table.rows.push_back({{toString(reference.kind), reference.engine, reference.setting,
                           amountText(results, reference.error), reference.note}});
  for (const Startup& startup : results.startup)
    table.rows.push_back(
        {{"start-up", startup.engine, "", "",
          fmt::format("started in {}, loaded the scene in {}, which is no part of any other time",
                      readableDuration(startup.start), readableDuration(startup.load))}});
  return table;
}

/// Number of points by status, and the engines that refused.
Names costSentences(const CostResults& results) {
  std::string counts = fmt::format("{} points: {}", results.points.size(), countsText(results));
  if (results.count(Status::notRun) > 0 && results.budgetForTheRest)
    counts +=
        fmt::format(", for they did not fit into the budget of {}; they would with --resume {}",
                    readableDuration(results.budget), budgetOption(*results.budgetForTheRest));
  Names sentences = {decidedText(results), counts + "."};
  for (const EngineRow& engine : results.engines)
    if (engine.status == Status::refused)
      sentences.push_back(fmt::format("{} refused the scene: {}", engine.name, engine.reason));
  return sentences;
}

/// Figures of quantities that are not folded.
constexpr std::size_t mostInSight = 4;

constexpr const char* whatMarginsAre =
    "Each endpoint's distance from its closed form, in units of the case's margin of it: below 1 "
    "it "
    "is within. Runs of one start have the same bits, so that errors have no interval; times have "
    "one, of the rounds in which settings take turns.";
constexpr const char* whatRigidLinesAre =
    "A line per engine over its settings that no other one of it beats in both time and error; "
    "open "
    "marks: its other ones; grey: within the case's margin; ring: the cheapest setting within.";

std::string whatErrorsAre(CostKind kind) {
  if (kind == CostKind::collision)
    return "Two bodies collide, or one and a wall, over a whole curve of Ψ_i, beginning anywhere "
           "in a step; the error is the root mean square distance from the oracle, in units of the "
           "range of its curve, of the pair and of the step up to a tenth shorter for which it is "
           "largest. Worst: of a single collision among those that ran.";
  if (kind == CostKind::trajectory)
    return "Packings over a time short against their chaos; the error is the root mean square "
           "distance of the bodies, in diameters, from a run at a much smaller step, mean over "
           "packings.";
  return "The case's endpoints, against a reference on the same packings: the mean paired "
         "difference, in units of the reference's size or, of an endpoint with an absolute margin, "
         "of ten margins.";
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

Report reportOf(const CostResults& results) {
  Report report{{results.head, results.engines, costOverview(results)}, results.elapsed};
  report.notes = costSentences(results);
  std::ranges::copy(results.notes, std::back_inserter(report.notes));
  report.figures = costFigures(results);
  report.tables = {{"cost.csv", costCsv(results)}};
  if (!results.steps.empty()) report.tables.push_back({"scale.csv", scaleCsv(results)});
  std::string inSight;
  if (Drawings picture = drawingsOf(report.figures, "cost_picture_"); !picture.names.empty()) {
    Drawings others = picture;
    picture.names.resize(std::min(picture.names.size(), mostInSight));
    others.names.erase(others.names.begin(),
                       others.names.begin() + static_cast<std::ptrdiff_t>(picture.names.size()));
    Blocks& blocks = report.section("picture", "Error against processor time and steps").blocks;
    blocks = {
        Paragraph{results.inMargins ? whatMarginsAre : whatErrorsAre(CostKind::averages)},
        Paragraph{
            results.inMargins
                ? whatRigidLinesAre
                : "A line per engine over its time steps, upright bars: the interval over "
                  "packings; grey: within the case's margin; ring: the largest step whose whole "
                  "interval lies inside. Collisions: the worst that ran, over phases of a step and "
                  "every pair of the scene; dashed: the largest rms."},
        std::move(picture)};
    if (!others.names.empty()) blocks.push_back(Details{"Other quantities", {std::move(others)}});
    inSight = "picture";
  }
  report.section("advice", "Advice: settings to paste").blocks = adviceBlocks(results);
  if (results.inMargins)
    report.section("trade", "Small steps or many iterations").blocks = tradeBlocks(results);
  else
    report.section("accuracy", "Which setting reaches an accuracy for the least time").blocks = {
        accuracyTable(results)};
  for (const CostKind kind : kindsIn(results.points)) {
    if (kind == CostKind::averages) continue;  // has the picture
    report.section("kind-" + toString(kind), "Error against time: " + kindText(kind)).blocks = {
        Paragraph{whatErrorsAre(kind)}, drawingsOf(report.figures, "cost_" + toString(kind))};
    if (inSight.empty()) inSight = "kind-" + toString(kind);
  }
  if (const Table table = impactTable(results); !table.rows.empty())
    report.section("impacts", "Collisions of this scene").blocks = {table};
  const auto addTable = [&](const std::string& id, const std::string& title, Table table) {
    if (!table.rows.empty()) report.section(id, title).blocks = {std::move(table)};
  };
  if (auto figure = stepFigure(results)) report.figures.push_back(std::move(*figure));
  if (!results.steps.empty())
    report.section("steps", "Time of a step: bodies, threads and ranks").blocks = {
        drawingsOf(report.figures, "cost_steps"), stepTable(results)};
  if (!results.inMargins) addTable("others", "What other settings change", settingTable(results));
  addTable("references", "References and start-up", referenceTable(results));
  addTable("notrun", "What did not run", notRunTable(results));
  if (!results.inMargins)
    report.section("reading", "How to read it").blocks = {List{
        {{"Three kinds of error",
          "never mixed: of a collision, of a trajectory, of averages. Times of one kind are of "
          "the same piece of work; those of different kinds cannot be compared."},
         {"The Pareto front",
          "the points that no other is shown to beat in both processor time and error. Times "
          "whose intervals overlap are a tie: both stay."},
         {"Intervals",
          "an error lies between itself less and plus its statistical error and the uncertainty "
          "of its reference. A setting is recommended only if the upper end meets the accuracy. "
          "A point below one of its two uncertainties may be chance; it counts, and is drawn "
          "(▽), at its upper end."},
         {"Averages",
          "have a systematic part, which belongs to the setting, and a statistical part, which "
          "falls with the root of the simulated time and of the number of packings. Packings "
          "scatter them by more than most settings change them."}}}};
  report.foldAllBut({inSight.empty() ? "steps" : inSight});
  return report;
}

}  // namespace crossgrain::reports
