#pragma once

#include "results/collision.hpp"
#include "results/overview.hpp"

namespace crossgrain::reports {

/// An engine per row, a group of quantities per column: the largest error as a share of its limit.
Overview collideOverview(const CollideResults& results);

/// At most three short sentences: who holds, what is to blame where engines do not, what is next.
std::vector<std::string> collideConclusion(const CollideResults& results);

}  // namespace crossgrain::reports
