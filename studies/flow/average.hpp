#pragma once

#include <filesystem>
#include <string>

#include "cases/case.hpp"
#include "results/compare.hpp"
#include "results/rev.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

/// Averages the snapshots of an HDF5 file (README.md has its layout) with the rings and methods of
/// a Couette case. Nothing is run: of the case only cell, disks, averaging and the law's constants
/// count; cell and disks must be those of the file.
/// @return of kind "average", of one engine and one packing
/// @throws BadInput naming the file and what does not fit
CompareResults averageSnapshots(const Case& setup, const std::filesystem::path& file,
                                const std::string& commandLine);

/// The options of averaging: none of its own.
struct AverageOptions {};

/// averageSnapshots() as a command.
extern const Study<AverageOptions, CompareResults> averageStudy;

/// How large a representative element must be (Lätzel 2003, section 5.3): every field, under every
/// weight, in rings of widths from d/10 to 4 d about a few fixed radii (those of Fig. 5.6 in the
/// thesis' cell), and the widths next to d and 2 d at which each weight comes closest to slicing.
/// Of snapshots as averageSnapshots() takes them.
/// @throws BadInput naming the file and what does not fit
extern const Study<AverageOptions, RevResults> revStudy;

}  // namespace crossgrain::inline studies
