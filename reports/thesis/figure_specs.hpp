#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

/// One curve for each volume fraction and engine.
struct ThesisCurve {
  std::string name;  ///< empty where a panel has one
  Quantity y;
  RingWidth width = RingWidth::ofCase;
  std::string method = {};  ///< empty: the first one
};

struct ThesisPanel {
  std::string title;
  std::vector<ThesisCurve> curves;
  Quantity x{"r_tilde"};
  std::string xLabel = "(r − R_{i}) / d", yLabel;
  Range xRange{0.0, 20.0};
  std::optional<Range> yRange;  ///< the thesis' axis; drawn wider where data lie beyond it
  bool logX = false, logY = false;
  std::optional<double> level;
  std::optional<double> guide = {};  ///< exponent of a power law to hold the last curve against
  std::vector<Curve> lines = {};     ///< that no data make: a law, numbers of the thesis' text
};

/// What is told of a figure's data, by rule.
enum class Finding {
  ends,      ///< values next to the wheel, about 6 d from it and at the outer ring
  powerLaw,  ///< exponent in r
  decay,     ///< length of an exponential decay over 0 < r̃ < 6
  extremes,  ///< smallest and largest
  identity   ///< smallest and largest y/x
};

/// A figure of profiles, as the thesis has it.
struct ThesisFigure {
  std::string number;  ///< "7.14"
  std::string title;
  std::string says;            ///< what the thesis says it shows
  std::vector<double> labels;  ///< ν̄ of its curves
  std::vector<ThesisPanel> panels;
  Finding finding = Finding::ends;
  bool panelPerLabel = false;
  std::string note = {};  ///< what is otherwise here
};

/// Chapters 5 and 6, and 7 and 8. The other figures have parts of their own in figures.cpp.
std::vector<ThesisFigure> motionFigures();
std::vector<ThesisFigure> stressFigures();

}  // namespace crossgrain::reports
