#include "reports/lockstep/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/common/blocks.hpp"
#include "reports/common/causes.hpp"
#include "reports/common/engines.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

/// A difference only where the law leaves the order of impacts open is borderline.
Verdict lockstepState(const LockstepRow& row, const LockstepRules& rules) {
  const bool open = row.verdict == Equivalence::differs && !openInLaw(row, rules).empty();
  return open ? Verdict::borderline : verdictOf(row.verdict);
}

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
  Names parts;
  for (const LockstepRow& row : findings.rows)
    if (lockstepState(row, findings.rules) == Verdict::fail)
      parts.push_back(fmt::format(
          "{}: {}", row.engine,
          row.term ? constantWords(row.term->name) : "no single constant, convention or effect"));
  if (parts.empty()) return {};
  return fmt::format("Deviation found: {}.", listedShortly(parts, 3));
}

std::string nextOf(const LockstepFindings& findings) {
  Names differ, unmeasured, undecided;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == Equivalence::undecided) undecided.push_back(row.engine);
    if (lockstepState(row, findings.rules) == Verdict::fail) differ.push_back(row.engine);
    if (row.verdict == Equivalence::notMeasured) unmeasured.push_back(row.engine);
  }
  if (!differ.empty())
    return fmt::format("Next: see the first contact at which {} {}, in the report.", listed(differ),
                       differ.size() == 1 ? "differs" : "differ");
  if (!undecided.empty())
    return fmt::format("Next: more starts for {}, e.g. --starts {}.", listed(undecided),
                       4 * findings.starts.size());
  if (unmeasured.size() == findings.rows.size())
    return "Next: a scene whose contacts have a mirror; the reasons are in the report.";
  return "Next: compare the averages; a fault that begins later than these windows is not seen "
         "here.";
}

using Number = std::optional<double>;

std::string orDash(std::string words) {
  return words.empty() ? absentText : words;
}

std::string forcesInWords(const LockstepRow& row) {
  if (!row.forces) return absentText;
  const LockstepForces& forces = *row.forces;
  std::string words =
      fmt::format("normal {}, tangential {}", readable(forces.normal), readable(forces.tangential));
  if (forces.missing + forces.extra > 0)
    words += fmt::format("; {} missing, {} too many of {}", forces.missing, forces.extra,
                         readableCount(static_cast<double>(forces.contacts)));
  return words;
}

Table verdictTable(const LockstepFindings& findings) {
  Table table{{engineNames("engine"), "verdict", numbers("ε_eq"),
               "forces of the first step differ by", "deviation found"}};
  for (const LockstepRow& row : findings.rows)
    table.rows.push_back({{row.engine,
                           {describeVerdict(row, findings.rules),
                            {row.reason, describeResolution(row, findings.rules),
                             describeReading(row, findings.rules)},
                            lockstepState(row, findings.rules),
                            true},
                           readable(row.equivalent),
                           forcesInWords(row),
                           orDash(describeTerm(row))}});
  return table;
}

/// The largest difference of each engine that was measured, at each time.
Table timeTable(const LockstepFindings& findings) {
  Table table{{engineNames("engine")}};
  for (const LockstepRow& row : findings.rows) {
    if (row.separations.empty()) continue;
    if (table.rows.empty())
      for (const LockstepSeparation& at : row.separations)
        table.columns.push_back(numbers(fmt::format("after {} ms", readable(1e3 * at.time))));
    TableRow line{{row.engine}};
    for (const LockstepSeparation& at : row.separations)
      line.cells.emplace_back(readable(at.largest));
    table.rows.push_back(std::move(line));
  }
  return table;
}

Table contactTable(const LockstepFindings& findings) {
  Table table{{engineNames("engine")}};
  for (const char* name : {"starts", "sticking", "sliding", "new", "opening", "at a wall"})
    table.columns.push_back(numbers(name));
  table.columns.emplace_back("first difference beyond rounding");
  for (const LockstepRow& row : findings.rows) {
    const ContactKinds& kinds = row.kinds;
    TableRow line{{row.engine, readableCount(static_cast<double>(row.starts))}};
    for (const std::size_t count :
         {kinds.sticking, kinds.sliding, kinds.made, kinds.opened, kinds.wall})
      line.cells.push_back(row.starts > 0 ? readableCount(static_cast<double>(count)) : absentText);
    line.cells.push_back({orDash(describeFirst(row)), {openInLaw(row, findings.rules)}});
    table.rows.push_back(std::move(line));
  }
  return table;
}

