#pragma once

#include <string>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/figure.hpp"
#include "reports/common/json_view.hpp"

namespace crossgrain::reports {

/// Every plot of a collision sweep: collision_1, collision_2, … in the order of its variants.
std::vector<Figure> collideFigures(const Json& results);

/// Every plot of a study of cost: cost_KIND, error against time, and cost_orders_KIND, against the
/// step, for each kind of error; cost_parts, of averages; cost_contacts; cost_growth.
std::vector<Figure> costFigures(const Json& results);

/// Plots of hard cases: stability_map, the verdicts of all; stability_CASE, the figure of a case
/// over time where an engine did not keep to its limit.
std::vector<Figure> stabilityFigures(const Json& results);

}  // namespace crossgrain::reports
