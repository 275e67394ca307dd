#pragma once

#include <filesystem>
#include <string>

#include "cases/case.hpp"
#include "results/rev.hpp"

namespace crossgrain::inline runs {

/// How large a representative element must be (Lätzel 2003, section 5.3): every field, under every
/// weight, in rings of widths from d/10 to 4 d about a few fixed radii (those of Fig. 5.6 in the
/// thesis' cell), and the widths next to d and 2 d at which each weight comes closest to slicing.
/// @param file  snapshots, as averageSnapshots() takes them
/// @throws BadInput naming the file and what does not fit
RevResults revStudy(const Case& setup, const std::filesystem::path& file,
                    const std::string& commandLine, bool quiet);

}  // namespace crossgrain::inline runs