/// Differences of the engines' laws from the case's: when each acts, and how much of the divergence
/// it makes.
Table causeTable(const LockstepFindings& findings) {
  Table table{{engineNames("engine"), "difference", numbers("first step"), numbers("starts")}};
  bool any = false;
  for (const LockstepRow& row : findings.rows) {
    if (!row.causes || row.causes->parts.empty()) continue;
    const LockstepCauses& causes = *row.causes;
    if (!std::exchange(any, true))
      for (const double time : causes.time)
        table.columns.push_back(numbers(fmt::format("part after {} ms [%]", readable(1e3 * time))));
    const auto add = [&](const std::string& name, const std::string& step, const Numbers& parts) {
      TableRow line{{row.engine, name, step, readableCount(static_cast<double>(causes.starts))}};
      for (const auto& part : parts)
        line.cells.push_back(part ? fmt::format("{:.1f}", 100.0 * *part) : absentText);
      table.rows.push_back(std::move(line));
    };
    for (std::size_t k = 0; k < causes.parts.size(); ++k)
      add(differenceWords(causes.differences[k]),
          causes.firstStep[k] ? readableCount(static_cast<double>(*causes.firstStep[k]))
                              : absentText,
          causes.parts[k]);
    if (causes.mixtures == Mixtures::bothEnds) add("interaction", absentText, causes.interaction);
  }
  table.note =
      "First step: after which the in-house engine with that difference alone has moved a disk by "
      "more than rounding. Parts: of the divergence of an engine's mirror from the in-house engine "
      "under the case's law, in the same steps, by runs under mixtures of both laws; they add up "
      "to "
      "100 %.";
  return table;
}

/// Whole decades, from the smallest positive point or the level to the largest.
Range decadesOf(const Panel& panel) {
  double low = *panel.level, high = *panel.level;
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points)
      if (point.y > 0.0) {
        low = std::min(low, point.y);
        high = std::max(high, point.y);
      }
  return {std::pow(10.0, std::floor(std::log10(low))), std::pow(10.0, std::ceil(std::log10(high)))};
}

/// A number of the differences over time, as a dashed grey curve; no points where it has none.
Curve greyCurve(const LockstepRow& row, const std::string& name, int mark, double width,
                std::optional<double> LockstepSeparation::*number) {
  Curve curve{name, {"#808080", mark, true}, Draw::linesAndPoints, {}, width};
  for (const LockstepSeparation& at : row.separations)
    if (at.*number) curve.points.push_back({at.time, *(at.*number), {}});
  return curve;
}

std::vector<Figure> lockstepFigures(const LockstepResults& results) {
  const std::vector<LineStyle> styles = engineStyles(results.engines);
  const LockstepRules& rules = results.lockstep.rules;
  Panel panel;
  panel.xLabel = "time since the start [s]";
  panel.yLabel = "largest difference from the mirror [d]";
  panel.logX = panel.logY = true;
  panel.level = rules.rounding;
  Curve referencePerturbation;
  std::string ofRounding = "rounding of the engine's precision";  // the first one names them all
  for (const LockstepRow& row : results.lockstep.rows) {
    const auto engine = std::ranges::find(results.engines, row.engine, &EngineRow::name);
    if (engine == results.engines.end() || row.track.empty()) continue;
    Curve curve{row.engine,
                styles[static_cast<std::size_t>(engine - results.engines.begin())],
                Draw::lines,
                {},
                2.0};
    for (std::size_t k = 0; k < std::min(row.track.size(), row.trackTime.size()); ++k)
      curve.points.push_back({row.trackTime[k], row.track[k], {}});
    panel.curves.push_back(std::move(curve));
    Curve rounding = greyCurve(row, ofRounding, 3, 1.0, &LockstepSeparation::rounding);
    if (!rounding.points.empty()) {
      panel.curves.push_back(std::move(rounding));
      ofRounding.clear();
    }
    if (referencePerturbation.points.empty())
      referencePerturbation = greyCurve(
          row,
          fmt::format("mirror with {} +{:g} %", constantSymbol(rules.referencePerturbation),
                      100.0 * rules.referenceChange),
          2, 1.5, &LockstepSeparation::referencePerturbation);
  }
  if (!referencePerturbation.points.empty())
    panel.curves.push_back(std::move(referencePerturbation));
  if (!hasPoints(panel)) return {};
  panel.yRange = decadesOf(panel);
  Figure figure{"lockstep_separation",
                "Difference of each engine from its mirror, over time",
                "The disk of all starts that is farthest from the mirror's; an engine whose "
                "positions are its mirror's to the bit has no line. Thin: what counts as rounding "
                "of double precision. Grey: what a known change of the law does, and what rounding "
                "to another precision may do, the medians over the starts.",
                {panel}};
  figure.panelWidth = 760;
  figure.png = true;
  return {figure};
}

