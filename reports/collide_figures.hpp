#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/figure.hpp"
#include "reports/json_view.hpp"

/// What the plots of a collision sweep share.
namespace crossgrain::reports {

using Styles = std::map<std::string, LineStyle>;  ///< by engine

inline const LineStyle oracleStyle{"#999999", 0, false};

/// The points of rows where both members are numbers.
std::vector<Point> pointsOf(const Json& rows, const char* x, const char* y);

/// The first curve of every engine that has points: that of its first time step.
std::vector<const Json*> firstCurves(const Json& variant);

/// The largest Ψ_i of a variant and a little more.
Range psiRange(const Json& variant);

/// Quantities beyond Ψ_f: β of the contact point, the centres' tangential velocity, and where the
/// energy went. @param name  of the figure's files
Figure quantitiesFigure(const Json& variant, const Styles& styles, const std::string& name);

}  // namespace crossgrain::reports
