// Tasks: run once, kept, loaded again, counted for a dry run, found by what they are.
#include "studies/core/executor.hpp"

#include <gtest/gtest.h>

#include <mutex>

#include "support/scratch_folder.hpp"
#include "support/task_pool.hpp"

namespace {

using namespace crossgrain;

TEST(TimeLeft, SpeedSoFar_GivesSeconds) {
  EXPECT_EQ("6 s left", timeLeft(0.25, 2.0));
  EXPECT_EQ("0 s left", timeLeft(1.0, 2.0));
  EXPECT_EQ("59 s left", timeLeft(0.5, 59.0));
}

TEST(TimeLeft, LongTimes_AreInMinutesAndHours) {
  EXPECT_EQ("1 min 00 s left", timeLeft(0.5, 60.0));
  EXPECT_EQ("59 min 59 s left", timeLeft(0.5, 3599.0));
  EXPECT_EQ("1 h 01 min left", timeLeft(0.5, 3660.0));
}

TEST(TimeLeft, FirstSecondOrHundredth_GivesNone) {
  EXPECT_EQ("estimating the time left", timeLeft(0.5, 0.9));
  EXPECT_EQ("estimating the time left", timeLeft(0.01, 100.0));
}

TEST(RunTasks, OneThread_StartsTheLongestFirst) {
  std::vector<int> order;
  std::vector<Task> tasks;
  for (const int weight : {2, 9, 5})
    tasks.push_back({static_cast<double>(weight), [&order, weight] { order.push_back(weight); }});
  runTasks(tasks, 1);
  EXPECT_EQ(order, (std::vector<int>{9, 5, 2}));
}

TEST(RunTasks, ManyThreads_RunsEveryTaskOnce) {
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

using Values = std::vector<double>;

/// Two packings of two engines; what a run gives is its weight. One of them fails.
std::vector<CachedTask<Values>> fourRuns(int& done) {
  std::vector<CachedTask<Values>> tasks;
  for (const char* engine : {"b", "a"})
    for (int packing = 0; packing < 2; ++packing) {
      CachedTask<Values> task;
      task.of = {engine, "", packing};
      task.name = std::string(engine) + std::to_string(packing);
      task.key = {{"engine", engine}};
      task.weight = packing + (*engine == 'a' ? 10.0 : 1.0);
      const bool finishes = task.name != "b1";
      task.work = [&done, weight = task.weight, finishes](const auto&) {
        ++done;
        return CachedTask<Values>::Outcome{{weight}, finishes, "done"};
      };
      tasks.push_back(std::move(task));
    }
  return tasks;
}

TEST(DoOrTakeUp, FinishedTasks_AreLoadedAndFailedOnesRunAgain) {
  const ScratchFolder folder;
  RunCommand command;
  command.out = folder.path / "out";
  command.quiet = true;
  RunStore store(command, "study", {});
  store.begin();
  Progress progress(true);
  int done = 0;
  const auto tasks = fourRuns(done);
  const auto planned = [&] { return plannedWork(tasks, "runs", store); };
  ASSERT_EQ(planned().size(), 2u);
  EXPECT_EQ(planned().front().engine, "b");
  EXPECT_EQ(planned().front().total, 2u);
  EXPECT_EQ(planned().front().finished, 0u);
  const auto found = byId(tasks, runOrLoad(tasks, store, progress, "runs", 1));
  EXPECT_EQ(done, 4);
  EXPECT_EQ(found.at({"a", "", 1}), Values{11.0});
  EXPECT_EQ(found.at({"b", "", 0}), Values{1.0});
  EXPECT_EQ(planned().front().finished, 1u);
  EXPECT_EQ(byId(tasks, runOrLoad(tasks, store, progress, "runs", 1)), found);
  EXPECT_EQ(done, 5);
}

}  // namespace
