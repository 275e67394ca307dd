#include "reports/lockstep/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"

namespace crossgrain::reports {
namespace {

constexpr const char* evidence = "lockstep";

OverviewCell separationCell(const LockstepRow& row, bool last) {
  OverviewCell cell{Verdict::notMeasured, {}, "d", {}, {}, evidence};
  if (row.separations.empty()) return cell;
  const LockstepSeparation& at = last ? row.separations.back() : row.separations.front();
  cell.verdict = std::nullopt;
  cell.value = finite(at.largest);
  cell.shown = readable(cell.value) + " d";
  cell.words = fmt::format("after {} ms", readable(1e3 * at.time));
  return cell;
}

OverviewCell forcesCell(const LockstepRow& row) {
  OverviewCell cell{Verdict::notMeasured, {}, "of the largest", {}, {}, evidence};
  if (!row.forces) return cell;
  cell.verdict = std::nullopt;
  cell.value = std::max(row.forces->normal, row.forces->tangential);
  cell.shown = percentText(*cell.value);
  cell.words = "of the largest force";
  if (const std::size_t others = row.forces->missing + row.forces->extra; others > 0)
    cell.words += fmt::format("; {} contacts missing or too many", others);
  return cell;
}

OverviewCell termCell(const LockstepRow& row) {
  OverviewCell cell{Verdict::notApplicable, {}, "%", {}, {}, evidence};
  if (row.verdict == Equivalence::notMeasured) cell.verdict = Verdict::notMeasured;
  if (!row.term) {
    if (row.verdict == Equivalence::differs) cell.words = "no single term accounts for it";
    return cell;
  }
  cell.verdict.reset();
  if (row.verdict == Equivalence::differs) cell.verdict = Verdict::fail;
  cell.words = constantWords(row.term->name);
  if (!row.term->amount) return cell;
  cell.value = 100.0 * *row.term->amount;
  cell.shown = (*cell.value < 0.0 ? "−" : "+") + percentText(std::abs(*row.term->amount));
  return cell;
}

/// The deviation found of those that differ from the law that they declare.
std::string deviationOf(const LockstepFindings& findings) {
  std::vector<std::string> parts;
  for (const LockstepRow& row : findings.rows)
    if (lockstepState(row, findings.rules) == Verdict::fail)
      parts.push_back(fmt::format(
          "{}: {}", row.engine,
          row.term ? constantWords(row.term->name) : "no single constant, convention or effect"));
  if (parts.empty()) return {};
  return fmt::format("Deviation found: {}.", listedShortly(parts, 3));
}

std::string nextOf(const LockstepFindings& findings) {
  std::vector<std::string> differ, unmeasured, undecided;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == Equivalence::undecided) undecided.push_back(row.engine);
    if (lockstepState(row, findings.rules) == Verdict::fail) differ.push_back(row.engine);
    if (row.verdict == Equivalence::notMeasured) unmeasured.push_back(row.engine);
  }
  if (!differ.empty())
    return fmt::format("Next: see the first contact at which {} {}, in the table below.",
                       listed(differ), differ.size() == 1 ? "differs" : "differ");
  if (!undecided.empty())
    return fmt::format("Next: more starts for {}, e.g. --starts {}.", listed(undecided),
                       4 * findings.starts.size());
  if (unmeasured.size() == findings.rows.size())
    return "Next: a scene whose contacts have a mirror; the reasons are in the table below.";
  return "Next: compare the averages; a fault that begins later than these windows is not seen "
         "here.";
}

}  // namespace

