#include "cli/study_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "adapters/effects.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/text.hpp"
#include "reports/conformance/report.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/lockstep/report.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {
namespace {

using reports::counted;

std::string orNone(const std::vector<std::string>& names, const char* none) {
  return names.empty() ? none : fmt::format("{}", fmt::join(names, ", "));
}

/// @param called  effects that the case calls for, by name
std::string describeEffects(const std::vector<std::string>& called) {
  std::vector<std::string> leftOut;
  for (const Effect effect : allEffects)
    if (std::ranges::find(called, toString(effect)) == called.end())
      leftOut.push_back(toString(effect));
  return fmt::format("effects called for: {}; left out: {}\n", orNone(called, "none"),
                     orNone(leftOut, "none"));
}

/// Rows of the pairs that a case is judged by: those of the closed forms and of the reference.
std::vector<const EndpointRow*> judgedRows(const CompareResults& results) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::closedForm ||
        (row.kind == PairKind::peer && row.a == referenceOf(results) && !results.nothingJudged))
      rows.push_back(&row);
  return rows;
}

std::string inUnit(std::optional<double> value, const EndpointRow& row) {
  return readable(value) + (row.unit == "-" || row.unit == "1" ? "" : " " + row.unit);
}

/// "stress ratio: grain 0.31, margin 0.05"; the median of the others is another for each engine.
std::string headOf(const EndpointRow& row) {
  const std::string margin = row.marginRelative
                                 ? fmt::format("{} %", readableSetting(100.0 * row.margin))
                                 : readableSetting(row.margin);
  return fmt::format("{}: {}{}, margin {}\n", reports::endpointWords(row.endpoint),
                     row.kind == PairKind::closedForm ? "closed form" : reports::called(row.a),
                     row.a == medianName ? "" : " " + inUnit(row.reference, row), margin);
}

/// "yade", "0.33", "+0.02 (0.01 to 0.03)", "✓ agree"
std::array<std::string, 4> cellsOf(const EndpointRow& row) {
  return {row.b, readablePair(row.value(), row.reference).first,
          readableInterval(row.difference, row.low, row.high, "", Sign::ofAll),
          fmt::format("{} {}", reports::lookOf(row.verdict).mark,
                      row.verdict == Verdict::pass ? "agree" : reports::spaced(row.answer()))};
}

