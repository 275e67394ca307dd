// The regime map: in what state packings are over volume fractions and rotations, as a table and
// as figures that the thesis has not, of the reference engine.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "averaging/regime.hpp"
#include "averaging/transition_density.hpp"
#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/drawing.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

using Maybe = std::optional<double>;

/// After so many rotations states are reported; 8 is the thesis' longest run.
constexpr int mapRotations[] = {1, 2, 5, 8, 10, 20};
/// A critical ν̄ further outside of the packings' than half of Table 3.2's span is an extrapolation,
/// no figure: as the claim about it is judged.
constexpr double farthestCritical = 0.02;
constexpr Range densityAxis{0.785, 0.83};

/// One engine's finished runs of one interpretation, one rate and the thesis' law, whatever family
/// of cases they are of.
struct StateGroup {
  std::string label;              ///< "default, Ω = 0.1 /s", "wall spacing 7 mm, Ω = 0.1 /s"
  std::vector<CaseRun> runs;      ///< all
  std::vector<CaseRun> packings;  ///< the longest run of each packing
};

/// Packings of one group and ν̄ in the rotation that ends then; of those that were followed so far.
struct StateRow {
  double nu = 0.0;  ///< as Table 3.2 has it
  int rotations = 0;
  int packings = 0, carry = 0;  ///< carry: the wheel has a contact or more on average
  MeanOfRuns contacts;          ///< of the wheel's disks, at a time
  MeanOfRuns pressure;          ///< on the outer ring [N/m²]
};

/// All packings of a group.
struct CriticalRow {
  int rotations = 0;
  int packings = 0, carry = 0;
  std::optional<TransitionDensity> critical;  ///< absent: none follows
};

std::string groupLabel(const CaseSettings& of, const CaseSettings& reference) {
  std::string label;
  for (const OpenChoice& open : openChoices)
    if (!sameSetting(of.*open.value, reference.*open.value)) label += describe(open, of) + ", ";
  if (label.empty()) label = "default, ";
  return label + describeRate(of);
}

/// The reference case's interpretation and rate first, the others as their cases come.
std::vector<StateGroup> stateGroups(const ThesisResults& results, const std::string& engine) {
  std::vector<StateGroup> groups;
  const ThesisCase* const first = referenceCase(results);
  if (!first) return groups;
  const CaseSettings reference = settingsOf(*first);
  groups.push_back({groupLabel(reference, reference), {}, {}});
  for (const ThesisCase& setup : results.cases) {
    const CaseSettings own = settingsOf(setup);
    if (!sameLaw(own, reference)) continue;
    const std::string label = groupLabel(own, reference);
    auto group = std::ranges::find(groups, label, &StateGroup::label);
    if (group == groups.end()) group = groups.insert(groups.end(), {label, {}, {}});
    for (const CaseRun& at : finishedRuns(results, setup, engine)) group->runs.push_back(at);
  }
  for (StateGroup& group : groups) group.packings = longestOfEachPacking(group.runs);
  std::erase_if(groups, [](const StateGroup& group) { return group.runs.empty(); });
  return groups;
}

bool carries(const ThesisSpan& span) {
  return span.wheelContacts && *span.wheelContacts >= fewestWheelContacts;
}

/// By ν̄, then by rotations.
std::vector<StateRow> stateRows(const StateGroup& group) {
  struct Seen {
    std::vector<Maybe> contacts, pressure;
    int carry = 0;
  };
  std::map<std::pair<long, int>, Seen> seen;  // by ν̄ in thousandths
  for (const CaseRun& at : group.packings)
    for (const int rotations : mapRotations) {
      const ThesisSpan* const span = spanAt(*at.run, rotations);
      if (!span || !span->wheelContacts) continue;
      Seen& own = seen[{std::lround(1e3 * at.setup->label), rotations}];
      own.contacts.push_back(span->wheelContacts);
      own.pressure.push_back(span->outerPressure);
      own.carry += carries(*span);
    }
  std::vector<StateRow> rows;
  for (const auto& [key, own] : seen)
    rows.push_back({1e-3 * static_cast<double>(key.first), key.second,
                    static_cast<int>(own.contacts.size()), own.carry, meanOfRuns(own.contacts),
                    meanOfRuns(own.pressure)});
  return rows;
}

std::vector<CriticalRow> criticalRows(const StateGroup& group) {
  std::vector<CriticalRow> rows;
  for (const int rotations : mapRotations) {
    std::vector<LoadState> packings;
    for (const CaseRun& at : group.packings)
      if (const ThesisSpan* const span = spanAt(*at.run, rotations); span && span->wheelContacts)
        packings.push_back({at.setup->label, carries(*span)});
    if (packings.empty()) continue;
    rows.push_back({rotations, static_cast<int>(packings.size()),
                    static_cast<int>(std::ranges::count_if(packings, &LoadState::carries)),
                    transitionDensity(packings, farthestCritical)});
  }
  return rows;
}

