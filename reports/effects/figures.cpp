#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/effects/report.hpp"

namespace crossgrain::reports {

namespace {

using Variants = std::vector<VariantSummary>;

Variants variantsThatRan(const EffectsResults& results, const std::string& engine) {
  Variants variants = variantSummaries(results, engine);
  std::erase_if(variants, [](const VariantSummary& variant) { return !variant.ran(); });
  return variants;
}

Panel effectRows(const Variants& variants) {
  Panel panel;
  panel.key = Key::none;
  for (const VariantSummary& variant : variants) panel.rows.push_back(effectLabel(variant.effect));
  return panel;
}

Panel costPanel(const Variants& variants) {
  Panel panel = effectRows(variants);
  panel.title = "cost";
  panel.xLabel = "share of a step [%]";
  Curve cost{"", engineStyle(2), Draw::blocks, {}, 1.5};
  for (std::size_t k = 0; k < variants.size(); ++k) {
    if (!variants[k].saved) continue;
    Point point{100.0 * *variants[k].saved, static_cast<double>(k), {}};
    if (variants[k].timeRatioError) point.error = 100.0 * *variants[k].timeRatioError;
    cost.points.push_back(point);
  }
  Range range;
  for (const Point& point : cost.points) {
    range.low = std::min(range.low, point.x - point.error.value_or(0.0));
    range.high = std::max(range.high, point.x + point.error.value_or(0.0));
  }
  const double reach = std::max(-range.low, range.high);
  if (reach > 0.0) panel.xRange = Range{range.low - 0.05 * reach, range.high + 0.05 * reach};
  // At most four labels beside 0 in a narrow panel: every 1, 2 or 5 of a decade.
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(reach, 1e-3))));
  const double step = reach > 5.0 * decade   ? 5.0 * decade
                      : reach > 2.0 * decade ? 2.0 * decade
                                             : decade;
  for (const double tick : {-step, 0.0, step, 2.0 * step}) panel.xTicks.push_back(tick);
  panel.curves.push_back(std::move(cost));
  return panel;
}

/// gnuplot's triangles: pointing up or down, filled or open.
int triangle(bool up, bool filled) {
  return (up ? 8 : 10) + (filled ? 1 : 0);
}

/// The sizes [%] that the change panels of a figure show.
Range rangeOf(const Variants& variants, const Names& fields) {
  constexpr double least = 0.01;  // [%] below lies no change that anybody would look for
  Range range{100.0, 100.0};
  for (const VariantSummary& variant : variants)
    for (const std::string& field : fields)
      if (const FieldChange* change = variant.of(field)) {
        const double size = std::max(100.0 * std::abs(change->change), least);
        range = {std::min(range.low, size), std::max(range.high, size)};
      }
  return {std::pow(10.0, std::floor(std::log10(range.low))), 2.0 * range.high};
}

/// Powers of ten within, so that labels of neighbouring panels keep apart.
std::vector<double> decadesWithin(const Range& range) {
  std::vector<double> ticks;
  for (double tick = 10.0 * range.low; tick < range.high; tick *= 10.0) ticks.push_back(tick);
  return ticks;
}

Panel changePanel(const Variants& variants, const std::string& field, const Range& range) {
  Panel panel = effectRows(variants);
  panel.title = "change of " + fieldPlotSymbol(field);
  panel.xLabel = "of the largest value [%]";
  panel.logX = true;
  panel.xRange = range;
  panel.xTicks = decadesWithin(range);
  for (const bool up : {true, false})
    for (const bool filled : {true, false}) {
      Curve marks{
          "", {filled ? "#d55e00" : "#7a858f", triangle(up, filled), false}, Draw::points, {}, 1.5};
      for (std::size_t k = 0; k < variants.size(); ++k) {
        const FieldChange* change = variants[k].of(field);
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
Names keyFields(const Variants& variants) {
  constexpr std::size_t most = 4;
  const Names judged = judgedFields(variants);
  Names fields;
  for (const char* name : {"azimuthal_velocity", "volume_fraction", "spin", "stress_rr"})
    if (std::ranges::find(judged, name) != judged.end()) fields.emplace_back(name);
  for (const std::string& name : judged)
    if (fields.size() < most) addOnce(fields, name);
  return fields;
}

Figure costFigure(const Variants& variants, const std::string& name) {
  const Names fields = keyFields(variants);
  Figure figure;
  figure.name = name;
  figure.title = "What each effect costs and what it changes";
  figure.caption =
      "Left: the share of a step's time that switching the effect off saves, ± one standard error. "
      "Right: the largest change of a profile when it is switched off, in % of the profile's "
      "largest value. ▲ larger without it, ▼ smaller; " +
      std::string(std::ranges::any_of(variants, &VariantSummary::decidable)
                      ? "filled: significant, open: not. Bars: to the end nearer 0 of the interval "
                        "that this rests on; one that leaves the axis on the left contains 0."
                      : "open: not tested. Bars: one standard error.");
  figure.panels.push_back(costPanel(variants));
  const Range range = rangeOf(variants, fields);
  for (const std::string& field : fields) {
    Panel panel = changePanel(variants, field, range);
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  figure.columns = static_cast<int>(figure.panels.size());
  figure.panelWidth = 205;
  figure.panelHeight = 110 + 26 * static_cast<int>(variants.size());
  figure.rowNames = 165;
  figure.png = true;
  return figure;
}

/// Variants whose change of the field is not significant.
IsFaint unchanged(const Variants& variants) {
  return [&variants](const EngineRuns& curve, const std::string& field) {
    const VariantSummary* const variant = findIf(variants, [&](const VariantSummary& one) {
      return variantLabel(one.effect) == curve.name;
    });
    const FieldChange* const change = variant ? variant->of(field) : nullptr;
    return change && change->detected == std::optional(false);
  };
}

}  // namespace

std::vector<Figure> effectFigures(const EffectsResults& results) {
  std::vector<Figure> figures;
  std::size_t k = 0;
  for (const EngineRuns& engine : engineRuns(results, results.ensemble)) {
    const std::string prefix = fmt::format("effects_{}_", ++k);
    const Variants variants = variantsThatRan(results, engine.name);
    if (variants.empty()) continue;
    figures.push_back(costFigure(variants, prefix + "cost"));
    for (Figure& figure :
         profileFigures(results, variantRuns(results, engine.name), unchanged(variants))) {
      if (figure.name == "overview") continue;
      figure.name = prefix + figure.name;
      // A key of long names is a column above the plot, which keeps its own height.
      constexpr int keyLine = 20;  // [px]
      figure.panelHeight += keyLine * static_cast<int>(figure.panels.front().curves.size());
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

}  // namespace crossgrain::reports
