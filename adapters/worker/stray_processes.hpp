#pragma once

#include <string>

namespace crossgrain {

/// The variable in a worker's environment, and so in that of all that it starts, by which they are
/// found again in whatever process group, session or parent they are.
inline constexpr const char* workerMark = "CROSSGRAIN_WORKER";

/// A value of it that no other worker has.
std::string newWorkerMark();

/// Kills every process that has this mark. What has started with an environment of its own making,
/// or belongs to another user, is not found; nor is anything where there is no /proc.
void killMarkedProcesses(const std::string& mark);

}  // namespace crossgrain