/// A group that has two ν̄ or more.
struct GroupRows {
  const StateGroup* group;
  std::vector<StateRow> rows;
};

/// The rotation that most ν̄ have, of those the last.
int mostSeenRotation(const std::vector<StateRow>& rows) {
  std::map<int, int> seen;
  for (const StateRow& of : rows) ++seen[of.rotations];
  return std::ranges::max_element(
             seen, {}, [](const auto& each) { return std::pair(each.second, each.first); })
      ->first;
}

Figure mapFigure(const char* name, const std::string& title, const std::string& caption,
                 std::vector<Panel> panels, int columns) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = title + ". " + caption;
  figure.panels = std::move(panels);
  std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
  figure.columns = std::min(columns, static_cast<int>(figure.panels.size()));
  return figure;
}

Panel densityPanel(const char* yLabel) {
  Panel panel;
  panel.xLabel = "ν̄";
  panel.yLabel = yLabel;
  panel.xRange = densityAxis;
  panel.shaded = shearFlow;
  return panel;
}

Panel statesPanel(const GroupRows& own, const char* yLabel, MeanOfRuns StateRow::*quantity) {
  Panel panel = densityPanel(yLabel);
  panel.title = own.group->label;
  std::size_t colour = 0;
  for (const int rotations : mapRotations) {
    Curve curve{
        fmt::format("{} rot.", rotations), thesisStyle(colour++, 0), Draw::linesAndPoints, {}};
    for (const StateRow& of : own.rows)
      if (of.rotations == rotations && (of.*quantity).mean)
        curve.points.push_back({of.nu, *(of.*quantity).mean, (of.*quantity).error});
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

std::string densitiesText(const std::vector<double>& of) {
  return of.size() == 1 ? fmt::format("{:.3f}", of.front())
                        : fmt::format("{:.3f} … {:.3f}", of.front(), of.back());
}

/// Contacts of the wheel and pressure over ν̄ of each group.
std::pair<Figure, Figure> stateFigures(const std::vector<GroupRows>& groups) {
  std::vector<std::string> contactClauses, pressureClauses;
  std::vector<Panel> contacts, pressures;
  for (const GroupRows& own : groups) {
    contacts.push_back(statesPanel(own, "contacts of the wheel", &StateRow::contacts));
    contacts.back().level = fewestWheelContacts;
    pressures.push_back(statesPanel(own, "pressure on the ring [N/m^{2}]", &StateRow::pressure));
    pressures.back().logY = true;
    const int rotations = mostSeenRotation(own.rows);
    std::vector<double> without, with;
    std::vector<Point> points;
    for (const StateRow& of : own.rows) {
      if (of.rotations != rotations) continue;
      (*of.contacts.mean < fewestWheelContacts ? without : with).push_back(of.nu);
      if (of.pressure.mean) points.push_back({of.nu, *of.pressure.mean, {}});
    }
    const std::string after = fmt::format("{}, after {} rotation{}", own.group->label, rotations,
                                          rotations == 1 ? "" : "s");
    std::vector<std::string> parts;
    if (!without.empty())
      parts.push_back("fewer than one contact at ν̄ = " + densitiesText(without));
    if (!with.empty()) parts.push_back("one or more at ν̄ = " + densitiesText(with));
    contactClauses.push_back(fmt::format("{}: {}", after, fmt::join(parts, ", ")));
    if (!points.empty())
      pressureClauses.push_back(fmt::format("{}: {} at ν̄ = {:.3f}, {} at {:.3f}", after,
                                            readable(points.front().y), points.front().x,
                                            readable(points.back().y), points.back().x));
  }
  const std::string note = " Means over packings; shaded: what the thesis calls shear flow.";
  return {mapFigure("map_contacts", "Contacts of the wheel over the volume fraction",
                    thesisAndFound("below ν̄ ≈ 0.793 the wheel loses contact after some rotations",
                                   contactClauses) +
                        note,
                    std::move(contacts), 2),
          mapFigure(
              "map_pressure", "Pressure on the outer ring over the volume fraction",
              thesisAndFound("stresses grow with ν̄, from 0.1 to 10³ N/m²", pressureClauses) + note,
              std::move(pressures), 2)};
}

/// Over ν̄, a curve for each group and averaged time.
Panel widthPanel(const std::vector<StateGroup>& groups, const char* yLabel, const char* fit,
                 bool inverse, std::vector<DrawnCurve>& drawn) {
  Panel panel = densityPanel(yLabel);
  std::map<std::pair<std::size_t, std::string>, std::map<double, std::vector<Maybe>>> curves;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const CaseRun& at : groups[g].runs) {
      Maybe width = fittedIn(*at.run, fit);
      if (inverse) width = width && *width > 0.0 ? Maybe(1.0 / *width) : std::nullopt;
      const std::string label = fmt::format("{}, rotations {:g} to {:g}", groups[g].label,
                                            at.setup->settleRotations, at.setup->endRotation());
      curves[{g, label}][at.setup->label].push_back(width);
    }
  std::size_t colour = 0;
  for (const auto& [key, labels] : curves) {
    Curve curve{key.second, thesisStyle(colour, 0), Draw::linesAndPoints, {}};
    for (const auto& [label, values] : labels)
      if (const auto [mean, error] = meanOfRuns(values); mean)
        curve.points.push_back({label, *mean, error});
    if (curve.points.size() < 2) continue;
    ++colour;
    drawn.push_back({withoutBraces(yLabel) + ", " + key.second, curve.points, false});
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

Figure widthFigure(const std::vector<StateGroup>& groups) {
  std::vector<DrawnCurve> drawn;
  std::vector<Panel> panels = {
      widthPanel(groups, "decay length B of v_{φ} [d]", "velocity_decay", false, drawn),
      widthPanel(groups, "width 1/C of the dilated zone [d]", "dilation_decay", true, drawn)};
  return mapFigure(
      "map_width", "Width of the shear band over the volume fraction",
      thesisAndFound("a band 5 to 6 d wide, v_φ decaying within a few d", drawn,
                     Finding::extremes) +
          " Means over packings whose profile could be fitted; shaded: what the thesis calls "
          "shear flow.",
      std::move(panels), 1);
}

Figure criticalFigure(const std::vector<StateGroup>& groups) {
  Panel critical, share;
  critical.xLabel = share.xLabel = "rotations since the ring had closed";
  critical.yLabel = "critical ν̄";
  critical.level = shearFlow.low;
  share.yLabel = "share of packings that carry";
  share.yRange = Range{-0.05, 1.05};
  std::vector<std::string> clauses;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Curve at{groups[g].label, thesisStyle(g, 0), Draw::linesAndPoints, {}};
    Curve carry = at;
    std::vector<std::string> criticals, shares;
    for (const CriticalRow& of : criticalRows(groups[g])) {
      const auto rotations = static_cast<double>(of.rotations);
      carry.points.push_back({rotations, static_cast<double>(of.carry) / of.packings, {}});
      shares.push_back(fmt::format("{} of {} ({})", of.carry, of.packings, of.rotations));
      if (!of.critical) continue;
      at.points.push_back({rotations, of.critical->nu, of.critical->standardError});
      criticals.push_back(fmt::format(
          "{} ({})", readable(of.critical->nu, of.critical->standardError), of.rotations));
    }
    if (carry.points.empty()) continue;
    clauses.push_back(fmt::format("{}: {}, packings that carry {}", groups[g].label,
                                  criticals.empty()
                                      ? "no critical ν̄ follows"
                                      : fmt::format("critical ν̄ {}", fmt::join(criticals, ", ")),
                                  fmt::join(shares, ", ")));
    critical.curves.push_back(std::move(at));
    share.curves.push_back(std::move(carry));
  }
  std::erase_if(critical.curves, [](const Curve& curve) { return curve.points.empty(); });
  return mapFigure(
      "map_critical", "Critical volume fraction, and packings that still carry",
      thesisAndFound("a critical ν̄ of about 0.793, of at most 8 rotations", clauses) +
          " In brackets: after so many rotations, of the packings that were followed so long. "
          "Critical is where half of the packings carry, by logistic regression over them "
          "(Firth 1993), with its standard error; the line is the thesis' 0.793.",
      {std::move(critical), std::move(share)}, 1);
}

/// Over the middles of spans, means over the packings that have one there; of each ν̄ in
/// thousandths.
std::map<long, std::vector<Point>> overRotations(const StateGroup& group, SpanNumber quantity) {
  std::map<long, std::map<double, std::vector<Maybe>>> values;
  for (const CaseRun& at : group.packings)
    for (const ThesisSpan& span : at.run->history)
      if (span.*quantity)
        values[std::lround(1e3 * at.setup->label)][0.5 * (span.from + span.to)].push_back(span.*
                                                                                          quantity);
  std::map<long, std::vector<Point>> curves;
  for (const auto& [label, spans] : values)
    for (const auto& [middle, each] : spans) {
      const auto [mean, error] = meanOfRuns(each);
      curves[label].push_back({middle, *mean, error});
    }
  return curves;
}

Panel rotationsPanel(const StateGroup& group, const char* yLabel, SpanNumber quantity) {
  Panel panel;
  panel.title = group.label;
  panel.xLabel = "rotations since the ring had closed";
  panel.yLabel = yLabel;
  std::size_t colour = 0;
  for (auto& [label, points] : overRotations(group, quantity))
    panel.curves.push_back({fmt::format("{:.3f}", 1e-3 * static_cast<double>(label)),
                            thesisStyle(colour++, 0), Draw::linesAndPoints, points});
  return panel;
}

/// "… at ν̄ = 0.804 213 → 6.2 N/m² from the first rotation to the last (20)", of the lowest ν̄, the
/// highest, and the one that was followed for longest.
std::string changesClause(const StateGroup& group) {
  const auto curves = overRotations(group, &ThesisSpan::outerPressure);
  if (curves.empty()) return "";
  const auto longest =
      std::ranges::max_element(curves, {}, [](const auto& each) { return each.second.back().x; });
  std::string text;
  for (const auto& each : {curves.begin(), longest, std::prev(curves.end())}) {
    const std::vector<Point>& points = each->second;
    const std::string clause = fmt::format(
        "ν̄ = {:.3f} {} → {} (up to {:.0f})", 1e-3 * static_cast<double>(each->first),
        readable(points.front().y), readable(points.back().y), std::ceil(points.back().x));
    if (text.find(clause) == std::string::npos) text += (text.empty() ? "" : ", ") + clause;
  }
  return fmt::format("{}: pressure on the ring [N/m²] at {}", group.label, text);
}

/// States over rotations, of groups of which any packing was followed for two or more: how long a
/// cell goes on changing.
Figure timeFigure(const std::vector<StateGroup>& groups) {
  std::vector<Panel> panels;
  std::vector<std::string> clauses;
  for (const StateGroup& group : groups) {
    if (std::ranges::none_of(group.packings,
                             [](const CaseRun& at) { return spanAt(*at.run, 2.0) != nullptr; }))
      continue;
    panels.push_back(
        rotationsPanel(group, "pressure on the ring [N/m^{2}]", &ThesisSpan::outerPressure));
    panels.back().logY = true;
    panels.push_back(rotationsPanel(group, "contacts of the wheel", &ThesisSpan::wheelContacts));
    panels.back().level = fewestWheelContacts;
    panels.push_back(
        rotationsPanel(group, "ν, innermost ring", &ThesisSpan::volumeFractionAtWheel));
    if (const std::string clause = changesClause(group); !clause.empty()) clauses.push_back(clause);
  }
  Figure figure =
      mapFigure("map_time", "States over rotations",
                thesisAndFound("a steady state within about five rotations", clauses) +
                    " Means over the packings that were followed so long, each by its longest run; "
                    "groups that were followed for two rotations or more.",
                std::move(panels), 3);
  figure.panelWidth = 380;
  figure.panelHeight = 300;
  return figure;
}

}  // namespace

std::vector<Figure> mapFigures(const ThesisResults& results) {
  const auto engines = enginesWithRuns(results);
  if (engines.empty()) return {};
  const std::vector<StateGroup> groups = stateGroups(results, engines.front());
  std::vector<GroupRows> overNu;
  for (const StateGroup& group : groups) {
    GroupRows own{&group, stateRows(group)};
    if (!own.rows.empty() && own.rows.front().nu != own.rows.back().nu)
      overNu.push_back(std::move(own));
  }
  auto [contacts, pressure] = stateFigures(overNu);
  std::vector<Figure> figures = {std::move(contacts), std::move(pressure),
                                 widthFigure(groups), criticalFigure(groups),
                                 timeFigure(groups),  collapseFigure(results)};
  for (Figure& figure : figures) figure.caption += " Engine: " + engines.front() + ".";
  return figures;
}

std::string regimeMapCsv(const ThesisResults& results) {
  std::string table =
      "engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,"
      "outer_pressure,outer_pressure_stderr,critical_nu,critical_nu_stderr\n";
  const Maybe none;
  const auto count = [](int number) { return static_cast<std::size_t>(number); };
  for (const std::string& engine : enginesWithRuns(results))
    for (const StateGroup& group : stateGroups(results, engine)) {
      for (const StateRow& of : stateRows(group))
        table += row(engine, group.label, fmt::format("{:.3f}", of.nu), count(of.rotations),
                     count(of.packings), count(of.carry), of.contacts.mean, of.contacts.error,
                     of.pressure.mean, of.pressure.error, none, none);
      for (const CriticalRow& of : criticalRows(group))
        table +=
            row(engine, group.label, none, count(of.rotations), count(of.packings), count(of.carry),
                none, none, none, none, of.critical ? Maybe(of.critical->nu) : none,
                of.critical ? Maybe(of.critical->standardError) : none);
    }
  return table;
}

}  // namespace crossgrain::reports
