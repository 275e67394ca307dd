#pragma once

#include <filesystem>
#include <string>

#include "cases/case.hpp"
#include "results/rev.hpp"
#include "studies/flow/average.hpp"

namespace crossgrain::inline studies {

/// How large a representative element must be (Lätzel 2003, section 5.3): every field, under every
/// weight, in rings of widths from d/10 to 4 d about a few fixed radii (those of Fig. 5.6 in the
/// thesis' cell), and the widths next to d and 2 d at which each weight comes closest to slicing.
/// Of snapshots as averageSnapshots() takes them.
/// @throws BadInput naming the file and what does not fit
extern const Study<AverageOptions, RevResults> revStudy;

}  // namespace crossgrain::inline studies
