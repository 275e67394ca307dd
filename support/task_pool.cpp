#include "support/task_pool.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "support/interrupt.hpp"

namespace crossgrain::inline support {

void runTasks(const std::vector<Task>& tasks, int jobs) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return tasks[k].weight; });

  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::exception_ptr first;
  const auto takeTasks = [&] {
    for (std::size_t k = next++; k < order.size() && !interrupted() && !stop; k = next++) {
      try {
        tasks[order[k]].work();
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!first) first = std::current_exception();
        stop = true;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int j = 0; j < jobs; ++j) threads.emplace_back(takeTasks);
  }
  throwIfInterrupted();
  if (first) std::rethrow_exception(first);
}

}  // namespace crossgrain::inline support
