// The regime map: contacts of the wheel, pressure, width of the band and the critical ν̄.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "averaging/regime.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/regime_map.hpp"

namespace crossgrain::reports {

namespace {

constexpr Range densityAxis{0.785, 0.83};
/// Table 3.2: shear flow from the critical ν̄ up to where the cell is blocked.
constexpr Range tableFlow{0.793, 0.810};

struct GroupRows {
  const StateGroup* group;
  std::vector<StateRow> rows;
};

/// Those that have two ν̄ or more.
std::vector<GroupRows> overDensities(const std::vector<StateGroup>& groups) {
  std::vector<GroupRows> all;
  for (const StateGroup& group : groups) {
    GroupRows own{&group, stateRows(group)};
    if (!own.rows.empty() && own.rows.front().nu != own.rows.back().nu)
      all.push_back(std::move(own));
  }
  return all;
}

/// The rotation that most ν̄ have, of those the last.
int mostSeenRotation(const std::vector<StateRow>& rows) {
  std::map<int, int> seen;
  for (const StateRow& of : rows) ++seen[of.rotations];
  return std::ranges::max_element(
             seen, {}, [](const auto& each) { return std::pair(each.second, each.first); })
      ->first;
}

std::string afterWords(int rotations) {
  return rotations == 1 ? "1 rotation" : fmt::format("{} rotations", rotations);
}

Figure mapFigure(const char* name, const std::string& title, const std::string& caption) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = title + ". " + caption;
  return figure;
}

Panel densityPanelOf(const GroupRows& own, const char* yLabel, MeanOfRuns StateRow::*quantity) {
  Panel panel;
  panel.title = own.group->words;
  panel.xLabel = "ν̄";
  panel.yLabel = yLabel;
  panel.xRange = densityAxis;
  panel.shaded = tableFlow;
  std::size_t colour = 0;
  for (const int rotations : mapRotations) {
    Curve curve{
        fmt::format("{} rot.", rotations), thesisStyle(colour++, 0), Draw::linesAndPoints, {}, 1.5};
    for (const StateRow& of : own.rows)
      if (of.rotations == rotations && (of.*quantity).mean)
        curve.points.push_back({of.nu, *(of.*quantity).mean, (of.*quantity).error});
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// "fewer than one contact at ν̄ = 0.789 … 0.796, one or more at 0.800 … 0.828"
std::string contactsClause(const GroupRows& own) {
  const int rotations = mostSeenRotation(own.rows);
  std::vector<double> without, with;
  for (const StateRow& of : own.rows)
    if (of.rotations == rotations)
      (*of.contacts.mean < fewestWheelContacts ? without : with).push_back(of.nu);
  const auto range = [](const std::vector<double>& of) {
    return of.size() == 1 ? fmt::format("{:.3f}", of.front())
                          : fmt::format("{:.3f} … {:.3f}", of.front(), of.back());
  };
  std::vector<std::string> parts;
  if (!without.empty()) parts.push_back("fewer than one contact at ν̄ = " + range(without));
  if (!with.empty()) parts.push_back("one or more at ν̄ = " + range(with));
  return fmt::format("{}, after {}: {}", own.group->words, afterWords(rotations),
                     fmt::join(parts, ", "));
}

Figure contactsFigure(const std::vector<GroupRows>& groups) {
  std::vector<std::string> clauses;
  std::vector<Panel> panels;
  for (const GroupRows& own : groups) {
    panels.push_back(densityPanelOf(own, "contacts of the wheel", &StateRow::contacts));
    panels.back().level = fewestWheelContacts;
    clauses.push_back(contactsClause(own));
  }
  Figure figure = mapFigure(
      "map_contacts", "Contacts of the wheel over the volume fraction",
      thesisAndFound("below ν̄ ≈ 0.793 the wheel loses contact after some rotations", clauses) +
          " Means over packings; shaded: what the thesis calls shear flow.");
  figure.panels = std::move(panels);
  figure.columns = std::min<int>(2, static_cast<int>(figure.panels.size()));
  return figure;
}

Figure pressureFigure(const std::vector<GroupRows>& groups) {
  std::vector<std::string> clauses;
  std::vector<Panel> panels;
  for (const GroupRows& own : groups) {
    Panel panel = densityPanelOf(own, "pressure on the ring [N/m^{2}]", &StateRow::pressure);
    panel.logY = true;
    const int rotations = mostSeenRotation(own.rows);
    std::vector<Point> points;
    for (const StateRow& of : own.rows)
      if (of.rotations == rotations && of.pressure.mean)
        points.push_back({of.nu, *of.pressure.mean, {}});
    if (!points.empty())
      clauses.push_back(fmt::format("{}, after {}: {} at ν̄ = {:.3f}, {} at {:.3f}",
                                    own.group->words, afterWords(rotations),
                                    readable(points.front().y), points.front().x,
                                    readable(points.back().y), points.back().x));
    panels.push_back(std::move(panel));
  }
  Figure figure = mapFigure("map_pressure", "Pressure on the outer ring over the volume fraction",
                            thesisAndFound("stresses grow with ν̄, from 0.1 to 10³ N/m²", clauses) +
                                " Means over packings; shaded: what the thesis calls shear flow.");
  figure.panels = std::move(panels);
  figure.columns = std::min<int>(2, static_cast<int>(figure.panels.size()));
  return figure;
}

using WidthOfRun = std::optional<double> (*)(const ThesisRun&);

/// Over ν̄, a curve for each group and averaged time.
Panel widthPanel(const std::vector<StateGroup>& groups, const char* yLabel, WidthOfRun width,
                 std::vector<DrawnCurve>& told) {
  Panel panel;
  panel.xLabel = "ν̄";
  panel.yLabel = yLabel;
  panel.xRange = densityAxis;
  panel.shaded = tableFlow;
  std::map<std::pair<std::size_t, std::string>,
           std::map<double, std::vector<std::optional<double>>>>
      curves;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const LegRun& at : groups[g].runs)
      curves[{g, fmt::format("{}, rotations {:g} to {:g}", groups[g].words, at.leg->settleRotations,
                             at.leg->settleRotations + at.leg->averagedRotations)}][at.leg->label]
          .push_back(width(*at.run));
  std::size_t colour = 0;
  for (const auto& [key, labels] : curves) {
    Curve curve{key.second, thesisStyle(colour, 0), Draw::linesAndPoints, {}, 1.5};
    for (const auto& [label, values] : labels)
      if (const auto [mean, error] = meanOfRuns(values); mean)
        curve.points.push_back({label, *mean, error});
    if (curve.points.size() < 2) continue;
    ++colour;
    told.push_back({withoutBraces(yLabel) + ", " + key.second, curve.points, false});
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

Figure widthFigure(const std::vector<StateGroup>& groups) {
  std::vector<DrawnCurve> told;
  std::vector<Panel> panels = {
      widthPanel(
          groups, "decay length B of v_{φ} [d]",
          [](const ThesisRun& run) { return fittedIn(run, "velocity_decay"); }, told),
      widthPanel(
          groups, "width 1/C of the dilated zone [d]",
          [](const ThesisRun& run) -> std::optional<double> {
            const auto inverse = fittedIn(run, "dilation_decay");
            return inverse && *inverse > 0.0 ? std::optional(1.0 / *inverse) : std::nullopt;
          },
          told)};
  std::erase_if(panels, [](const Panel& panel) { return !hasPoints(panel); });
  Figure figure = mapFigure(
      "map_width", "Width of the shear band over the volume fraction",
      thesisAndFound("a band 5 to 6 d wide, v_φ decaying within a few d", told, Finding::extremes) +
          " Means over packings whose profile could be fitted; shaded: what the thesis calls "
          "shear flow.");
  figure.panels = std::move(panels);
  figure.columns = 1;
  return figure;
}

Figure criticalFigure(const std::vector<StateGroup>& groups) {
  Panel critical, share;
  critical.xLabel = share.xLabel = "rotations since the ring had closed";
  critical.yLabel = "critical ν̄";
  critical.level = tableFlow.low;
  share.yLabel = "share of packings that carry";
  share.yRange = Range{-0.05, 1.05};
  std::vector<std::string> clauses;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Curve at{groups[g].words, thesisStyle(g, 0), Draw::linesAndPoints, {}, 1.5};
    Curve carry = at;
    std::vector<std::string> criticals, shares;
    for (const CriticalRow& of : criticalRows(groups[g])) {
      carry.points.push_back(
          {static_cast<double>(of.rotations), static_cast<double>(of.carry) / of.packings, {}});
      shares.push_back(fmt::format("{} of {} ({})", of.carry, of.packings, of.rotations));
      if (!of.critical) continue;
      at.points.push_back(
          {static_cast<double>(of.rotations), of.critical->nu, of.critical->standardError});
      criticals.push_back(fmt::format(
          "{} ({})", readable(of.critical->nu, of.critical->standardError), of.rotations));
    }
    if (carry.points.empty()) continue;
    clauses.push_back(fmt::format("{}: {}, packings that carry {}", groups[g].words,
                                  criticals.empty()
                                      ? "no critical ν̄ follows"
                                      : fmt::format("critical ν̄ {}", fmt::join(criticals, ", ")),
                                  fmt::join(shares, ", ")));
    if (!at.points.empty()) critical.curves.push_back(std::move(at));
    share.curves.push_back(std::move(carry));
  }
  Figure figure = mapFigure(
      "map_critical", "Critical volume fraction, and packings that still carry",
      thesisAndFound("a critical ν̄ of about 0.793, of at most 8 rotations", clauses) +
          " In brackets: after so many rotations, of the packings that were followed so long. "
          "Critical is where half of the packings carry, by logistic regression over them "
          "(Firth 1993), with its standard error; the line is the thesis' 0.793.");
  figure.panels = {std::move(critical), std::move(share)};
  std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
  figure.columns = 1;
  return figure;
}

}  // namespace

std::vector<Figure> mapFigures(const ThesisResults& results) {
  const auto engines = enginesWithRuns(results);
  if (engines.empty()) return {};
  const std::vector<StateGroup> groups = stateGroups(results, engines.front());
  const std::vector<GroupRows> overNu = overDensities(groups);
  std::vector<Figure> figures = {contactsFigure(overNu), pressureFigure(overNu),
                                 widthFigure(groups),    criticalFigure(groups),
                                 timeFigure(groups),     collapseFigure(results)};
  for (Figure& figure : figures) figure.caption += " Engine: " + engines.front() + ".";
  return figures;
}

}  // namespace crossgrain::reports
