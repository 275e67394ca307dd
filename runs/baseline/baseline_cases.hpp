#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "runs/baseline/baseline.hpp"

namespace crossgrain::inline runs {

/// The cases that a baseline was made of, with changes, as after `--set`.
/// @param file  of the baseline, for messages
/// @throws BadInput
std::vector<Case> casesOf(const Baseline& baseline, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

/// Keys that are otherwise now, "law.mu: 0.44 → 0.5", over all variants.
std::vector<std::string> changedKeys(const std::vector<Case>& before, const std::vector<Case>& now);

}  // namespace crossgrain::inline runs
