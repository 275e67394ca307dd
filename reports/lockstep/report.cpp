#include "reports/lockstep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sections.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

using Kind = Column::Kind;
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
  Table table{{{"engine", Kind::engines}, "verdict", {"ε_eq", Kind::number}}, {}};
  std::size_t times = 0;
  for (const LockstepRow& row : findings.rows)
    if (times == 0)
      for (const LockstepSeparation& at : row.separations) {
        table.columns.emplace_back(
            fmt::format("largest difference after {} ms [d]", readable(1e3 * at.time)),
            Kind::number);
        ++times;
      }
  table.columns.emplace_back("forces of the first step differ by");
  table.columns.emplace_back("deviation found");
  for (const LockstepRow& row : findings.rows) {
    TableRow line{{row.engine,
                   {describeVerdict(row, findings.rules),
                    {row.reason, describeResolution(row, findings.rules),
                     describeReading(row, findings.rules)},
                    lockstepState(row, findings.rules),
                    true},
                   readable(row.equivalent)}};
    for (std::size_t k = 0; k < times; ++k)
      line.cells.push_back(k < row.separations.size() ? readable(row.separations[k].largest)
                                                      : absentText);
    line.cells.push_back(forcesInWords(row));
    line.cells.push_back(orDash(describeTerm(row)));
    table.rows.push_back(std::move(line));
  }
  return table;
}

Table contactTable(const LockstepFindings& findings) {
  Table table{{{"engine", Kind::engines}}, {}};
  for (const char* name : {"starts", "sticking", "sliding", "new", "opening", "at a wall"})
    table.columns.emplace_back(name, Kind::number);
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
    Curve rounding =
        greyCurve(row, "rounding of " + row.engine, 3, 1.0, &LockstepSeparation::rounding);
    if (!rounding.points.empty()) panel.curves.push_back(std::move(rounding));
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
      "first_contact,forces_missing,forces_extra,normal_force_difference,"
      "tangential_force_difference,term,term_amount,term_unexplained,reason,wall_s,"
      "equivalent_low,equivalent_high,read,beyond,share_high\n";
  for (const LockstepRow& row : results.lockstep.rows) {
    for (const LockstepSeparation& at : row.separations) table += lockstepLine(row, &at);
    if (row.separations.empty()) table += lockstepLine(row, nullptr);
  }
  return table;
}

}  // namespace

Blocks lockstepTables(const LockstepFindings& findings) {
  return {verdictTable(findings),
          Details{"Contacts in the windows, and the first difference", {contactTable(findings)}}};
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
        fmt::format("the change of {} that would move the mirror as far: the root mean square "
                    "difference over that of what a change by 1 does. It is read only where disks "
                    "answer in proportion to four changes (±{} % and a tenth of it, alike per unit "
                    "of change to a factor of 2, and below 0.01 d), and only at times at which "
                    "half of those that move do: contacts that are made or broken a step apart "
                    "separate any two runs. The largest over those times is the start's; the table "
                    "has the median over starts with its 95 % interval. Where disks touch nothing, "
                    "the mirror has no answer, and a motion that differs by 10⁻⁶ d is beyond the "
                    "limit.",
                    referencePerturbation, readableSetting(100.0 * rules.referenceChange))},
       {"Verdicts",
        fmt::format(
            "identical to rounding: no disk ever differs by {} d. Identical to its precision: "
            "the engine declares single precision, and no disk differs by more than rounding in "
            "every step may do: 1 + n times what one rounding of the start does to the mirror "
            "within n steps. Differs: ε_eq is beyond {} % from a share of starts that is shown to "
            "be above {} % (exact bound at 95 %), which a right engine may reach by chance. "
            "Equivalent: from no start, or from a share shown to be below that. Else undecided. So "
            "more starts narrow what is undecided, and no single start decides. The share of all "
            "states that these starts do not exclude is given.",
            readableSetting(rules.rounding), readableSetting(100.0 * rules.sameLaw),
            readableSetting(100.0 * rules.strayShare))},
       {"Deviation found",
        fmt::format(
            "every constant, convention and effect of the mirror was changed in turn, and "
            "those constants that explain most were tried with the amount that fits. One is "
            "named only where the mirror that has it leaves less than a fifth of the "
            "difference. Only where that is {0} itself is the difference given as a change "
            "of {0}.",
            referencePerturbation)},
       {"Forces",
        "compared on one state, before any disk has moved otherwise, in units of the largest "
        "normal force. Contacts are counted once a window and kind."},
       {"Limit", "a fault that begins later than the windows is not seen; a full run sees it."}}};
}

Report reportOf(const LockstepResults& results) {
  Report report{{results.head, results.engines, lockstepOverview(results)}};
  report.elapsed = results.elapsed;
  report.notes = results.notes;
  std::vector<EffectiveScene> effective;
  for (const LockstepRow& row : results.lockstep.rows)
    if (row.effective) effective.push_back({row.engine, &*row.effective, &results.effects});
  report.figures = lockstepFigures(results);
  report.section("lockstep", "Engines and their mirrors").blocks = lockstepTables(results.lockstep);
  report.section("over-time", "Over time").blocks = {drawingsOf(report.figures, "lockstep_")};
  report.section("reading", "How to read it").blocks = {lockstepReading(results.lockstep)};
  addDetails(report, effective);
  addPackings(report, results.packings);
  report.tables = {{"lockstep.csv", lockstepCsv(results)}};
  report.checks = matrixChecks(report);
  return report;
}

}  // namespace crossgrain::reports
