#include "reports/regression/regression.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"
#include "reports/lockstep/report.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {
namespace {

/// Quantities and fields that are printed one by one; the JSON has all of them.
constexpr std::size_t mostQuantities = 6, mostFields = 12;

std::string orNothing(const std::string& text) {
  return text.empty() ? "nothing" : text;
}

std::string withVersion(const std::string& engine, const std::string& version) {
  return version.empty() ? engine : fmt::format("{} ({})", engine, version);
}

std::string windowsText(const DiffRow& row, const LockstepRules& rules) {
  const LockstepRow& windows = *row.windows;
  std::string text =
      fmt::format("  from {} starts, largest distance of a disk from before:\n", windows.starts);
  for (const LockstepSeparation& at : windows.separations) {
    text += fmt::format("    after {:>7} {:>12} d", fmt::format("{} ms", readable(1e3 * at.time)),
                        readable(at.largest));
    if (at.equivalent && at.largest > 0.0)
      text += fmt::format(", {} times what the limit, {} of {}, moves it",
                          readable(*at.equivalent / rules.sameLaw), percentText(rules.sameLaw),
                          constantSymbol(rules.referencePerturbation));
    text += '\n';
  }
  if (const std::string reading = describeReading(windows, rules); !reading.empty())
    text += fmt::format("  {}\n", reading);
  if (const std::string first = describeFirst(windows); !first.empty())
    text += fmt::format("  first beyond {} d: {}\n", readableSetting(rules.rounding), first);
  if (const std::string term = describeTerm(windows); !term.empty())
    text += fmt::format("  deviation found: {}\n", term);
  else if (windows.verdict == Equivalence::differs)
    text += row.mirrored ? "  deviation found: none: no single change of the mirror does that\n"
                         : "  deviation found: none: there is no mirror of it in this scene\n";
  return text;
}

std::string collisionsText(const DiffRow& row) {
  std::string text =
      fmt::format("  collisions, {} {}: {}\n", row.sweeps, verb(row.sweeps, "sweep", "sweeps"),
                  spaced(nameOf(row.collisionsVerdict)));
  for (std::size_t k = 0; k < std::min(row.collisions.size(), mostQuantities); ++k) {
    const CollisionChange& change = row.collisions[k];
    text += fmt::format(
        "    {:<24} {} of {} changed, most by {} ({} of the largest) at psi_i {}, v_n {} m/s{}\n",
        change.quantity, change.changed, change.points, readable(change.largest),
        percentText(change.relative), readable(change.psi), readable(change.vn),
        change.variant.empty() ? "" : ", " + change.variant);
  }
  if (row.collisions.size() > mostQuantities)
    text += fmt::format("    … and {} more changed\n", row.collisions.size() - mostQuantities);
  return text;
}

std::string rowText(const DiffRow& row, const LockstepRules& rules) {
  std::string text = fmt::format("{} against {}: {}\n", withVersion(row.engine, row.version),
                                 withVersion(row.before, row.versionBefore), describe(row, rules));
  if (!row.reason.empty()) text += fmt::format("  {}\n", row.reason);
  for (const DeclaredChange& change : row.declared)
    text += fmt::format("  declaration changed: {}: {} → {}\n", change.name,
                        orNothing(change.before), orNothing(change.now));
  if (row.windows && row.windowsVerdict != Equivalence::sameBits) text += windowsText(row, rules);
  if (row.forcesVerdict == Equivalence::differs)
    text += fmt::format(
        "  reported forces of the same states: of contacts by {} of the largest along the normal, "
        "{} across; on walls by {}\n",
        percentText(row.forces->normal), percentText(row.forces->tangential),
        percentText(row.forces->walls));
  if (row.sweeps > 0 && row.collisionsVerdict != Equivalence::sameBits) text += collisionsText(row);
  if (row.endpoints.empty()) return text;
  text += fmt::format("  averages from {} starts:\n", row.windows->starts);
  for (const EndpointRow& endpoint : row.endpoints)
    text += fmt::format("    {:<24} {}\n", endpoint.endpoint, describeAnswer(endpoint));
  return text;
}

OverviewCell windowsCell(const DiffRow& row, const LockstepRules& rules) {
  if (row.forcesVerdict == Equivalence::differs && row.windowsVerdict != Equivalence::differs) {
    const double most = std::max({row.forces->normal, row.forces->tangential, row.forces->walls});
    return {Verdict::fail, 100.0 * most, "%", percentText(most), "reported forces", {}};
  }
  OverviewCell cell{verdictOf(row.windowsVerdict), {}, "%", {}, {}, {}};
  if (cell.verdict == Verdict::notMeasured) return cell;
  cell.words = spaced(nameOf(row.windowsVerdict));
  if (row.windowsVerdict == Equivalence::sameBits) {
    cell.value = 0.0;
    cell.shown = "same bits";
  } else if (row.windows && row.windows->equivalent) {
    const OverviewCell windows = lockstepCell(&*row.windows, rules, false);
    cell.value = windows.value;
    cell.shown = windows.shown;
  }
  return cell;
}

OverviewCell collisionsCell(const DiffRow& row) {
  OverviewCell cell{verdictOf(row.collisionsVerdict), {}, "%", {}, {}, {}};
  if (cell.verdict == Verdict::notMeasured) return cell;
  if (row.collisions.empty()) {
    cell.value = 0.0;
    cell.shown = "same bits";
    return cell;
  }
  const auto worst = std::ranges::max_element(row.collisions, {}, &CollisionChange::relative);
  cell.value = 100.0 * worst->relative;
  cell.shown = percentText(worst->relative);
  cell.words = spaced(worst->quantity);
  return cell;
}

OverviewCell averagesCell(const DiffRow& row) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& endpoint : row.endpoints) rows.push_back(&endpoint);
  const EndpointRow* worst = worstOf(rows);
  if (!worst) return {Verdict::notMeasured, {}, "margins", {}, {}, {}};
  return endpointCell(*worst, false);
}