std::string lockstepLine(const LockstepRow& row, const LockstepSeparation* at) {
  const auto of = [](const auto& part, auto member) {
    return part ? Number(static_cast<double>((*part).*member)) : Number();
  };
  const bool measured = row.starts > 0;
  const auto count = [&](std::size_t value) {
    return measured ? Number(static_cast<double>(value)) : Number();
  };
  const Number partner =
      row.first && row.first->partner ? Number(static_cast<double>(*row.first->partner)) : Number();
  return reports::row(
      row.engine, std::string(nameOf(row.verdict)), row.equivalent,
      at ? Number(at->time) : Number(), at ? Number(at->median) : Number(),
      at ? Number(at->largest) : Number(), at ? at->referencePerturbation : Number(),
      at ? at->equivalent : Number(), row.starts, count(row.kinds.sticking),
      count(row.kinds.sliding), count(row.kinds.made), count(row.kinds.opened),
      count(row.kinds.wall), of(row.first, &FirstExceedance::after),
      of(row.first, &FirstExceedance::until), of(row.first, &FirstExceedance::disk), partner,
      row.first ? row.first->contact : "", of(row.forces, &LockstepForces::missing),
      of(row.forces, &LockstepForces::extra), of(row.forces, &LockstepForces::normal),
      of(row.forces, &LockstepForces::tangential), row.term ? row.term->name : "",
      row.term ? row.term->amount : Number(), of(row.term, &NamedTerm::unexplained),
      row.failure.empty() ? row.reason : row.failure, measured ? Number(row.wallSeconds) : Number(),
      row.equivalentLow, row.equivalentHigh, count(row.read), count(row.beyond), row.shareHigh);
}

/// One row for each engine and time; an engine that was not measured is one row.
std::string lockstepCsv(const LockstepResults& results) {
  std::string table =
      "engine,verdict,equivalent,time_s,median_d,largest_d,yardstick_d,equivalent_then,starts,"
      "sticking,sliding,new,opening,wall,first_after_s,first_until_s,first_disk,first_partner,"
      "first_contact,forces_missing,forces_extra,normal_force_difference,tangential_force_"
      "difference,term,term_amount,term_unexplained,reason,wall_s,equivalent_low,equivalent_high,"
      "read,beyond,share_high\n";
  for (const LockstepRow& row : results.lockstep.rows) {
    for (const LockstepSeparation& at : row.separations) table += lockstepLine(row, &at);
    if (row.separations.empty()) table += lockstepLine(row, nullptr);
  }
  return table;
}

/// An engine per row: its law, forces on one state, differences early and late, the deviation
/// found.
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

}  // namespace

std::string leadOf(const LockstepFindings& findings) {
  Names same, differ, ordered, open, undecided, own;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == Equivalence::notMeasured)
      (row.engine == inHouse() ? own : open).push_back(row.engine);
    else if (row.verdict == Equivalence::undecided)
      undecided.push_back(row.engine);
    else if (row.verdict == Equivalence::differs && !openInLaw(row, findings.rules).empty())
      ordered.push_back(row.engine);
    else
      (row.verdict == Equivalence::differs ? differ : same).push_back(row.engine);
  }
  if (same.empty() && differ.empty() && ordered.empty() && undecided.empty())
    return "Nothing was measured.";
  Names parts;
  const auto add = [&](const Names& names, const char* one, const char* many) {
    if (!names.empty())
      parts.push_back(fmt::format("{} {}", listed(names), names.size() == 1 ? one : many));
  };
  add(same, "follows the law that it declares", "follow the laws that they declare");
  add(differ, "follows another law than it declares", "follow other laws than they declare");
  add(ordered, "differs from its mirror where disks touch several at once",
      "differ from their mirrors where disks touch several at once");
  add(undecided, "is undecided", "are undecided");
  add(open, "was not measured", "were not measured");
  add(own, "is the in-house engine, its own mirror", "");
  return fmt::format("{}.", fmt::join(parts, "; "));
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
  // The smallest deviation that would have shown is what can be said of an engine that stays within
  // its rounding.
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

