#pragma once

#include <vector>

#include "reports/common/figure.hpp"
#include "results/engine_row.hpp"

namespace crossgrain::reports {

/// Colours by Okabe and Ito (2008), told apart with any colour vision; marks differ too.
LineStyle engineStyle(std::size_t index);

/// Of engines in the order of the report. A mirror has its peer's colour, dashed and open.
std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines);

}  // namespace crossgrain::reports
