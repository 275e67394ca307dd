#include "reports/conformance/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

struct CheckPart {
  const char *name, *title, *column, *asks;
};
constexpr CheckPart checkParts[] = {
    {"suite", "The suite", "suite", "Checks of single properties on scenes of a few disks."},
    {"lockstep", "Comparison with its mirror", "law verified",
     "Step-by-step comparison with the in-house engine under the declared conventions."},
    {"collisions", "Collisions", "collisions",
     "Two-particle collisions compared with the declared law."}};

std::string outcomeWord(const ConformanceRow& row) {
  return spaced(nameOf(row.outcome, checkNames));
}

bool isFault(const ConformanceRow& row) {
  return row.outcome.verdict == Verdict::fail;
}

OverviewCell partCell(const ConformanceResults& results, const CheckPart& part) {
  std::size_t asked = 0, passes = 0, untried = 0;
  Names faults;
  for (const ConformanceRow& row : results.rows) {
    if (row.part != part.name || row.outcome == checkSkipped) continue;
    untried += row.outcome == checkUntried;
    ++asked;
    passes += row.outcome == checkPassed;
    if (isFault(row)) faults.push_back(row.name);
  }
  OverviewCell cell{Verdict::notMeasured, {}, "checks", {}, {}, ""};
  if (asked == untried) return cell;
  const Verdict verdict = !faults.empty() ? Verdict::fail
                          : untried > 0   ? Verdict::undecided
                                          : Verdict::pass;
  return {verdict,
          static_cast<double>(passes),
          "checks",
          fmt::format("{} of {}", passes, asked),
          listedShortly(faults, 3),
          part.name};
}

OverviewCell notExaminedCell(const ConformanceResults& results) {
  OverviewCell cell{Verdict::notMeasured, {}, "capabilities", {}, {}, {}};
  if (!results.declared) return cell;
  cell.verdict = std::nullopt;
  cell.value = static_cast<double>(results.notExamined.size());
  cell.shown = fmt::format("{} of {}", results.notExamined.size(), *results.declared);
  cell.words = listedShortly(results.notExamined, 3);
  return cell;
}

/// Rows of one part: those that failed unfolded, the others folded.
void addCheckPart(Report& report, const ConformanceResults& results, const CheckPart& part) {
  Table faults{{"check", "passes if", "outcome", remarks("number or reason")}};
  Table others = faults;
  for (const ConformanceRow& row : results.rows) {
    if (row.part != part.name) continue;
    const std::string more = row.faults > 1 ? fmt::format(" (and {} more)", row.faults - 1) : "";
    (isFault(row) ? faults : others)
        .rows.push_back({{row.name,
                          row.what,
                          {outcomeWord(row), {}, row.outcome.verdict, true},
                          row.detail + more}});
  }
  if (faults.rows.empty() && others.rows.empty()) return;
  const std::string rest = counted(others.rows.size(), "check") + " without a fault";
  Section& section = report.section(part.name, part.title, part.title);
  section.folded = faults.rows.empty();
  if (section.folded) {
    section.title += ": " + rest;
    section.blocks = {std::move(others)};
    return;
  }
  section.blocks = {std::move(faults)};
  if (!others.rows.empty()) section.blocks.push_back(Details{rest, {std::move(others)}});
}

/// Checks of one subject.
struct Subject {
  std::string name;
  std::size_t passed = 0;
  Names failed = {};
};

/// In the order in which they were run.
std::vector<Subject> subjectsOf(const ConformanceResults& results) {
  std::vector<Subject> all;
  for (const ConformanceRow& row : results.rows) {
    const auto part = std::ranges::find(checkParts, row.part, &CheckPart::name);
    const std::string name = !row.about.empty()             ? row.about
                             : part == std::end(checkParts) ? row.part
                                                            : part->column;
    auto subject = std::ranges::find(all, name, &Subject::name);
    if (subject == all.end()) subject = all.insert(all.end(), {name});
    subject->passed += row.outcome == checkPassed;
    if (isFault(row)) subject->failed.push_back(row.name);
  }
  return all;
}

std::vector<JUnitCase> conformanceChecks(const ConformanceResults& results) {
  std::vector<JUnitCase> cases;
  for (const ConformanceRow& row : results.rows)
    cases.push_back({results.engine.name + " " + row.part, row.name, row.outcome.verdict,
                     row.detail, row.seconds, row.outcome.status == Status::failed});
  return cases;
}

