#include "adapters/worker/worker_engine.hpp"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <string_view>
#include <thread>

#include "adapters/worker/answer.hpp"
#include "support/interrupt.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/worker/toy_engine.hpp"

namespace crossgrain {
namespace {

using Seconds = std::chrono::duration<double>;

std::vector<std::string> toyCommand(const std::string& mischief) {
  return {std::filesystem::read_symlink("/proc/self/exe").string(), "--worker", mischief};
}

class Worker : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::filesystem::path scratch_ = folder_.path() / "worker";

  std::unique_ptr<WorkerEngine> start(const std::string& mischief, double timeout = 20.0) {
    return std::make_unique<WorkerEngine>("toy", toyCommand(mischief), scratch_, timeout);
  }

  template <typename Failure = EngineFailure>
  static std::string failureOf(const auto& action) {
    return test::refusalOf<Failure>(action);
  }

  std::set<std::string> filesLeft() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scratch_))
      names.insert(entry.path().filename());
    return names;
  }

  /// Error of advance() to 0.5 s.
  std::string advanceFailure(const std::string& mischief, double timeout = 20.0) {
    const auto engine = start(mischief, timeout);
    engine->load(test::toyScene(), {});
    const std::string failure = failureOf([&] { engine->advance(0.5); });
    EXPECT_EQ(failureOf([&] { engine->advance(0.6); }), failure);
    EXPECT_EQ(engine->pid(), -1);
    return failure;
  }

  std::string snapshotFailure(const std::string& mischief) {
    const auto engine = start(mischief);
    engine->load(test::toyScene(), {});
    return failureOf([&] { engine->snapshot(ContactReport::instant); });
  }
};

TEST_F(Worker, Run_IsTheEnginesOwnToTheBit) {
  auto worker = start("");
  test::ToyEngine direct;
  EXPECT_EQ(worker->capabilities().version, direct.capabilities().version);
  for (int run = 0; run < 2; ++run) {
    EXPECT_EQ(worker->load(test::toyScene(), {}).dt, direct.load(test::toyScene(), {}).dt);
    for (const double t : {0.1, 1.0 / 3.0}) {
      EXPECT_EQ(worker->advance(t), direct.advance(t));
      const Snapshot a = worker->snapshot(ContactReport::instant);
      const Snapshot b = direct.snapshot(ContactReport::instant);
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(a.velocity, b.velocity);
      EXPECT_EQ(a.wallPosition, b.wallPosition);
      EXPECT_EQ(a.contacts->normal, b.contacts->normal);
      EXPECT_EQ(a.contacts->overlap, b.contacts->overlap);
      EXPECT_EQ(a.bodies[0].force, b.bodies[0].force);
    }
    EXPECT_EQ(worker->stats().steps, direct.stats().steps);
  }
  EXPECT_EQ(filesLeft(), (std::set<std::string>{"toy.bin", "toy.log"}));
  worker.reset();
  EXPECT_EQ(filesLeft(), std::set<std::string>{"toy.log"});
}

TEST_F(Worker, DoesNotWriteOver_HasANewFileForEachExchange) {
  const auto worker = start("cuts");
  worker->load(test::toyScene(), {});
  EXPECT_EQ(worker->snapshot(ContactReport::instant).position.size(), 2u);
  EXPECT_EQ(worker->snapshot(ContactReport::none).position.size(), 2u);
  EXPECT_EQ(filesLeft(), std::set<std::string>{"toy.log"});
}

TEST_F(Worker, ThatEnded_IsReportedWithItsLastWords) {
  const std::string ended = "toy, toy at t = 0 s: ended (", during = ") during advance(t = 0.5 s)";
  for (const auto& [mischief, how, words] : {
           std::tuple("exit", "exit status 3", std::string()),
           {"die", "signal 6 (Aborted)",
            "; the end of its log: first line | assertion failed: mass > 0"},
           {"traceback", "exit status 1", "; its error: KeyError: 'HOME'"},
           {"log", "exit status 3",
            "; the end of its log: " + std::string(200, 'y') + " … | last words"},
           {"disk", "signal 25 (File size limit exceeded)", ""},
       })
    EXPECT_EQ(advanceFailure(mischief), ended + how + during + words);
}

TEST_F(Worker, AnswerToAdvanceThatCannotBe_IsRefused) {
  for (const auto& [mischief, reason] : {
           std::pair("garbage", "is not a JSON object: 'Welcome to the engine!'"),
           {"deep", "has more than 16 objects and lists in each other"},
           {"endless", "is longer than 8 MiB"},
           {"order", "is unusable: it has 'stats', which answers stats, and no 'time'"},
           {"typo", "is unusable: it has no 'time' (it has: ok, tmie)"},
           {"type", "is unusable: type must be number, but is string"},
           {"twice", "has the key 'time' twice in one object"},
       })
    EXPECT_EQ(advanceFailure(mischief),
              std::string("toy, toy at t = 0 s: its answer to advance(t = 0.5 s) ") + reason);
  const auto engine = start("more");
  engine->load(test::toyScene(), {});
  engine->advance(0.5);
  EXPECT_EQ(failureOf([&] { engine->advance(0.6); }),
            "toy, toy at t = 0.5 s: before advance(t = 0.6 s) it answered what nobody had asked: "
            "'{\"ok\":true,\"time\":0.6}'");
}

