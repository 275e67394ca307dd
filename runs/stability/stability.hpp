#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "cases/case.hpp"
#include "results/stability.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// Which part of a suite of hard cases is run.
enum class SuitePart { quick, usual, withLong };

/// Hard cases by file and by folder (every *.toml in it, by name), all variants of each.
/// @throws BadInput for a case without [stability], two cases of one name, a folder without cases,
///         and a part that holds none
std::vector<Case> hardCases(const std::vector<std::filesystem::path>& inputs,
                            const std::vector<std::string>& overrides, SuitePart part);

/// The same of any cases, for transforms of them: none has to be a hard one.
/// @throws BadInput for two cases of one name, and a folder without cases
std::vector<Case> casesToTransform(const std::vector<std::filesystem::path>& inputs,
                                   const std::vector<std::string>& overrides);

/// What a suite asks of its cases.
enum class SuiteAsks {
  limits,     ///< that they stay within their [stability]
  transforms  ///< that they go the same way however they are told: transforms.hpp
};

/// Runs every hard case on every engine, each in a worker of its own. Finished runs are kept in the
/// store at once.
/// @param budget  of transforms: what would end later than this after the command began is not run
///                [s]; TimeBudget says how engines and cases share it
/// @throws BadInput, OutputError, Interrupted
StabilityResults testStability(const std::vector<Case>& cases, std::vector<EngineEntry> engines,
                               const RunCommand& command, RunStore& store,
                               SuiteAsks asks = SuiteAsks::limits,
                               double budget = std::numeric_limits<double>::infinity());

/// What that would run, for people. Engines are asked for their version; nothing is computed.
/// @throws BadInput, Interrupted
std::string stabilityPlan(const std::vector<Case>& cases, std::vector<EngineEntry> engines,
                          const RunCommand& command, RunStore& store,
                          SuiteAsks asks = SuiteAsks::limits);

}  // namespace crossgrain::inline runs
