#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/case.hpp"
#include "results/stability.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

/// Which part of a suite of hard cases is run.
enum class SuitePart { quick, usual, withLong };

/// Requirement of a suite on its cases.
enum class SuiteAsks {
  limits,     ///< that they stay within their [stability]
  transforms  ///< that they go the same way after a change of description: transforms.hpp
};

struct StabilityOptions {
  bool longCases = false, transforms = false;
  bool inSpace = false;  ///< each case in a plane of space, its disks as spheres
  std::optional<std::string> budget;

  SuiteAsks asks() const { return transforms ? SuiteAsks::transforms : SuiteAsks::limits; }
};

/// Study of hard cases: which of them stay stable on which engine.
extern const Study<StabilityOptions, StabilityResults> stabilityStudy;

/// Hard cases by file and by folder (every *.toml in it, by name), all variants of each.
/// @throws BadInput for a case without [stability], two cases of one name, a folder without cases,
///         and a part that holds none
std::vector<Case> hardCases(const std::vector<std::filesystem::path>& inputs,
                            const std::vector<std::string>& overrides, SuitePart part);

/// Runs every hard case on every engine, each in a worker of its own. Finished runs are kept in the
/// store at once.
/// @param budget  of transforms: what would end later than this after the command began is not run
///                [s]; TimeBudget says how engines and cases share it
/// @throws BadInput, OutputError, Interrupted
StabilityResults testStability(const std::vector<Case>& cases,
                               const std::vector<EngineEntry>& engines, const RunCommand& command,
                               RunStore& store, SuiteAsks asks = SuiteAsks::limits,
                               double budget = std::numeric_limits<double>::infinity(),
                               bool inSpace = false);

}  // namespace crossgrain::inline studies