TEST_F(Worker, SnapshotThatCannotBe_IsRefused) {
  for (const auto& [mischief, reason] : {
           std::pair("nan", "toy.bin: velocity[2] is nan"),
           {"few", "toy.bin: position is 2 × f64, expected 4 × f64"},
           {"ids", "contact 0 is of 0 and 99, not of 0 ≤ i < j < 5"},
           {"short",
            "toy-2.bin is too short: position needs 4 × 8 bytes from byte 0, the file has 8 bytes"},
           {"pipe", "toy-2.bin is not a regular file"},
           {"device", "toy-2.bin is not a regular file"},
           // The file does have that many, and takes no room: all but its beginning is a hole.
           {"many", "it lists 500000000 contacts, more than 500 of 5 bodies"},
           // Nothing that it wrote before is taken, nor its own file under that name.
           {"forgets", "toy.bin: position[0] is -nan"},
           {"replaces", "toy.bin: position[0] is -nan"},
       })
    EXPECT_EQ(snapshotFailure(mischief),
              std::string("toy, toy at t = 0 s: its answer to snapshot is unusable: ") + reason);
}

TEST_F(Worker, AnswerToHelloOrLoadThatCannotBe_IsRefused) {
  for (const auto& [mischief, reason] : {
           std::pair("option",
                     "unknown law option 'colour' (there are: normal, damper, tangential, tension, "
                     "coulomb_bound, dashpot, spring_reset, spring_update, lever_arm, "
                     "velocity_arm, plane_arm, history, damping_velocity, integrator, rolling, "
                     "rolling_length, rolling_stiffness, rolling_damper, rolling_load, "
                     "rolling_dashpot, rolling_reset, cohesion, cohesion_area, jkr_end, "
                     "cohesion_load, unloading_stiffness, spring_turn, spring_twist)"),
           {"value", "tension cannot be 'red' (it is one of: allow, cut)"},
           {"no value", "tension has no value"},
       })
    EXPECT_EQ(failureOf([&] { start(mischief); }),
              std::string("toy: its answer to hello is unusable: law_options: ") + reason);
  EXPECT_EQ(failureOf([&] { start("step")->load(test::toyScene(), {}); }),
            "toy, toy at t = 0 s: its answer to load is unusable: dt = 0 s is no time step, with "
            "4e-05 s in the scene");
}

TEST_F(Worker, Refusal_IsPassedOnInBoundsAndTheWorkerLivesOn) {
  const auto worker = start("");
  const auto refusal = [&](const SettingValue& reason) {
    return failureOf<UnsupportedScene>([&] {
      worker->load(test::toyScene(), {{"refuse", reason}});
    });
  };
  EXPECT_EQ(refusal(true), "has no such thing");
  EXPECT_EQ(refusal(std::string(1'000'000, 'x') + "\nmore"),
            std::string(longestReason, 'x') + " …");
  EXPECT_EQ(failureOf([&] {
              worker->load(test::toyScene(), {{"throw", true}});
            }),
            "toy, toy at t = 0 s: could not allocate");
  worker->load(test::toyScene(), {});
  EXPECT_NEAR(worker->advance(0.5), 0.5, 1e-12);
}

// Begins to compute within the time-out and takes longer, by less processor time than that.
TEST_F(Worker, ThatIsLateAndComputes_GetsAsMuchProcessorTimeAgain) {
  const auto late = start("slow", 0.4);
  late->load(test::toyScene(), {});
  EXPECT_NEAR(late->advance(0.5), 0.5, 1e-12);
  EXPECT_EQ(advanceFailure("spin", 0.4),
            "toy, toy at t = 0 s: no answer within 0.4 s to advance(t = 0.5 s)");
}

TEST_F(Worker, ThatHangs_IsKilled) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(advanceFailure("hang", 1.0),
            "toy, toy at t = 0 s: no answer within 1 s to advance(t = 0.5 s)");
  const Seconds took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(took.count(), 1.0);
  EXPECT_LT(took.count(), 60.0);  // on however busy a machine
}