/// One row: checks passed in each part, and what was not examined.
Overview conformanceOverview(const ConformanceResults& results) {
  Overview overview;
  OverviewRow row{results.engine.name, true, {}};
  for (const CheckPart& part : checkParts) {
    overview.columns.push_back({part.column, part.asks, ""});
    row.cells.push_back(partCell(results, part));
  }
  overview.columns.push_back(
      {"not examined", "Declared capabilities that no check asked for, or that were refused.", ""});
  row.cells.push_back(notExaminedCell(results));
  overview.rows = {std::move(row)};
  overview.conclusion = {conformanceLead(results)};
  for (const std::string& more : nonEmpty({conformanceCause(results)}))
    overview.conclusion.push_back(capitalised(more) + ".");
  return overview;
}

}  // namespace

std::string conformanceLead(const ConformanceResults& results) {
  const std::size_t asked = results.rows.size() - results.count(checkSkipped);
  std::string lead = fmt::format("{} ({}): ", results.engine.name, results.engine.version);
  if (const auto part = results.partExamined())
    lead += fmt::format("{} of {} declared capabilities examined ({:.0f} %{}); ",
                        *results.declared - results.notExamined.size(), *results.declared,
                        std::floor(100.0 * *part),
                        *part < leastExamined
                            ? fmt::format(", which is below {:.0f} %", 100.0 * leastExamined)
                            : "");
  lead += fmt::format("{} of {} checks passed", results.count(checkPassed), asked);
  for (const auto& [outcome, words] : {std::pair(checkFailed, "{} failed"),
                                       {checkBrokeDown, "it broke down in {}"},
                                       {checkUntried, "{} not tried in the time given"},
                                       {checkSkipped, "{} skipped"}})
    if (const std::size_t count = results.count(outcome))
      lead += ", " + fmt::format(fmt::runtime(words), count);
  return lead + ".";
}

std::string conformanceNotExamined(const ConformanceResults& results) {
  Names lines;
  if (!results.notExamined.empty())
    lines.push_back(fmt::format("not examined: {}", fmt::join(results.notExamined, "; ")));
  if (!results.atDefaults.empty())
    lines.push_back(fmt::format("settings run at their defaults alone: {}",
                                fmt::join(results.atDefaults, ", ")));
  return fmt::format("{}", fmt::join(lines, "; "));
}

std::string conformanceCause(const ConformanceResults& results) {
  if (!results.cause.empty()) return "most likely: " + results.cause;
  if (results.count(checkFailed) == 0) return {};
  Names passes, fails;
  for (const Subject& subject : subjectsOf(results)) {
    if (!subject.failed.empty())
      fails.push_back(fmt::format("{} ({})", subject.name, listedShortly(subject.failed, 3)));
    else if (subject.passed > 0)
      passes.push_back(subject.name);
  }
  return fmt::format("no single cause of those tried explains it; {}fails: {}",
                     passes.empty() ? "" : fmt::format("passes: {}; ", fmt::join(passes, ", ")),
                     fmt::join(fails, ", "));
}

std::string conformanceSentence(const ConformanceRow& row) {
  std::string sentence = fmt::format("{}: {} ({})", outcomeWord(row), row.name, row.what);
  if (!row.detail.empty()) sentence += ": " + row.detail;
  if (row.faults > 1) sentence += fmt::format(" (and {} more)", row.faults - 1);
  return sentence;
}

Report reportOf(const ConformanceResults& results) {
  Report report{{results.head, {results.engine}, conformanceOverview(results)}, results.elapsed};
  for (const std::string& more : nonEmpty({conformanceNotExamined(results)}))
    report.notes.push_back(capitalised(more) + ".");
  for (const CheckPart& part : checkParts) addCheckPart(report, results, part);
  Section& reading = report.section("reading", "How to read it");
  reading.folded = true;
  reading.blocks = {List{
      {{"Suite",
        "each check poses a property on a scene of a few disks, under the conventions that the "
        "engine declares."},
       {"Skipped",
        "the engine does not declare it, or its kind of contacts cannot be asked. It is no fault."},
       {"Not examined",
        "the engine declares it and no check asked for it, or it refused: neither good nor bad."},
       {"Failed", "the first fault is shown with its number, and how many more there were."},
       {"Mirror and collisions",
        "the mirror is the in-house engine with the conventions declared, followed step by step "
        "from four states of the quick cell. Collisions are compared with the declared law at 50 "
        "steps a contact, without the pure spring, which has two limits of small steps."}}}};
  report.checks = conformanceChecks(results);
  return report;
}

}  // namespace crossgrain::reports
