// States over rotations: how long a cell goes on changing.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "averaging/regime.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/regime_map.hpp"

namespace crossgrain::reports {

namespace {

using SpanValue = std::optional<double> ThesisSpan::*;

/// Over the middles of spans, means over the packings that have one there; of each ν̄ in
/// thousandths.
std::map<long, std::vector<Point>> overRotations(const StateGroup& group, SpanValue quantity) {
  std::map<long, std::map<double, std::vector<std::optional<double>>>> values;
  for (const LegRun& at : group.packings)
    for (const ThesisSpan& span : at.run->history)
      if (span.*quantity)
        values[std::lround(1e3 * at.leg->label)][0.5 * (span.from + span.to)].push_back(span.*
                                                                                        quantity);
  std::map<long, std::vector<Point>> curves;
  for (const auto& [label, spans] : values)
    for (const auto& [middle, each] : spans) {
      const auto [mean, error] = meanOfRuns(each);
      curves[label].push_back({middle, *mean, error});
    }
  return curves;
}

Panel rotationsPanel(const StateGroup& group, const char* yLabel, SpanValue quantity) {
  Panel panel;
  panel.title = group.words;
  panel.xLabel = "rotations since the ring had closed";
  panel.yLabel = yLabel;
  std::size_t colour = 0;
  for (auto& [label, points] : overRotations(group, quantity))
    panel.curves.push_back({fmt::format("{:.3f}", 1e-3 * static_cast<double>(label)),
                            thesisStyle(colour++, 0), Draw::linesAndPoints, points, 1.5});
  return panel;
}

/// Whether any packing was followed for two rotations or more.
bool followed(const StateGroup& group) {
  return std::ranges::any_of(group.packings,
                             [](const LegRun& at) { return spanAt(*at.run, 2.0) != nullptr; });
}

/// "… at ν̄ = 0.804 213 → 6.2 N/m² from the first rotation to the last (20)", of the lowest ν̄, the
/// highest, and the one that was followed for longest.
std::string changesClause(const StateGroup& group) {
  const auto curves = overRotations(group, &ThesisSpan::outerPressure);
  if (curves.empty()) return "";
  const auto longest =
      std::ranges::max_element(curves, {}, [](const auto& each) { return each.second.back().x; });
  std::string words;
  for (const auto& each : {curves.begin(), longest, std::prev(curves.end())}) {
    const std::vector<Point>& points = each->second;
    const std::string clause = fmt::format(
        "ν̄ = {:.3f} {} → {} (up to {:.0f})", 1e-3 * static_cast<double>(each->first),
        readable(points.front().y), readable(points.back().y), std::ceil(points.back().x));
    if (words.find(clause) == std::string::npos) words += (words.empty() ? "" : ", ") + clause;
  }
  return fmt::format("{}: pressure on the ring [N/m²] at {}", group.words, words);
}

}  // namespace

Figure timeFigure(const std::vector<StateGroup>& groups) {
  Figure figure;
  figure.name = "map_time";
  figure.title = "States over rotations";
  std::vector<std::string> clauses;
  for (const StateGroup& group : groups) {
    if (!followed(group)) continue;
    Panel pressure =
        rotationsPanel(group, "pressure on the ring [N/m^{2}]", &ThesisSpan::outerPressure);
    pressure.logY = true;
    Panel contacts = rotationsPanel(group, "contacts of the wheel", &ThesisSpan::wheelContacts);
    contacts.level = fewestWheelContacts;
    figure.panels.push_back(std::move(pressure));
    figure.panels.push_back(std::move(contacts));
    figure.panels.push_back(
        rotationsPanel(group, "ν, innermost ring", &ThesisSpan::volumeFractionAtWheel));
    if (const std::string clause = changesClause(group); !clause.empty()) clauses.push_back(clause);
  }
  std::erase_if(figure.panels, [](const Panel& panel) { return !hasPoints(panel); });
  figure.columns = std::min<int>(3, static_cast<int>(figure.panels.size()));
  figure.panelWidth = 380;
  figure.panelHeight = 300;
  figure.caption =
      figure.title + ". " + thesisAndFound("a steady state within about five rotations", clauses) +
      " Means over the packings that were followed so long, each by its longest run; groups "
      "that were followed for two rotations or more.";
  return figure;
}

}  // namespace crossgrain::reports
