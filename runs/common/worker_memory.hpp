#pragma once

#include <cstddef>
#include <optional>

#include "adapters/engine.hpp"

namespace crossgrain::inline runs {

/// The most that an engine's worker and what it has started held in memory so far: the sum of
/// VmHWM of /proc/PID/status (proc(5)) over those that still run [bytes]. Pages that several share
/// count in each. Absent for an engine that is no worker, or has gone.
std::optional<std::size_t> mostMemoryOf(const Engine& engine);

/// What programs can still have without swapping: MemAvailable of /proc/meminfo [bytes]; absent
/// where the kernel does not say.
std::optional<std::size_t> availableMemory();

}  // namespace crossgrain::inline runs
