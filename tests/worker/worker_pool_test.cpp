#include "adapters/worker/worker_pool.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <thread>

#include "support/files.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/worker/toy_engine.hpp"

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

class Pool : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const fs::path scratch_ = folder_.path();

  static WorkerPool::Kind kindOf(const std::string& mischief) {
    return {"toy", {{fs::read_symlink("/proc/self/exe").string(), "--worker", mischief}}};
  }

  std::unique_ptr<PooledEngine> start(const std::string& mischief, const std::string& run = "run") {
    return std::make_unique<PooledEngine>(pool_, kindOf(mischief), scratch_ / run, 20.0);
  }

  /// A whole run: the last tangential force, and which process it was.
  struct Ran {
    double force;
    pid_t pid;
  };
  Ran run(const std::string& mischief, const std::string& folder = "run") {
    const auto engine = start(mischief, folder);
    engine->load(test::toyScene(), {});
    engine->advance(0.5);
    const Snapshot seen = engine->snapshot(ContactReport::instant);
    return {seen.contacts && !seen.contacts->i.empty() ? seen.contacts->tangentialForce[0] : 0.0,
            engine->pid()};
  }

  /// As the engine does by itself, with nothing before it.
  static double forceAlone() {
    test::ToyEngine toy;
    toy.load(test::toyScene(), {});
    toy.advance(0.5);
    return toy.snapshot(ContactReport::instant).contacts->tangentialForce[0];
  }

  std::string logOf(const std::string& run) const {
    return readFile(scratch_ / run / "toy.log").value();
  }

  /// Ends a worker, and waits until the kernel says so; it stays to be reaped.
  static void killAndSee(pid_t pid) {
    ASSERT_EQ(::kill(pid, SIGKILL), 0);
    siginfo_t info{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT), 0);
  }

  WorkerPool pool_;
};

TEST_F(Pool, WorkerOfSeveralRuns_DoesTheSameBits) {
  const Ran first = run(""), second = run(""), third = run("");
  EXPECT_EQ(first.pid, second.pid);
  EXPECT_EQ(second.pid, third.pid);
  for (const Ran& each : {first, second, third}) EXPECT_EQ(each.force, forceAlone());
  EXPECT_EQ(pool_.reasonNotReused("toy"), "");
}

TEST_F(Pool, TwoAtOnce_HaveOneEach) {
  run("");
  const auto one = start(""), other = start("");
  EXPECT_NE(one->pid(), other->pid());
}

TEST_F(Pool, AnotherCommand_IsAnotherEngine) {
  const pid_t one = run("").pid;
  WorkerPool::Kind limited = kindOf("");
  limited.call.memory = std::uint64_t{1} << 40;
  EXPECT_NE(PooledEngine(pool_, limited, scratch_ / "run", 20.0).pid(), one);
  EXPECT_EQ(run("").pid, one);
}

TEST_F(Pool, Leftovers_EachRunHasAProcessOfItsOwn) {
  const Ran first = run("leftover"), second = run("leftover");
  EXPECT_NE(first.pid, second.pid);
  EXPECT_EQ(first.force, forceAlone());
  EXPECT_EQ(second.force, forceAlone());
  EXPECT_EQ(pool_.reasonNotReused("toy"),
            "what it did after a second load is not what it did after the first");
}

TEST_F(Pool, CannotBeLoadedTwice_EachRunHasAProcessOfItsOwn) {
  EXPECT_EQ(run("once").force, forceAlone());
  EXPECT_EQ(run("once").force, forceAlone());
  EXPECT_NE(
      pool_.reasonNotReused("toy").find("it broke down while it was loaded twice: toy, toy at t "
                                        "= 0 s: ended (exit status 5) during load"),
      std::string::npos)
      << pool_.reasonNotReused("toy");
}

TEST_F(Pool, NoContactsSeen_IsNotReused) {
  const pid_t first = run("lonely").pid;
  EXPECT_NE(run("lonely").pid, first);
  EXPECT_EQ(pool_.reasonNotReused("toy"), "") << "nothing was seen against it either";
  EXPECT_EQ(pool_.loadsOf(kindOf("lonely")), WorkerPool::Loads::untried);
}

