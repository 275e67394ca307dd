#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/head.hpp"

namespace crossgrain::reports {

/// Name of the in-house engine, of which mirrors are made.
const std::string& inHouse();

/// Colours by Okabe and Ito (2008), distinct with any colour vision; marks differ too. Of what is
/// no engine, by its place.
LineStyle engineStyle(std::size_t index);

/// Of engines in the order of the report, in every report alike: engines of this build by their
/// place in the registry, others by their name. A mirror has its peer's colour, dashed and open.
/// Strangers whose names lead to one style have the next that is free, in that order, so that no
/// two of a report look alike.
std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines);

}  // namespace crossgrain::reports
