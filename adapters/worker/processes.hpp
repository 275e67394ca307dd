#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace crossgrain {

/// The variable in a worker's environment, and so in that of all that it starts, by which they are
/// found again in whatever process group, session or parent they are.
inline constexpr const char* workerMark = "CROSSGRAIN_WORKER";

/// Kills every process whose environment has workerMark with this value, children that are being
/// born included. Not found: what has an environment of its own making or belongs to another user,
/// and everything where there is no /proc.
///
/// Marked processes descend from marked ones alone. One search lists all processes and then looks
/// at each. A process that ends in between shows no environment and may have left a child that was
/// not listed, so the search is repeated until it finds none and every process without an
/// environment was so in the search before: whatever children it left were listed.
/// @param listed  for tests: called in every search between the list and the first look
void killMarkedProcesses(const std::string& mark, const std::function<void()>& listed = {});

/// Whether the processes of a group compute, and for how long they have.
struct GroupActivity {
  double cpuSeconds = 0.0;  ///< of all that are there [s]
  bool computes = false;    ///< a thread runs, waits for its turn on a processor, or for a disk
};
GroupActivity activityOf(pid_t group);

}  // namespace crossgrain