TEST_F(Pool, OnlyAsked_IsReused) {
  const pid_t asked = start("leftover")->pid();
  EXPECT_EQ(start("leftover")->pid(), asked);
  EXPECT_EQ(run("leftover").force, forceAlone());
}

TEST_F(Pool, FailedOrDiscarded_IsEnded) {
  pid_t pid = run("").pid;
  {
    const auto engine = start("");
    ASSERT_EQ(engine->pid(), pid);
    EXPECT_THROW(engine->load(test::toyScene(), {{"throw", true}}), EngineFailure);
  }
  Ran next = run("");
  EXPECT_NE(next.pid, pid) << "after a failure that the worker itself reported";
  start("")->discardWorker();
  EXPECT_NE(run("").pid, next.pid);
  pid = run("").pid;
  EXPECT_THROW(start("")->load(test::toyScene(), {{"refuse", true}}), UnsupportedScene);
  EXPECT_EQ(run("").pid, pid) << "a refusal is no failure";
}

TEST_F(Pool, DiedOrSpokeWhileWaiting_IsNotReused) {
  const pid_t pid = run("").pid;
  killAndSee(pid);
  const Ran next = run("");
  EXPECT_NE(next.pid, pid);
  EXPECT_EQ(next.force, forceAlone());

  // Its advance() says more than it was asked for.
  pool_.learn(kindOf("more"), WorkerPool::Loads::afresh);
  pid_t talker = -1;
  {
    const auto engine = start("more");
    talker = engine->pid();
    engine->load(test::toyScene(), {});
    engine->advance(0.5);
  }
  EXPECT_NE(start("more")->pid(), talker);
}

TEST_F(Pool, Log_IsInTheFolderOfItsRun) {
  pool_.learn(kindOf("print"), WorkerPool::Loads::afresh);  // no trial, in which it would print
  const std::string line = "{\"ok\":false} printed, not said\n";
  const pid_t pid = run("print", "a").pid;
  {
    const auto engine = start("print", "b");
    ASSERT_EQ(engine->pid(), pid);
    EXPECT_EQ(logOf("a"), line);
    EXPECT_EQ(logOf("b"), "");
    engine->load(test::toyScene(), {});
    engine->advance(0.5);
    engine->advance(0.6);
  }
  EXPECT_EQ(run("print", "c").pid, pid);
  EXPECT_EQ(logOf("a"), line);
  EXPECT_EQ(logOf("b"), line + line);
  EXPECT_EQ(logOf("c"), line);
}

TEST_F(Pool, LogIsNoFileAnyMore_WorkerIsNotReused) {
  const auto log = scratch_ / "a" / "toy.log";
  const auto victim = scratch_ / "victim";
  const std::vector<std::function<void()>> replacements = {
      [&] { fs::remove_all(log.parent_path()); },
      [&] {
        fs::remove(log);
        ASSERT_EQ(::mkfifo(log.c_str(), 0600), 0);
      },
      [&] {
        fs::remove(log);
        std::ofstream(victim) << "mine";
        fs::create_symlink(victim, log);
      }};
  for (const auto& replace : replacements) {
    const pid_t pid = run("", "a").pid;
    replace();
    EXPECT_NE(run("", "b").pid, pid);
    fs::remove_all(scratch_ / "a");
    killAndSee(run("", "b").pid);
  }
  EXPECT_EQ(fs::file_size(victim), 4u);
}

TEST_F(Pool, StartingThreadEnded_WorkerLives) {
  std::unique_ptr<PooledEngine> engine;
  std::thread([&] { engine = start(""); }).join();
  engine->load(test::toyScene(), {});
  EXPECT_NEAR(engine->advance(0.5), 0.5, 1e-12);
}

TEST(PoolEnd, Pool_LeavesNoChild) {
  const TemporaryFolder scratch;
  pid_t pid = -1;
  {
    WorkerPool pool;
    const WorkerPool::Kind kind{"toy",
                                {{fs::read_symlink("/proc/self/exe").string(), "--worker", ""}}};
    pid = PooledEngine(pool, kind, scratch.path(), 20.0).pid();
    EXPECT_EQ(::kill(pid, 0), 0) << "it waits";
  }
  EXPECT_EQ(::kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH) << "it has ended and was reaped";
}

}  // namespace
}  // namespace crossgrain
