#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/figures.hpp"
#include "reports/common/labels.hpp"
#include "reports/effects/legs.hpp"

namespace crossgrain::reports {

namespace {

using Legs = std::vector<EffectLeg>;

Legs legsThatRan(const Json& results, const std::string& engine) {
  Legs legs = effectLegs(results);
  std::erase_if(legs, [&](const EffectLeg& leg) { return leg.engine != engine || !leg.ran(); });
  return legs;
}

Panel rowsOf(const Legs& legs) {
  Panel panel;
  panel.key = Key::none;
  for (const EffectLeg& leg : legs) panel.rows.push_back(effectLabel(leg.effect));
  return panel;
}

Panel costPanel(const Legs& legs) {
  Panel panel = rowsOf(legs);
  panel.title = "cost";
  panel.xLabel = "share of a step [%]";
  Curve cost{"", engineStyle(2), Draw::blocks, {}, 1.5};
  for (std::size_t k = 0; k < legs.size(); ++k) {
    if (!legs[k].saved) continue;
    Point point{100.0 * *legs[k].saved, static_cast<double>(k), {}};
    if (legs[k].savedError) point.error = 100.0 * *legs[k].savedError;
    cost.points.push_back(point);
  }
  panel.curves.push_back(std::move(cost));
  return panel;
}

/// gnuplot's triangles: pointing up or down, filled or open.
int triangle(bool up, bool filled) {
  return (up ? 8 : 10) + (filled ? 1 : 0);
}

/// The shares [%] that the change panels of a figure show.
Range rangeOf(const Legs& legs, const std::vector<std::string>& fields) {
  constexpr double least = 0.01;  // [%] below lies no change that anybody would look for
  Range range{100.0, 100.0};
  for (const EffectLeg& leg : legs)
    for (const std::string& field : fields)
      if (const FieldChange* change = leg.of(field)) {
        const double share = std::max(100.0 * std::abs(change->change), least);
        range = {std::min(range.low, share), std::max(range.high, share)};
      }
  return {std::pow(10.0, std::floor(std::log10(range.low))), 2.0 * range.high};
}

/// Powers of ten within, so that labels of neighbouring panels keep apart.
std::vector<double> decadesWithin(const Range& range) {
  std::vector<double> ticks;
  for (double tick = 10.0 * range.low; tick < range.high; tick *= 10.0) ticks.push_back(tick);
  return ticks;
}

/// The symbol of a field in gnuplot's enhanced text.
std::string enhanced(const std::string& field) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 6> symbols = {
      {{"azimuthal_velocity", "v_φ"},
       {"volume_fraction", "ν"},
       {"stress_rr", "σ_{rr}"},
       {"stress_rp", "σ_{rφ}"},
       {"spin", "S"},
       {"fabric_trace", "tr F"}}};
  for (const auto& [name, symbol] : symbols)
    if (name == field) return symbol;
  return spaced(field);
}

Panel changePanel(const Legs& legs, const std::string& field, const Range& range) {
  Panel panel = rowsOf(legs);
  panel.title = "change of " + enhanced(field);
  panel.xLabel = "of the largest value [%]";
  panel.logX = true;
  panel.xRange = range;
  panel.xTicks = decadesWithin(range);
  for (const bool up : {true, false})
    for (const bool filled : {true, false}) {
      Curve marks{
          "", {filled ? "#d55e00" : "#7a858f", triangle(up, filled), false}, Draw::points, {}, 1.5};
      for (std::size_t k = 0; k < legs.size(); ++k) {
        const FieldChange* change = legs[k].of(field);
        if (!change || (change->change > 0.0) != up || change->detected.value_or(false) != filled)
          continue;
        Point point{100.0 * std::abs(change->change), static_cast<double>(k), {}};
        if (change->low && change->high)
          point.error = point.x - 100.0 * (change->change > 0.0 ? *change->low : -*change->high);
        else if (change->error)
          point.error = 100.0 * *change->error;
        marks.points.push_back(point);
      }
      if (!marks.points.empty()) panel.curves.push_back(std::move(marks));
    }
  return panel;
}

/// The fields that say most about a shear cell, as far as they are judged; else the first ones.
std::vector<std::string> keyFields(const Legs& legs) {
  constexpr std::size_t most = 4;
  const std::vector<std::string> judged = judgedFields(legs);
  std::vector<std::string> fields;
  for (const char* name : {"azimuthal_velocity", "volume_fraction", "spin", "stress_rr"})
    if (std::ranges::find(judged, name) != judged.end()) fields.emplace_back(name);
  for (const std::string& name : judged)
    if (fields.size() < most && std::ranges::find(fields, name) == fields.end())
      fields.push_back(name);
  return fields;
}

Figure costFigure(const Legs& legs, const std::string& name) {
  const std::vector<std::string> fields = keyFields(legs);
  Figure figure;
  figure.name = name;
  figure.title = "What each effect costs and what it changes";
  figure.caption =
      "Left: the share of a step's time that switching the effect off saves, ± one standard error. "
      "Right: the largest change of a profile when it is switched off, in % of the profile's "
      "largest value. ▲ larger without it, ▼ smaller; " +
      std::string(std::ranges::any_of(legs, &EffectLeg::decidable)
                      ? "filled: told apart from no change, open: not. Bars: as far as the "
                        "end nearer 0 of the interval that this rests on; one that leaves the axis "
                        "on the left holds 0."
                      : "open: too few packings to tell whether they are chance. Bars: one "
                        "standard error.");
  figure.panels.push_back(costPanel(legs));
  const Range range = rangeOf(legs, fields);
  for (const std::string& field : fields) {
    Panel panel = changePanel(legs, field, range);
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  figure.columns = static_cast<int>(figure.panels.size());
  figure.panelWidth = 205;
  figure.panelHeight = 110 + 26 * static_cast<int>(legs.size());
  figure.rowNames = 165;
  figure.png = true;
  return figure;
}

/// Legs whose change of the field was not told apart from none.
IsFaint unchanged(const Legs& legs) {
  return [&legs](const EngineResults& curve, const std::string& field) {
    const auto leg = std::ranges::find_if(
        legs, [&](const EffectLeg& one) { return legLabel(one.effect) == curve.name; });
    if (leg == legs.end()) return false;
    const FieldChange* change = leg->of(field);
    return change && change->detected == std::optional(false);
  };
}

}  // namespace

std::vector<Figure> effectFigures(const Json& results) {
  std::vector<Figure> figures;
  std::size_t k = 0;
  for (const EngineResults& engine : engineResults(results)) {
    const std::string prefix = fmt::format("effects_{}_", ++k);
    const Legs legs = legsThatRan(results, engine.name);
    if (legs.empty()) continue;
    figures.push_back(costFigure(legs, prefix + "cost"));
    for (Figure& figure :
         profileFigures(results, legResults(results, engine.name), unchanged(legs))) {
      if (figure.name == "overview") continue;
      figure.name = prefix + figure.name;
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace crossgrain::reports
