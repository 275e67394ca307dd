#pragma once

#include <sys/types.h>

#include <functional>

namespace crossgrain {

/// Forks in the one thread of this process that never ends, whoever asks: the kernel ties a child
/// that is to die with its parent to the *thread* that forked it (PR_SET_PDEATHSIG).
/// @param work  forks, and returns what fork() returned; in the child it does not return
pid_t inTheLastingThread(const std::function<pid_t()>& work);

}  // namespace crossgrain
