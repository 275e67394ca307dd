#pragma once

#include <functional>
#include <vector>

namespace crossgrain::inline support {

/// A piece of work that may run beside others.
struct Task {
  double weight = 1.0;         ///< how long it is likely to take; the longest start first
  std::function<void()> work;  ///< an exception ends the whole pool once running tasks are done
};

/// Runs all tasks on `jobs` threads, longest first.
/// @throws Interrupted once all threads have ended, if the user interrupted; else the first thing
///         that a task threw
void runTasks(const std::vector<Task>& tasks, int jobs);

}  // namespace crossgrain::inline support
