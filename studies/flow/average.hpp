#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/compare.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct AverageOptions {
  std::optional<std::string> name;  ///< whose [engines.NAME] has the units of other programs' files
  bool rev = false;                 ///< every field against the width of a bin
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
/// weight, in bins of widths from d/10 to 20 d, as far as they fit, about a few fixed places, and
/// the widths next to d and 2 d at which each weight comes closest to slicing. Bins are rings about
/// radii (those of Fig. 5.6 in the thesis' cell), slabs, or else squares and cubes on the middle
/// line of the averaged part. Of one run.
/// @throws BadInput naming the file and what does not fit
RevResults averagePerWidth(const StudyWork& work, const AverageOptions& own);

/// averagePerWidth() as a command: `average --rev`.
extern const Study<AverageOptions, RevResults> revStudy;

}  // namespace crossgrain::inline studies
