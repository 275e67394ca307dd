#include "support/task_pool.hpp"

#include <gtest/gtest.h>

#include <mutex>

namespace {

using namespace crossgrain;

TEST(TaskPool, StartsTheLongestFirst) {
  std::vector<int> order;
  std::vector<Task> tasks;
  for (const int weight : {2, 9, 5})
    tasks.push_back({static_cast<double>(weight), [&order, weight] { order.push_back(weight); }});
  runTasks(tasks, 1);
  EXPECT_EQ(order, (std::vector<int>{9, 5, 2}));
}

TEST(TaskPool, RunsEveryTaskOnceWhateverTheNumberOfThreads) {
  std::mutex mutex;
  std::vector<int> done(50, 0);
  std::vector<Task> tasks;
  for (std::size_t k = 0; k < done.size(); ++k)
    tasks.push_back({1.0, [&, k] {
                       const std::scoped_lock lock(mutex);
                       ++done[k];
                     }});
  runTasks(tasks, 7);
  EXPECT_EQ(done, std::vector<int>(50, 1));
}

}  // namespace
