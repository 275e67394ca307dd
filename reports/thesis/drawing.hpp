#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/thesis_formula.hpp"

/// What the thesis' figures are drawn with.
namespace crossgrain::reports {

/// Table 3.2: shear flow from the critical ν̄ up to where the cell is blocked.
inline constexpr Range shearFlow{0.793, 0.810};

/// Named figure_7_14 of "7.14", with title and caption: "Figure 7.14. …".
Figure thesisFigureOf(const std::string& number, const std::string& title,
                      const std::string& caption, std::vector<Panel> panels = {}, int columns = 2);

/// Of gnuplot's enhanced text, for names and sentences.
std::string withoutBraces(std::string text);

/// Colours distinguish `colour`, marks and dashes the engine.
LineStyle thesisStyle(std::size_t colour, std::size_t engine);
/// A grey dashed line that no data make: a law, numbers of the thesis' text.
Curve guideLine(const std::string& name, std::vector<Point> points);

/// Wide enough for the curves, too. @returns whether that is wider than the thesis' axis
bool fitAxis(Panel& panel, Range axis);

/// Mean of a number per run, with sd/√P from two runs on. Absent without a number.
struct MeanOfRuns {
  std::optional<double> mean, error;
};
MeanOfRuns meanOfRuns(const std::vector<std::optional<double>>& values);

enum class RingWidth { ofCase, finest };

/// The mean over runs of y against that of x, ring by ring; bars over runs, or within a single one
/// where that is known.
std::vector<Point> meanPoints(const std::vector<CaseRun>& runs, const Formula& x, const Formula& y,
                              RingWidth width = RingWidth::ofCase, const std::string& method = "");

/// What is reported of a figure's data, by rule.
enum class Finding {
  ends,      ///< values next to the wheel, about 6 d from it and at the outer ring
  powerLaw,  ///< exponent in r
  decay,     ///< length of an exponential decay over 0 < r̃ < 6
  extremes,  ///< smallest and largest
  identity   ///< smallest and largest y/x
};

/// A curve and what it is of.
struct DrawnCurve {
  std::string of;  ///< "ν̄ = 0.804, σ_rr"
  std::vector<Point> points;
  bool overRTilde = true;
};

/// "Thesis: ….  Found: …; …." of some curves, those without points left out.
std::string thesisAndFound(const std::string& says, const std::vector<DrawnCurve>& curves,
                           Finding finding);
/// The same from clauses.
std::string thesisAndFound(const std::string& says, const std::vector<std::string>& clauses);

// Parts of thesisFigures(): densities and widths of the band over ν̄ (6.4, 6.5, 7.24), rotation by
// rotation (5.5, 6.1), the width of rings (5.6), distributions (6.6, 6.10, 6.11, 7.8, 7.9), Mohan's
// model (9.1–9.4), collisions (4.3).
std::vector<Figure> densityFigures(const ThesisResults& results);
std::vector<Figure> rotationFigures(const ThesisResults& results);
std::vector<Figure> widthOfRingFigures(const ThesisResults& results);
std::vector<Figure> thesisDistributionFigures(const ThesisResults& results);
std::vector<Figure> modelFigures(const ThesisResults& results);
std::vector<Figure> collisionFigures(const ThesisResults& results);

}  // namespace crossgrain::reports