/// A table of endpoints, each with a line for every engine; of many engines, those that agree are
/// in one.
std::string endpointTable(const CompareResults& results, bool verbose) {
  const std::vector<const EndpointRow*> rows = judgedRows(results);
  constexpr std::size_t mostRows = 40;
  const bool all = verbose || rows.size() <= mostRows;
  std::array<std::size_t, 4> widths{};
  std::vector<std::pair<std::string, std::string>>
      groups;  // endpoint, and what it is compared with
  for (const EndpointRow* row : rows) {
    const auto cells = cellsOf(*row);
    for (std::size_t k = 0; k < cells.size(); ++k)
      widths[k] = std::max(widths[k], displayWidth(cells[k]));
    const std::pair group(row->endpoint, row->a);
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  const auto lineOf = [&](const EndpointRow& row) {
    std::string line;
    const auto cells = cellsOf(row);
    for (std::size_t k = 0; k < cells.size(); ++k)
      line += "  " + (k + 1 < cells.size() ? padded(cells[k], widths[k]) : cells[k]);
    return line + "\n";
  };
  std::string text;
  for (const auto& group : groups) {
    std::vector<std::string> agree;
    bool first = true;
    for (const EndpointRow* row : rows) {
      if (std::pair(row->endpoint, row->a) != group) continue;
      if (std::exchange(first, false)) text += headOf(*row);
      if (all || row->verdict != Verdict::pass)
        text += lineOf(*row);
      else
        agree.push_back(row->b);
    }
    if (!agree.empty()) text += fmt::format("  ✓ agree: {}\n", fmt::join(agree, ", "));
  }
  return text;
}

/// "5 agree, 1 borderline, 2 disagree, 1 undecided; 0 of 64 runs failed"; with closed forms, of
/// these first, then "against grain 4 agree …".
std::string countsOf(const CompareResults& results) {
  std::map<std::string, std::map<Verdict, int>> against;
  std::vector<std::string> names;  // of these, closed forms first
  for (const EndpointRow* row : judgedRows(results)) {
    reports::addOnce(names, row->a);
    ++against[row->a][row->verdict];
  }
  if (names.empty()) names.emplace_back();
  std::string text;
  for (const std::string& a : names)
    if (auto& answers = against[a]; !results.nothingJudged)
      text += fmt::format("{}{} agree, {} borderline, {} disagree, {} undecided{}; ",
                          names.size() == 1     ? ""
                          : a == closedFormName ? "with the closed forms "
                                                : "against " + reports::called(a) + " ",
                          answers[Verdict::pass], answers[Verdict::borderline],
                          answers[Verdict::fail], answers[Verdict::undecided],
                          answers[Verdict::notMeasured] == 0
                              ? std::string()
                              : fmt::format(", {} absent", answers[Verdict::notMeasured]));
  return text + fmt::format("{} of {} runs failed\n",
                            std::ranges::count(results.runs, Status::failed, &FlowRun::status),
                            results.runs.size());
}

/// Everything that verdicts rest on, a line each.
std::string basisOf(const CompareResults& results) {
  std::string text = describeEffects(results.effects);
  const auto add = [&](const std::string& line) { text += line + "\n"; };
  if (results.lockstep)
    for (const LockstepRow& row : results.lockstep->rows)
      add(reports::describe(row, results.lockstep->rules));
  for (const SurrogateEngine& own : results.endpoints.surrogates) add(reports::describe(own));
  for (const EndpointRow* row : judgedRows(results))
    add(fmt::format("{} of {}: {}", reports::endpointWords(row->endpoint), row->b,
                    reports::describeAnswer(*row)));
  std::set<std::string> said;
  for (const FlowRun& run : results.runs)
    for (const std::string& remark : run.remarks)
      if (const std::string note = fmt::format("note: {}: {}", run.engine, remark);
          said.insert(note).second)
        add(note);
  if (const InterimFindings& looks = results.endpoints.looks; looks.taken > 0)
    add(reports::describe(looks));
  return text;
}

/// "grain  without friction  0.583 of the time per step, 21 of 42 rings changed"
/// @param places    that a profile is divided into
/// @param untested  why no profile is tested
std::string effectText(const EffectVariant& variant, const char* places, const char* untested) {
  const std::string head = fmt::format("{:<16} without {:<22} ", variant.engine, variant.effect);
  if (variant.status != Status::finished)
    return head +
           fmt::format("{}: {}\n", nameOf(variant.status, engineStatusNames), variant.reason);
  int judged = 0, changed = 0;
  for (const ChangedField& field : variant.changes.fields)
    for (const RingChange& ring : field.rings) {
      judged += ring.resolved.has_value();
      changed += ring.resolved == true;
    }
  return head + fmt::format("{:.3f} of the time per step, {}\n", variant.timeRatio.value_or(NAN),
                            judged == 0
                                ? std::string(untested)
                                : fmt::format("{} of {} {} changed", changed, judged, places));
}

std::string verdictText(const StabilityRun& run) {
  std::string figure;
  if (run.value)
    figure =
        fmt::format("{} {:.3g} {}, limit {:.3g}", run.measure, *run.value, run.unit, run.limit);
  if (run.step) figure += fmt::format("{}step {}", figure.empty() ? "" : ", ", *run.step);
  return fmt::format("{:<9} {:<16} {}{}{}: {}{}{}\n", nameOf(run.verdict, stabilityNames),
                     run.engine, run.name, run.variant.empty() ? "" : " ", run.variant, figure,
                     figure.empty() || run.reason.empty() ? "" : "; ", run.reason);
}

/// One line for each engine and reason of runs that were not judged, as there may be many.
std::string unjudgedText(const std::vector<StabilityRun>& runs, Verdict verdict, const char* word) {
  std::map<std::pair<std::string, std::string>, std::size_t> count;
  for (const StabilityRun& run : runs)
    if (run.verdict == verdict) ++count[{run.engine, run.reason}];
  std::string text;
  for (const auto& [what, times] : count)
    text +=
        fmt::format("{:<9} {:<16} {}: {}\n", word, what.first, counted(times, "run"), what.second);
  return text;
}

/// "unstable: yade: pile, tower/2": names of runs, a line for each engine.
std::string namesText(const std::vector<StabilityRun>& runs, Verdict verdict) {
  std::map<std::string, std::vector<std::string>> names;
  for (const StabilityRun& run : runs)
    if (run.verdict == verdict)
      names[run.engine].push_back(run.variant.empty() ? run.name : run.name + "/" + run.variant);
  std::string text;
  for (const auto& [engine, list] : names)
    text +=
        fmt::format("{}: {}: {}\n", nameOf(verdict, stabilityNames), engine, fmt::join(list, ", "));
  return text;
}

/// Says what the files lack and what that costs, too; the first note says which files they are.
template <typename Results>
std::string averagedText(const Results& results) {
  std::string text = fmt::format("{} snapshots averaged\n", results.averaging.snapshots);
  for (std::size_t k = 1; k < results.notes.size(); ++k)
    text += fmt::format("note: {}\n", results.notes[k]);
  return text;
}

std::string describe(const FoundOption& option) {
  const std::string found = fmt::format("{}", fmt::join(option.values, " | "));
  const std::string declared = option.declared.empty()
                                   ? "does not declare this option"
                                   : fmt::format("declares {}", fmt::join(option.declared, " | "));
  return fmt::format("{:<19} {:<34} {}{}\n", option.name, found, declared,
                     option.contradicts() ? "   <- not what was found" : "");
}

}  // namespace

