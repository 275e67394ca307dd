#pragma once

#include <filesystem>

#include "runs/baseline/baseline.hpp"

namespace crossgrain::inline runs {

inline constexpr const char* baselineSchema = "crossgrain-baseline-2";

/// HDF5, whose doubles are the very bits; the same baseline gives the same bytes. What is no array
/// is JSON in attributes: `schema`, `head`, `engine-0` … The arrays of each start and window are
/// listed in docs/files.md.
/// @throws OutputError
void writeBaseline(const Baseline& baseline, const std::filesystem::path& file);

/// @throws BadInput naming the file: not a baseline, one of another schema, damaged
Baseline readBaseline(const std::filesystem::path& file);

}  // namespace crossgrain::inline runs
