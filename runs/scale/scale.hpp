#pragma once

#include <string>
#include <vector>

#include "results/scale.hpp"
#include "runs/common/run_store.hpp"
#include "runs/scale/plan.hpp"

namespace crossgrain::inline runs {

/// The cell that grows, as it is before, with the changes of the command line: of engines' settings
/// and of [run] alone, for `scale` has the cell, its law and its packings for itself.
/// @throws BadInput for any other
Case scaleCase(const std::vector<std::string>& overrides);

/// Times steps of each engine on cells of growing size (cases/scaled_cell.hpp), with one worker and
/// with several. Nothing else of this command runs meanwhile; of one size all engines take turns,
/// in a fresh process for every repetition. What is timed is kept in the store at once.
///
/// A size that would take more memory than there is, judged by the size before, is refused.
/// @throws BadInput, OutputError, Interrupted
ScaleResults measureScale(const ScalePlan& plan, const std::vector<std::string>& overrides,
                          const RunCommand& command, RunStore& store);

/// What that would run, for people. Engines are asked for their version; nothing is computed.
/// @throws BadInput, Interrupted
std::string scalePlan(const ScalePlan& plan, const std::vector<std::string>& overrides,
                      const RunCommand& command, RunStore& store);

}  // namespace crossgrain::inline runs
