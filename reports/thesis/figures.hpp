#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/thesis.hpp"

/// The thesis' figures from this project's data, with the thesis' axes and numbers.
namespace crossgrain::reports {

/// All that the results have data for, in the thesis' order, then those of the regime map;
/// "figure 7.14" is named figure_7_14.
/// A curve's colour is its volume fraction where there are several, its mark is its engine. Means
/// are over packings.
std::vector<Figure> thesisFigures(const ThesisResults& results);

/// "figure_7_14" of "7.14".
std::string thesisFigureName(const std::string& number);
/// With name, title and caption: "Figure 7.14. …".
Figure thesisFigureOf(const std::string& number, const std::string& title,
                      const std::string& caption);

/// Of gnuplot's enhanced text, for names and sentences.
std::string withoutBraces(std::string words);

/// Colours tell `colour`, marks and dashes the engine.
LineStyle thesisStyle(std::size_t colour, std::size_t engine);

/// Wide enough for the points, too; true in `widened` if that is wider than the thesis' axis.
Range holding(Range axis, const std::vector<Curve>& curves, bool logarithmic, bool& widened);

/// What the parts are: densities and widths of the band over ν̄ (6.4, 6.5, 7.24), rotation by
/// rotation (5.5, 6.1), distributions (6.6, 6.10, 6.11, 7.8, 7.9), Mohan's model (9.1–9.4).
std::vector<Figure> densityFigures(const ThesisResults& results);
std::vector<Figure> rotationFigures(const ThesisResults& results);
std::vector<Figure> thesisDistributionFigures(const ThesisResults& results);
std::vector<Figure> modelFigures(const ThesisResults& results);
/// 4.3, from the ladder's collisions.
std::vector<Figure> collisionFigures(const ThesisResults& results);
/// 5.6: the volume fraction at four radii over the width of the ring.
std::vector<Figure> widthOfRingFigures(const ThesisResults& results);

/// Figures that the thesis has not, of the reference engine; named map_…: contacts of the wheel,
/// pressure, width of the band, critical ν̄, states over rotations, and what carries the stress.
std::vector<Figure> mapFigures(const ThesisResults& results);
Figure collapseFigure(const ThesisResults& results);

}  // namespace crossgrain::reports