OverviewCell declaredCell(const DiffRow& row) {
  const std::size_t count = row.declared.size();
  return {std::nullopt,
          static_cast<double>(count),
          "changes",
          fmt::format("{}", count),
          count > 0 ? row.declared.front().name : "",
          {}};
}

std::string listText(const std::vector<AnswerDifference>& differences) {
  std::string text;
  for (std::size_t k = 0; k < std::min(differences.size(), mostFields); ++k) {
    const AnswerDifference& each = differences[k];
    text += fmt::format("  {}{}: then {}, now {}", each.field, each.place, each.then, each.now);
    if (each.off) text += fmt::format(", differs by {:.3g}", *each.off);
    if (each.of > 1) text += fmt::format("; {} of {} differ, none by more", each.differ, each.of);
    text += '\n';
  }
  if (differences.size() > mostFields)
    text += fmt::format("  and {} more\n", differences.size() - mostFields);
  return text;
}

}  // namespace

std::string describe(const DiffRow& row, const LockstepRules& rules) {
  if (row.verdict != Equivalence::differs) return spaced(nameOf(row.verdict));
  if (row.windowsVerdict == Equivalence::differs) return describeVerdict(*row.windows, rules);
  if (row.forcesVerdict == Equivalence::differs) return "differs in reported forces";
  if (row.collisionsVerdict == Equivalence::differs)
    return row.windows ? "differs in collisions" : "differs";
  return "differs in averages";
}

std::string diffText(const DiffResults& results) {
  std::string text =
      fmt::format("{}: {}, {} starts, kept by crossgrain {}\n", results.baseline,
                  results.head.setup.name, results.starts.size(), results.baselineVersion);
  for (const std::string& key : results.changedKeys) text += fmt::format("case changed: {}\n", key);
  for (const DiffRow& row : results.rows) text += rowText(row, results.rules);
  return text;
}

Overview diffOverview(const DiffResults& results) {
  Overview overview;
  overview.columns = {
      {"windows", "Side by side with what was kept, step by step.", ""},
      {"collisions", "The quantity of two-particle collisions that changed most.", ""},
      {"averages", "The endpoint of whole runs that says most, in margins.", ""},
      {"declared", "What the engine declares otherwise than it did.", ""}};
  SaidOf verdicts, terms;
  Names differ;
  for (const DiffRow& row : results.rows) {
    overview.rows.push_back({row.engine,
                             true,
                             {windowsCell(row, results.rules), collisionsCell(row),
                              averagesCell(row), declaredCell(row)}});
    verdicts.add(row.engine, describe(row, results.rules));
    if (row.verdict != Equivalence::differs) continue;
    differ.push_back(row.engine);
    if (row.windows && row.windows->term)
      terms.add(row.engine, constantWords(row.windows->term->name));
  }
  if (results.rows.empty()) return overview;
  overview.conclusion = {verdicts.joined("{}: {}") + "."};
  if (const std::string sentence = terms.joined("{}: {}"); !sentence.empty())
    overview.conclusion.push_back("The change that explains most of the difference: " + sentence +
                                  ".");
  if (!differ.empty())
    overview.conclusion.push_back(
        fmt::format("Next: where the change of {} is meant, keep a new baseline.", listed(differ)));
  return overview;
}

std::string replayText(const ReplayResults& found) {
  std::string text =
      fmt::format("{} {}: requests of {}, recorded with {} {}{}\n", found.engine, found.version,
                  found.caseName, found.recordedEngine, found.recordedVersion,
                  found.recordedStamp.empty() ? "" : " (" + found.recordedStamp + ")");
  if (!found.declared.empty()) text += "declaration changed:\n" + listText(found.declared);
  if (!found.request.empty())
    text += fmt::format("request {}, {}, has the first different answer:\n{}", found.asked,
                        found.request, listText(found.differences));
  else if (found.failure.empty())
    text += fmt::format("same answers to {} {} requests\n",
                        found.declared.empty() ? "all" : "all others of", found.asked);
  else
    text += fmt::format("same answers as far as request {}, where it fails\n", found.asked);
  return text;
}

}  // namespace crossgrain::reports
