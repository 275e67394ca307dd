// Tasks: run once, kept, loaded again, counted for a dry run, found by what they are.
#include "studies/core/executor.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "support/bad_input.hpp"
#include "support/busy_time.hpp"
#include "support/scratch_folder.hpp"
#include "support/task_pool.hpp"

namespace {

using namespace crossgrain;

TEST(TimeLeft, SpeedSoFar_GivesTheTimeInItsUnit) {
  EXPECT_EQ("6 s left", timeLeft(0.25, 2.0));
  EXPECT_EQ("0 s left", timeLeft(1.0, 2.0));
  EXPECT_EQ("59 s left", timeLeft(0.5, 59.0));
  EXPECT_EQ("1 min 00 s left", timeLeft(0.5, 60.0));
  EXPECT_EQ("59 min 59 s left", timeLeft(0.5, 3599.0));
  EXPECT_EQ("1 h 01 min left", timeLeft(0.5, 3660.0));
  EXPECT_EQ("estimating the time left", timeLeft(0.5, 0.9));
  EXPECT_EQ("estimating the time left", timeLeft(0.01, 100.0));
}

TEST(RunTasks, EveryTask_RunsOnceTheLongestFirst) {
  std::mutex mutex;
  for (const int threads : {1, 7}) {
    std::vector<int> order;
    std::vector<Task> tasks;
    for (int k = 0; k < 50; ++k) {
      const int weight = 7 * k % 50;
      tasks.push_back({static_cast<double>(weight), [&, weight] {
                         const std::scoped_lock lock(mutex);
                         order.push_back(weight);
                       }});
    }
    runTasks(tasks, threads);
    if (threads == 1) {
      EXPECT_TRUE(std::ranges::is_sorted(order, std::ranges::greater()));
    }
    std::ranges::sort(order);
    for (int k = 0; k < 50; ++k) EXPECT_EQ(order[static_cast<std::size_t>(k)], k);
  }
}

/// Two pieces, one inside the other: the time of the outer one, where a sum would be a third more.
TEST(BusyTime, NestedPieces_CountOnceAndPausesNotAtAll) {
  using std::chrono::milliseconds, std::this_thread::sleep_for;
  BusyTime time;
  EXPECT_EQ(0.0, time.seconds());
  const auto begin = std::chrono::steady_clock::now();
  {
    const BusyTime::Piece outer(time);
    sleep_for(milliseconds(20));
    EXPECT_GE(time.seconds(), 0.02) << "what is under way counts";
    const BusyTime::Piece inner(time);
    sleep_for(milliseconds(20));
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - begin;
  const double after = time.seconds();
  EXPECT_GE(after, 0.04);
  EXPECT_LE(after, all.count());
  sleep_for(milliseconds(20));
  EXPECT_EQ(after, time.seconds());
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

TEST(RunOrLoad, FinishedTasks_AreLoadedAndFailedOnesRunAgain) {
  const ScratchFolder folder;
  RunCommand command{.out = folder.path / "out", .quiet = true};
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

/// Two processes that share a folder, here as two stores: each run is done by one of them.
TEST(RunOrLoad, Shards_DoEachRunOnceAndHaveThemAll) {
  const ScratchFolder folder;
  const auto command = [&](int number) {
    RunCommand one{.out = folder.path / "out", .quiet = true};
    if (number > 0) one.shard = Shard{number, 2};
    return one;
  };
  std::atomic<int> done = 0;
  const auto tasks = [&] {
    std::vector<CachedTask<Values>> all;
    for (int k = 0; k < 20; ++k) {
      CachedTask<Values> task;
      task.of = {"a", "", k};
      task.name = fmt::format("a{}", k);
      task.work = [&done, k](const auto&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ++done;
        return CachedTask<Values>::Outcome{{static_cast<double>(k)}, k != 7, "done"};
      };
      all.push_back(std::move(task));
    }
    return all;
  }();
  const auto run = [&](RunStore& store) {
    Progress progress(true);
    return byId(tasks, runOrLoad(tasks, store, progress, "runs", 1));
  };
  std::map<RunId, Values> found[2];
  {
    RunStore first(command(1), "study", {}), second(command(2), "study", {});
    first.begin();
    second.begin();
    EXPECT_THROW(RunStore(command(0), "study", {}), BadInput) << "in use";
    std::thread other([&] { found[1] = run(second); });
    found[0] = run(first);
    other.join();
  }
  EXPECT_EQ(done, 20);
  EXPECT_EQ(found[0].size(), 20u);
  EXPECT_EQ(found[0], found[1]);
  // The next command tries again what failed, and finds the rest.
  RunStore next(command(1), "study", {});
  next.begin();
  EXPECT_EQ(run(next), found[0]);
  EXPECT_EQ(done, 21);
}

TEST(RunOrLoad, RunOfAShardThatDied_IsDone) {
  const ScratchFolder folder;
  RunCommand command{.out = folder.path / "out", .quiet = true, .shard = Shard{1, 2}};
  RunStore store(command, "study", {});
  store.begin();
  auto claim = store.claim("b0");
  ASSERT_TRUE(claim);
  EXPECT_FALSE(store.claim("b0"));
  std::thread dying([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    claim.reset();
  });
  Progress progress(true);
  int done = 0;
  runOrLoad(fourRuns(done), store, progress, "runs", 2);
  dying.join();
  EXPECT_EQ(done, 4);
}

}  // namespace