std::string compareText(const CompareResults& results, bool verbose) {
  std::string text = verbose ? basisOf(results) : "";
  text += endpointTable(results, verbose);
  for (const AlarmRow& alarm : results.endpoints.alarms)
    text += fmt::format("ALARM: {}\n", reports::describe(alarm));
  return text + countsOf(results);
}

std::string averageText(const CompareResults& results, bool) {
  return averagedText(results);
}

std::string revText(const RevResults& results, bool) {
  return averagedText(results);
}

std::string collideText(const CollideResults& results, bool) {
  std::map<std::string, int> refused;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      refused[curve.engine] += curve.status == Status::refused;
  std::string text;
  for (const auto& [engine, count] : refused)
    if (count > 0)
      text += fmt::format("{} does not have the law of {}; the report says why\n", engine,
                          counted(static_cast<std::size_t>(count), "sweep"));
  const SweepCount count = countOf(results);
  return text + fmt::format("{} passed, {} differ by their model, {} failed, {} not judged\n",
                            counted(static_cast<std::size_t>(count.held), "curve"),
                            count.modelDifference, count.beyondLimits, count.notJudged);
}

std::string effectsText(const EffectsResults& results, bool verbose) {
  std::string text = verbose ? describeEffects(results.effects) : "";
  for (const EffectVariant& variant : results.variants)
    if (variant.isSwitched())
      text += effectText(variant, results.region ? "bins" : "rings",
                         results.hasOneStart() ? "profiles of one start are not tested"
                                               : "too few packings to know what changed");
  return text;
}

std::string stabilityText(const StabilityResults& results, bool verbose) {
  const std::vector<StabilityRun>& runs = results.runs;
  const auto count = [&](Verdict verdict) {
    return std::ranges::count(runs, verdict, &StabilityRun::verdict);
  };
  std::string text;
  if (verbose) {
    for (const StabilityRun& run : runs)
      if (run.verdict > Verdict::pass) text += verdictText(run);
    text += unjudgedText(runs, Verdict::notApplicable, "refused");
    text += unjudgedText(runs, Verdict::notMeasured, "not run");
  } else {
    text = namesText(runs, Verdict::borderline) + namesText(runs, Verdict::fail);
  }
  const auto notRun = count(Verdict::notMeasured);
  if (count(Verdict::borderline) > 0)
    text += "degraded (≈): beyond the limit, within the second, milder one; it fails no command\n";
  return text + fmt::format("{} stable, {} degraded, {} unstable, {} refused{}\n",
                            count(Verdict::pass), count(Verdict::borderline), count(Verdict::fail),
                            count(Verdict::notApplicable),
                            notRun == 0 ? "" : fmt::format(", {} not run", notRun));
}

std::string lockstepText(const LockstepResults& results, bool verbose) {
  std::string text;
  for (const LockstepRow& row : results.lockstep.rows)
    if (verbose || row.verdict == Equivalence::differs || row.verdict == Equivalence::undecided ||
        row.verdict == Equivalence::notMeasured)
      text += reports::describe(row, results.lockstep.rules) + "\n";
  return text;
}

std::string conformanceText(const ConformanceResults& results, bool verbose) {
  std::string text = reports::conformanceLead(results) + "\n";
  const auto add = [&](const std::string& line) {
    if (!line.empty()) text += line + "\n";
  };
  for (const auto outcome : {checkBrokeDown, checkFailed, checkUntried, checkSkipped})
    for (const ConformanceRow& row : results.rows)
      if (row.outcome == outcome && (verbose || outcome != checkSkipped))
        add("  " + reports::conformanceSentence(row));
  if (verbose)
    for (const ConformanceRow& row : results.rows)
      if (row.outcome == checkPassed && !row.detail.empty()) add("  " + row.detail);
  add(reports::conformanceNotExamined(results));
  add(reports::conformanceCause(results));
  return text;
}

std::string identifyText(const std::string& engine, const Identification& found) {
  std::string text = fmt::format("{}: from {} starts, followed for {:.3g} ms\n", engine,
                                 found.starts, 1e3 * found.time);
  if (found.closeEnough()) {
    for (const FoundOption& option : found.options) text += describe(option);
    for (const FoundConstant& constant : found.constants)
      text += fmt::format("{:<19} {:+.4g} % of the case's   <- not the case's\n", constant.name,
                          100.0 * constant.change);
    if (!found.missing.empty() || !found.declaredMissing.empty())
      text += fmt::format("{:<19} {:<34} {}{}\n", "does not simulate",
                          orNone(found.missing, "(simulates all)"),
                          found.declaredMissing.empty()
                              ? "declares that it simulates all"
                              : fmt::format("declares {}", fmt::join(found.declaredMissing, ", ")),
                          found.missing == found.declaredMissing ? "" : "   <- not what was found");
  }
  // A plain sentence in place of tables where there is no mirror.
  return text + fmt::format(
                    "largest separation: {:.2e} d from the case's own law, {:.2e} d from the {}\n",
                    found.before, found.left,
                    found.closeEnough() ? "closest mirror" : "nearest mirror tried, which is none");
}

}  // namespace crossgrain::inline cli