TEST_F(Worker, PipeOrLinkInTheScratchFolder_HoldsNobody) {
  const auto engine = start("exit");
  const auto victim = scratch_ / "victim";
  std::ofstream(victim) << "mine";
  ASSERT_EQ(::mkfifo((scratch_ / "toy.bin").c_str(), 0600), 0);
  engine->load(test::toyScene(), {});
  EXPECT_TRUE(std::filesystem::is_regular_file(scratch_ / "toy.bin"));
  const auto cutter = start("cuts");
  ASSERT_EQ(::mkfifo((scratch_ / "toy-1.bin").c_str(), 0600), 0);
  cutter->load(test::toyScene(), {});
  std::filesystem::create_symlink(victim, scratch_ / "toy-2.bin");
  cutter->load(test::toyScene(), {});
  EXPECT_EQ(std::filesystem::file_size(victim), 4u);
  const auto log = scratch_ / "toy.log";
  std::filesystem::remove(log);
  ASSERT_EQ(::mkfifo(log.c_str(), 0600), 0);
  EXPECT_EQ(failureOf([&] { engine->advance(0.5); }),
            "toy, toy at t = 0 s: ended (exit status 3) during advance(t = 0.5 s)");
  EXPECT_EQ(failureOf([&] { start("")->load(test::toyScene(), {}); }), "");
}

TEST_F(Worker, BeyondItsMemory_Ends) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's shadow takes all address space there is";
#endif
  ProgramCall call = toyCommand("memory");
  call.memory = std::uint64_t{1} << 30;
  WorkerEngine engine("toy", call, scratch_, 20.0);
  engine.load(test::toyScene(), {});
  EXPECT_EQ(failureOf([&] { engine.advance(0.5); }),
            "toy, toy at t = 0 s: ended (exit status 4) during advance(t = 0.5 s); its memory is "
            "limited to 1.07374e+09 bytes");
}

TEST_F(Worker, Prints_GoToTheLog) {
  {
    const auto worker = start("print");
    worker->load(test::toyScene(), {});
    EXPECT_NEAR(worker->advance(0.5), 0.5, 1e-12);
  }
  std::ifstream log(scratch_ / "toy.log");
  std::string line;
  std::getline(log, line);
  EXPECT_EQ(line, "{\"ok\":false} printed, not said");
}

TEST_F(Worker, ThatCannotBeStarted_SaysWhy) {
  EXPECT_EQ(failureOf([&] { WorkerEngine("toy", {{"/no/such/program"}}, scratch_, 1.0); }),
            "toy: cannot start /no/such/program: No such file or directory");
  EXPECT_EQ(failureOf([&] { WorkerEngine("toy", {{"true"}}, scratch_, 5.0); }),
            "toy: ended (exit status 0) during hello");
}

