#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/compare.hpp"
#include "results/rev.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct AverageOptions {
  std::optional<std::string> name;  ///< whose [engines.NAME] has the units of other programs' files
};

/// Averages the snapshots of files with the bins and methods of a case: HDF5 files (docs/files.md
/// has their layout) or result files of other programs (docs/import.md). Nothing is run: of the
/// case only walls, disks, averaging and the law's constants count; walls and disks must be those
/// of the files. Several runs of one engine are replicates, whose means have errors over runs.
/// @return of kind "average", of one engine
/// @throws BadInput naming the file and what does not fit
CompareResults averageSnapshots(const Case& setup, const std::vector<std::filesystem::path>& files,
                                const std::string& commandLine, const AverageOptions& options = {},
                                bool quiet = true);

/// averageSnapshots() as a command.
extern const Study<AverageOptions, CompareResults> averageStudy;

/// How large a representative element must be (Lätzel 2003, section 5.3): every field, under every
/// weight, in rings of widths from d/10 to 4 d about a few fixed radii (those of Fig. 5.6 in the
/// thesis' cell), and the widths next to d and 2 d at which each weight comes closest to slicing.
/// Of snapshots of a Couette cell in one HDF5 file.
/// @throws BadInput naming the file and what does not fit
extern const Study<AverageOptions, RevResults> revStudy;

}  // namespace crossgrain::inline studies
