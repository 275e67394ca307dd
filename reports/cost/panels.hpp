#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/cost/points.hpp"

/// What the plots of a study of cost share.
namespace crossgrain::reports {

/// What stands on the x axis.
struct CostAxis {
  std::optional<double> (*value)(const CostPoint&);
  std::string label;
};

/// Larger errors say no more than that the run is wrong: they stand at the upper edge.
inline constexpr double offScale = 10.0;

/// gnuplot's marks
inline constexpr int crossMark = 2, openTriangle = 10;
LineStyle openMarks(LineStyle style);

CostPoints pointsOf(const CostPoints& points, const CostMeasure& measure);

/// A panel of errors on log axes, without curves: grey up to the largest uncertainty of a
/// reference, with room at the upper edge.
Panel errorPanel(const CostPoints& points, const std::string& measure, const CostAxis& axis);

/// The point with what it counts with; absent off scale or without a place on the axis. Bars are of
/// the statistical part.
std::optional<Point> errorPoint(const CostPoint& point, const CostAxis& axis);

/// What failed, at the upper edge of the panel.
Curve failures(const Panel& panel, const CostPoints& points, const CostEngine& engine,
               const CostAxis& axis);

/// Adds those of the curves that have points.
void addCurves(Panel& panel, std::vector<Curve> curves);

/// Whether some panel has a curve of that kind: captions name nothing else.
bool draws(const Figure& figure, const std::function<bool(const Curve&)>& isOfKind);
bool drawsMark(const Figure& figure, int pointType);

/// Lays out the panels that have points, which share one key above them.
void arrange(Figure& figure);

/// The parts of costFigures.
Figure costTimeFigure(const CostResults& results, const std::vector<CostEngine>& engines,
                      CostKind kind);
Figure costContactsFigure(const CostPoints& points, const std::vector<CostEngine>& engines);
Figure costOrderFigure(const CostResults& results, const std::vector<CostEngine>& engines,
                       CostKind kind);
Figure costPartsFigure(const CostPoints& points, const std::vector<CostEngine>& engines);
Figure costFallsFigure(const CostResults& results, const std::vector<CostEngine>& engines);
Figure costGrowthFigure(const CostResults& results);

}  // namespace crossgrain::reports