TEST_F(Worker, Ended_LeavesNoChild) {
  { const auto worker = start(""); }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(Worker, Ended_LeavesNoGrandchild) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);  // orphans come to this process
  for (const char* mischief : {"offspring", "daemon"}) {
    SCOPED_TRACE(mischief);
    {
      const auto worker = start(mischief);
      worker->load(test::toyScene(), {});
      worker->advance(0.5);
    }
    // The daemon's parent, which ended by itself, is an orphan, too.
    int killed = 0, status = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (killed == 0 && std::chrono::steady_clock::now() < deadline)
      if (::waitpid(-1, &status, WNOHANG) > 0)
        killed += WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(killed, 1);
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

// Processes that end while they are looked at, some between the opening of a file of theirs and its
// reading: on two processors a hundred searches meet dozens.
TEST_F(Worker, ProcessesThatEndDuringTheSearch_AreNoFailure) {
  std::vector<pid_t> shells;
  for (int k = 0; k < 4; ++k) {
    shells.push_back(::fork());
    if (shells.back() == 0) {
      ::setpgid(0, 0);
      ::execl("/bin/sh", "sh", "-c", "while :; do (exit 0) & wait; done", nullptr);
      ::_exit(127);
    }
    ::setpgid(shells.back(), shells.back());
  }
  for (int search = 0; search < 100; ++search) {
    EXPECT_NO_THROW(killMarkedProcesses("nobody's"));
    EXPECT_NO_THROW(activityOf(shells.front()));
  }
  for (const pid_t shell : shells) {
    ::kill(-shell, SIGKILL);
    EXPECT_EQ(::waitpid(shell, nullptr, 0), shell);
  }
}

// A daemon that is born between the list of all processes and the look at its parent, which has
// ended by then: one search finds neither, a hundred times of a hundred.
TEST_F(Worker, DaemonBornDuringTheSearch_IsKilled) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  ASSERT_EQ(::setenv(workerMark, "test", 1), 0);
  for (int repeat = 0; repeat < 20; ++repeat) {
    int go[2], born[2];
    ASSERT_EQ(::pipe(go), 0);
    ASSERT_EQ(::pipe(born), 0);
    // A process has the environment that it was started with: a shell is started with the mark.
    const pid_t parent = ::fork();
    if (parent == 0) {
      ::dup2(go[0], 0);
      ::dup2(born[1], 1);
      ::execl("/bin/sh", "sh", "-c", "read line; (exec sleep 1000) & echo $!", nullptr);
      ::_exit(127);
    }
    pid_t daemon = 0;
    const auto letBearAndEnd = [&] {
      if (daemon != 0) return;
      ASSERT_EQ(::write(go[1], "\n", 1), 1);
      char text[16] = {};
      ASSERT_GT(::read(born[0], text, sizeof text - 1), 0);
      daemon = std::atoi(text);
      ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
    };
    killMarkedProcesses("test", letBearAndEnd);
    ASSERT_GT(daemon, 0);
    ::kill(daemon, SIGTERM);  // so that a failure does not wait: of two signals SIGKILL is first
    int status = 0;
    EXPECT_EQ(::waitpid(daemon, &status, 0), daemon);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    for (const int end : {go[0], go[1], born[0], born[1]}) ::close(end);
  }
  ::unsetenv(workerMark);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(Worker, ParentKilled_Dies) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  int channel[2];
  ASSERT_EQ(::pipe(channel), 0);
  const pid_t parent = ::fork();
  if (parent == 0) {
    const auto worker = start("hang");
    worker->load(test::toyScene(), {});
    const pid_t pid = worker->pid();
    if (::write(channel[1], &pid, sizeof pid) != sizeof pid) ::_exit(1);
    worker->advance(0.5);
    ::_exit(0);
  }
  pid_t worker = -1;
  ASSERT_EQ(::read(channel[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  // Once it hangs it no longer sees its requests end: only the kernel can stop it.
  std::string line;
  while (line != "hanging") {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::ifstream log(scratch_ / "toy.log");
    std::getline(log, line);
  }
  ::kill(parent, SIGKILL);
  ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
  int status = 0;
  ASSERT_EQ(::waitpid(worker, &status, 0), worker);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  ::close(channel[0]);
  ::close(channel[1]);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(Worker, LastWords_AreTheErrorAndNotWhatMpiPrintsAroundIt) {
  std::filesystem::create_directories(scratch_);
  const auto wordsOf = [&](const std::string& log) {
    std::ofstream(scratch_ / "log") << log;
    return lastWords(scratch_ / "log");
  };
  const std::string around =
      "----------------------------------------\n"
      "MPI_ABORT was invoked on rank 0 in communicator MPI_COMM_WORLD\nwith errorcode 1.\n\n"
      "NOTE: invoking MPI_ABORT causes Open MPI to kill all MPI processes.\n"
      "You may or may not see output from other processes, depending on\n"
      "exactly when Open MPI kills them.\n----------------------------------------\n";
  EXPECT_EQ(wordsOf("reading\nERROR on proc 0: Failed to allocate 8 bytes\n" + around),
            "its error: ERROR on proc 0: Failed to allocate 8 bytes");
  EXPECT_EQ(wordsOf("placed 3 atoms\n" + around), "the end of its log: placed 3 atoms");
  EXPECT_EQ(wordsOf("[vm:12] *** Process received signal ***\n[vm:12] Signal: Segmentation fault\n"
                    "[vm:12] [ 0] /lib/libc.so.6(+0x3c050)[0x7f]\n[vm:12] *** End of error message "
                    "***\n"),
            "");
}

// In a process of its own, as what was interrupted stays so.
TEST_F(Worker, Interrupted_EndsTheWaitForAnAnswer) {
  std::filesystem::create_directories(scratch_);
  const auto waited = [&] {
    catchInterrupts();
    ChildProcess silent(std::vector<std::string>{"/bin/sleep", "60"}, scratch_ / "silent.log");
    ::raise(SIGTERM);
    try {
      silent.receiveLine(ChildProcess::Clock::now() + std::chrono::seconds(60), 1000);
    } catch (const Interrupted&) {
      return 130;
    } catch (const ProcessTimeout&) {
      return 1;
    }
    return 2;
  };
  EXPECT_EXIT(::_exit(waited()), ::testing::ExitedWithCode(130), "");
}

TEST_F(Worker, RequestsEnd_EndsThoughASiblingLives) {
  std::filesystem::create_directories(scratch_);
  ChildProcess first(toyCommand(""), scratch_ / "first.log");
  ChildProcess second(toyCommand(""), scratch_ / "second.log");
  first.closeInput();  // unless the second inherited our end, the first now reads its end
  EXPECT_TRUE(first.waitForExit(std::chrono::seconds(60)));
  EXPECT_EQ(first.exitText(), "exit status 0");
}

}  // namespace
}  // namespace crossgrain

// The test program is also the worker that it tests.
int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--worker")
    return crossgrain::test::toyWorker(argv[2]);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