std::string leadOf(const LockstepFindings& findings) {
  std::vector<std::string> same, differ, ordered, open, undecided;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == Equivalence::notMeasured)
      open.push_back(row.engine);
    else if (row.verdict == Equivalence::undecided)
      undecided.push_back(row.engine);
    else if (row.verdict == Equivalence::differs && !openInLaw(row, findings.rules).empty())
      ordered.push_back(row.engine);
    else
      (row.verdict == Equivalence::differs ? differ : same).push_back(row.engine);
  }
  if (same.empty() && differ.empty() && ordered.empty() && undecided.empty())
    return "Nothing was measured.";
  std::vector<std::string> parts;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (!names.empty())
      parts.push_back(fmt::format("{} {}", listed(names), names.size() == 1 ? one : many));
  };
  add(same, "is the law that it declares", "are the laws that they declare");
  add(differ, "is another law than it declares", "are other laws than they declare");
  add(ordered, "differs from its mirror where disks touch several at once",
      "differ from their mirrors where disks touch several at once");
  add(undecided, "is undecided", "are undecided");
  add(open, "was not measured", "were not measured");
  return fmt::format("{}.", fmt::join(parts, "; "));
}

Verdict lockstepState(const LockstepRow& row, const LockstepRules& rules) {
  const bool open = row.verdict == Equivalence::differs && !openInLaw(row, rules).empty();
  return open ? Verdict::borderline : verdictOf(row.verdict);
}

OverviewCell lockstepCell(const LockstepRow* row, const LockstepRules& rules, bool isMirror) {
  if (!row)
    return {isMirror ? Verdict::notApplicable : Verdict::notMeasured,       {}, "%", {},
            isMirror ? "is a mirror itself" : "not compared with a mirror", {}};
  OverviewCell cell{lockstepState(*row, rules), {}, "%", {}, {}, evidence};
  if (row->verdict == Equivalence::notMeasured) {
    cell.words = row->reason;
    return cell;
  }
  cell.words = verdictWord(row->verdict);
  if (row->verdict == Equivalence::undecided) cell.words += ": " + row->reason;
  if (row->verdict == Equivalence::differs && cell.verdict == Verdict::borderline)
    cell.words = "differs only where the law leaves the order of impacts open";
  // What would just have shown is what can be said of an engine that stays within its rounding.
  const bool bounded = row->verdict == Equivalence::sameToPrecision;
  const auto size = bounded ? row->resolution : row->equivalent;
  if (!size) return cell;
  cell.value = 100.0 * *size;
  // A percentage of the constant is a statement on it: only where it explains the difference.
  const bool explains =
      row->term && row->term->name == rules.referencePerturbation && row->term->amount;
  if (bounded || explains) {
    const double share = bounded ? *size : std::abs(*row->term->amount);
    cell.value = 100.0 * share;
    cell.shown = fmt::format("{}{} of {}", bounded ? "below " : "",
                             share > 1.0 ? "more than all" : percentText(share),
                             plainSymbol(rules.referencePerturbation));
  } else {
    cell.shown = fmt::format("{} × limit", readable(*size / rules.sameLaw));
  }
  return cell;
}

Overview lockstepOverview(const LockstepResults& results) {
  const LockstepFindings& findings = results.lockstep;
  Overview overview;
  overview.columns = {
      {"law verified",
       "Does it have the law that it declares? Its difference from its mirror, in units of the "
       "limit: of what a change of the reference constant by 0.1 % does.",
       evidence},
      {"forces", "Largest difference of a contact's force on one state.", evidence},
      {"early", "Largest difference from its mirror at the first snapshot, in diameters.",
       "over-time"},
      {"late", "Largest difference from its mirror at the last snapshot, in diameters.",
       "over-time"},
      {"deviation found", "The single change of the mirror that leaves least of the difference.",
       evidence}};
  for (const LockstepRow& row : findings.rows)
    overview.rows.push_back(
        {row.engine,
         true,
         {lockstepCell(&row, findings.rules, false), forcesCell(row), separationCell(row, false),
          separationCell(row, true), termCell(row)}});
  overview.conclusion = nonEmpty({leadOf(findings), deviationOf(findings), nextOf(findings)});
  return overview;
}

}  // namespace crossgrain::reports
