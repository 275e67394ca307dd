#pragma once

#include <functional>

#include "runs/common/options.hpp"

namespace crossgrain::inline runs {

/// Does the work of a command that takes up what is finished in its folder. Where it cannot go on,
/// since the user interrupted it or the disk is full, what it throws says how to.
/// @returns what the work returns
/// @throws Interrupted, OutputError; what else the work throws
int resumably(const RunCommand& command, const std::function<int()>& work);

}  // namespace crossgrain::inline runs