Blocks lockstepTables(const LockstepFindings& findings) {
  Blocks blocks = {
      verdictTable(findings),
      Details{"Contacts in the windows, and the first difference", {contactTable(findings)}}};
  if (Table times = timeTable(findings); !times.rows.empty())
    blocks.push_back(Details{"Largest difference over time [d]", {std::move(times)}});
  if (Table causes = causeTable(findings); !causes.rows.empty())
    blocks.push_back(Details{"Which convention acts first", {std::move(causes)}});
  return blocks;
}

List lockstepReading(const LockstepFindings& findings) {
  const LockstepRules& rules = findings.rules;
  const std::string referencePerturbation = constantSymbol(rules.referencePerturbation);
  return {
      {{"The mirror",
        fmt::format("the in-house engine with the conventions that an engine declares, on the "
                    "scene that this engine runs, without effects that it lacks and with its time "
                    "step. Both start from the same bits, {} times along the flow, with relaxed "
                    "springs. What remains as a difference is no convention.",
                    std::max<std::size_t>(findings.starts.size(), 1))},
       {"ε_eq of a start",
        fmt::format(
            "the change of {} that would move the mirror as far: the root mean square difference "
            "over that of what a change by 1 does. It is read only where disks answer in "
            "proportion to four changes (±{} % and a tenth of it, alike per unit of change to a "
            "factor of 2, and below 0.01 d), and only at times at which half of those that move "
            "do: contacts that are made or broken a step apart separate any two runs. The largest "
            "over those times is the start's; the table has the median over starts with its 95 % "
            "interval. Where disks touch nothing, the mirror has no answer, and a motion that "
            "differs by 10⁻⁶ d is beyond the limit.",
            referencePerturbation, readableSetting(100.0 * rules.referenceChange))},
       {"Verdicts",
        fmt::format(
            "identical to rounding: no disk ever differs by {} d. Identical to its precision: the "
            "engine declares single precision, and no disk differs by more than rounding in every "
            "step may do: 1 + n times what one rounding of the start does to the mirror within n "
            "steps. Differs: ε_eq is beyond {} % from a share of starts that is shown to be above "
            "{} % (exact bound at 95 %), which a right engine may reach by chance. Equivalent: "
            "from no start, or from a share shown to be below that. Else undecided. So more starts "
            "narrow what is undecided, and no single start decides. The share of all states that "
            "these starts do not exclude is given.",
            readableSetting(rules.rounding), readableSetting(100.0 * rules.sameLaw),
            readableSetting(100.0 * rules.strayShare))},
       {"Deviation found",
        fmt::format(
            "every constant, convention and effect of the mirror was changed in turn, and those "
            "constants that explain most were tried with the amount that fits. One is named only "
            "where the mirror that has it leaves less than a fifth of the difference. Only where "
            "that is {0} itself is the difference given as a change of {0}.",
            referencePerturbation)},
       {"Forces",
        "compared on one state, before any disk has moved otherwise, in units of the largest "
        "normal force. Contacts are counted once a window and kind."},
       {"Limit", "a fault that begins later than the windows is not seen; a full run sees it."}}};
}

Report reportOf(const LockstepResults& results) {
  Report report{{results.head, results.engines, lockstepOverview(results)}, results.elapsed};
  report.notes = results.notes;
  std::vector<EffectiveScene> effective;
  for (const LockstepRow& row : results.lockstep.rows)
    if (row.effective) effective.push_back({row.engine, &*row.effective, &results.effects});
  report.figures = lockstepFigures(results);
  report.section("over-time", "Difference from the mirror over time", "Over time").blocks = {
      drawingsOf(report.figures, "lockstep_")};
  report.section("lockstep", "Engines and their mirrors").blocks = lockstepTables(results.lockstep);
  report.section("reading", "How to read it").blocks = {lockstepReading(results.lockstep)};
  addDetails(report, effective);
  addPackings(report, results.packings);
  report.foldAllBut({"over-time", "lockstep"});
  report.tables = {{"lockstep.csv", lockstepCsv(results)}};
  report.checks = matrixChecks(report);
  return report;
}

}  // namespace crossgrain::reports
