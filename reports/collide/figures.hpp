#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/collide/table.hpp"
#include "reports/common/figure.hpp"

/// What the plots of collisions share.
namespace crossgrain::reports {

using Styles = std::vector<std::pair<std::string, LineStyle>>;  ///< of engines, in their order

inline const LineStyle oracleStyle{"#999999", 0, false};

/// An axis over Ψ_i for a variant, with its name above.
Panel panelOver(const CollisionVariant& variant, const char* yLabel);

/// Where the energy of a case's collisions went: the oracle's account and every engine's at the
/// largest of its time steps. @param name  of the figure's files
Figure energyFigure(const CaseGroup& group, const Styles& styles, const std::string& name);

/// A grid of small panels; one variant's have more room.
void arrange(Figure& figure, int panelsInLine, std::size_t variants);

}  // namespace crossgrain::reports
