#include "adapters/worker/worker_engine.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <optional>
#include <span>
#include <system_error>
#include <thread>

#include "adapters/worker/answer.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "support/busy_time.hpp"
#include "support/descriptor.hpp"
#include "support/interrupt.hpp"
#include "support/regular_file.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

/// Most ids of a scene whose array file is kept: a larger scene has a long one, which takes longer
/// to spoil than a new one to make.
constexpr std::size_t mostBodiesOfKept = 10'000;

/// Longest array file that a listener gets of an exchange [bytes]. A longer one, or one that is no
/// regular file, it does not get.
constexpr std::size_t longestKeptFile = std::size_t{1} << 30;

std::string keptContent(const std::filesystem::path& file) {
  const RegularFile in(file);
  if (in.size() > longestKeptFile) return {};
  std::string content(in.size(), '\0');
  content.resize(in.read(0, std::as_writable_bytes(std::span(content))));
  return content;
}

/// Renames the log of a worker that goes on to another run and keeps writing to the same file: the
/// file gets the name `to`, and its lines so far stay, as a copy, under `from`. So the log of a run
/// holds the lines of that run.
/// @pre the worker appends to it
/// @throws std::runtime_error if `from` is no file of text any more, or `to` is on another disk
void moveLog(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (from == to) return;
  const auto require = [&](bool done) {
    if (!done)
      throw std::runtime_error(
          fmt::format("{}: {}", from.string(), std::generic_category().message(errno)));
  };
  // The worker may have put anything there: of a link the target would be cut, and a pipe would
  // block the caller.
  const Descriptor log(::open(from.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  require(log.get() >= 0 && ::fstat(log.get(), &status) == 0);
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(from.string() + ": is no regular file");
  require(::rename(from.c_str(), to.c_str()) == 0);
  if (status.st_size == 0) return;
  std::filesystem::copy_file(to, from);
  require(::ftruncate(log.get(), 0) == 0);
}

/// Ends the exchange, also where an exception leaves it.
class Exchanging {
 public:
  explicit Exchanging(ExchangeFile& file) : file_(file) {}
  ~Exchanging() { file_.done(); }
  Exchanging(const Exchanging&) = delete;
  Exchanging& operator=(const Exchanging&) = delete;

 private:
  ExchangeFile& file_;
};

/// Message where the harness, not the answer, is at fault.
std::string noMemoryFor(const std::string& what) {
  return fmt::format("crossgrain is out of memory while it reads the answer to {}", what);
}

}  // namespace

template <typename Read>
std::invoke_result_t<Read> WorkerEngine::understand(const std::string& what, Read&& read) const {
  try {
    return read();
  } catch (const UnsupportedScene&) {
    throw;
  } catch (const EngineFailure&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail(noMemoryFor(what));
  } catch (const std::exception& error) {
    fail(fmt::format("its answer to {} is unusable: {}", what,
                     asOneLine(withoutPrefix(error.what()), longestReason)));
  }
}

WorkerEngine::WorkerEngine(std::string name, const ProgramCall& call, std::filesystem::path scratch,
                           double timeout, ExchangeListener listener)
    : name_(std::move(name)),
      scratch_(std::filesystem::absolute(scratch)),
      log_(scratch_ / (name_ + ".log")),
      timeout_(timeout),
      memory_(call.memory),
      listener_(std::move(listener)),
      exchangeFile_(std::make_unique<ExchangeFile>(scratch_ / name_)) {
  try {
    std::filesystem::create_directories(scratch_);
    process_ = std::make_unique<ChildProcess>(call, log_);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  const json reply = ask({{"request", "hello"}, {"protocol", protocolVersion}}, "hello");
  capabilities_ = understand("hello", [&] {
    const int spoken = reply.at("protocol");
    if (spoken != protocolVersion)
      throw std::runtime_error(
          fmt::format("it speaks protocol {}, this program speaks {}", spoken, protocolVersion));
    writesOver_ = reply.value("writes_over", false);
    return readAs<Capabilities>(reply.at("capabilities"));
  });
  if (!call.stamp.empty()) capabilities_.version += fmt::format(" ({})", call.stamp);
}

WorkerEngine::~WorkerEngine() {
  dismiss();
  if (process_) process_->waitForExit(1s);
}

void WorkerEngine::dismiss() {
  if (!process_ || dismissed_) return;
  dismissed_ = true;
  try {
    process_->sendLine(R"({"request":"quit"})", ChildProcess::Clock::now() + 100ms);
  } catch (const std::exception&) {
    // The worker is ended whether or not it reads this.
  }
  process_->closeInput();
}

bool WorkerEngine::isReady() const {
  return process_ && process_->isAlive() && process_->unasked().empty();
}

void WorkerEngine::moveTo(const std::filesystem::path& scratch, double timeout) {
  shape_ = {};
  shapeInSpace_ = {};
  sceneName_.clear();
  time_ = 0.0;
  goodTime_.reset();
  scratch_ = std::filesystem::absolute(scratch);
  timeout_ = timeout;
  const std::filesystem::path log = scratch_ / (name_ + ".log");
  try {
    std::filesystem::create_directories(scratch_);
    moveLog(log_, log);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  log_ = log;
  exchangeFile_ = std::make_unique<ExchangeFile>(scratch_ / name_);
}

EffectiveParameters WorkerEngine::load(const Scene& scene, const Settings& settings) {
  shape_ = scene;
  return loadShape(scene, settings);
}

EffectiveParameters WorkerEngine::loadInSpace(const SpaceScene& scene, const Settings& settings) {
  shapeInSpace_ = scene;
  return loadShape(scene, settings);
}

template <int D>
EffectiveParameters WorkerEngine::loadShape(const SceneOf<D>& scene, const Settings& settings) {
  sceneName_ = scene.name;
  time_ = 0.0;
  goodTime_.reset();
  // A recording needs a file of its own for each exchange: a kept one stays as long as it once was.
  keepsFile_ = writesOver_ && !listener_ && scene.idCount() <= mostBodiesOfKept;
  const Exchanging exchanging(*exchangeFile_);
  ArrayWriter arrays;
  json request = {
      {"request", "load"}, {"scene", toJson(scene, arrays)}, {"settings", jsonOf(settings)}};
  try {
    request["file"] = exchangeFile_->next(keepsFile_).string();
    request["arrays"] = exchangeFile_->write(arrays);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  const json reply = ask(request, "load");
  return understand("load", [&] {
    auto effective = readAs<EffectiveParameters>(reply.at("realised"));
    // A smaller step is a mistake: a run of such steps would never end.
    if (!(effective.dt >= 1e-6 * scene.dt))
      throw std::runtime_error(fmt::format("dt = {:g} s is no time step, with {:g} s in the scene",
                                           effective.dt, scene.dt));
    return effective;
  });
}

double WorkerEngine::advance(double t) {
  const std::string what = fmt::format("advance(t = {} s)", t);
  const BusyTime::Piece stepping(steppingTime());
  const json reply = ask({{"request", "advance"}, {"time", t}}, what);
  time_ = understand(what, [&] { return reply.at("time").get<double>(); });
  return time_;
}

Snapshot WorkerEngine::snapshot(ContactReport contacts) {
  return snapshotOf(shape_, contacts);
}

SpaceSnapshot WorkerEngine::snapshotInSpace(ContactReport contacts) {
  return snapshotOf(shapeInSpace_, contacts);
}

template <int D>
SnapshotOf<D> WorkerEngine::snapshotOf(const SceneOf<D>& shape, ContactReport contacts) {
  const Exchanging exchanging(*exchangeFile_);
  json request = {{"request", "snapshot"}, {"contacts", jsonOf(contacts)}};
  try {
    request["file"] = exchangeFile_->next(keepsFile_).string();
  } catch (const std::exception& error) {
    fail(error.what());
  }
  const json reply = ask(request, "snapshot");
  SnapshotOf<D> snapshot = understand("snapshot", [&] {
    return snapshotFromJson(reply.at("snapshot"), exchangeFile_->read(reply.at("arrays")), shape);
  });
  goodTime_ = snapshot.positionTime;
  return snapshot;
}

Stats WorkerEngine::stats() const {
  const json reply = ask({{"request", "stats"}}, "stats");
  return understand("stats", [&] { return statsFromJson(reply.at("stats")); });
}

void WorkerEngine::checkpoint(const std::filesystem::path& file) {
  ask({{"request", "checkpoint"}, {"file", file.string()}}, "checkpoint");
}

void WorkerEngine::restore(const std::filesystem::path& file) {
  ask({{"request", "restore"}, {"file", file.string()}}, "restore");
}

/// Paths are sent as absolute ones: a worker need not be in this process' folder.
json WorkerEngine::ask(json request, const std::string& what) const {
  if (!process_) throw EngineFailure(firstFailure_);
  if (const auto file = request.find("file"); file != request.end())
    *file = std::filesystem::absolute(file->get<std::string>()).string();
  json reply = exchange(request, what);
  understand(what, [&] {
    if (reply.at("ok").get<bool>()) return requireAnswerTo(request.at("request"), reply);
    const std::string reason = asOneLine(reply.at("what"), longestReason);
    if (reply.at("kind") == "unsupported") throw UnsupportedScene(reason);
    throw EngineFailure(failure(reason));
  });
  return reply;
}

json WorkerEngine::exchange(const json& request, const std::string& what) const {
  if (!listener_) return answerTo(request, what);
  Exchange heard{request, {}, {}, {}, {}};
  const auto file = request.value("file", std::string());
  if (request.at("request") == "load") heard.sent = keptContent(file);
  try {
    heard.answer = answerTo(request, what);
  } catch (const EngineFailure& failure) {
    heard.failure = failure.what();
    listener_(heard);
    throw;
  }
  if (request.at("request") == "snapshot") heard.received = keptContent(file);
  listener_(heard);
  return heard.answer;
}

json WorkerEngine::answerTo(const json& request, const std::string& what) const {
  const auto deadline =
      ChildProcess::Clock::now() + std::chrono::duration_cast<ChildProcess::Clock::duration>(
                                       std::chrono::duration<double>(timeout_));
  if (const std::string extra = process_->unasked(); !extra.empty())
    fail(fmt::format("before {} it answered what nobody had asked: '{}'", what,
                     asOneLine(extra, 60)));
  std::string line;
  try {
    process_->sendLine(request.dump(), deadline);
    line = receive(deadline);
  } catch (const ProcessTimeout&) {
    fail(fmt::format("no answer within {} s to {}", timeout_, what));
  } catch (const ProcessEnded&) {
    fail(howItEnded(what));
  } catch (const OversizedMessage&) {
    fail(fmt::format("its answer to {} is longer than {} MiB", what, longestAnswer >> 20));
  }
  try {
    return parseAnswer(line);
  } catch (const std::bad_alloc&) {
    fail(noMemoryFor(what));
  } catch (const std::exception& error) {
    fail(fmt::format("its answer to {} {}", what, error.what()));
  }
}

std::string WorkerEngine::receive(ChildProcess::Clock::time_point deadline) const {
  constexpr int slices = 4, most = 100;  // of the time-out; times the time-out
  constexpr double lastPiece = 10.0;     // of work, after an interrupt [s]
  double usedWhenLate = 0.0;
  std::optional<double> usedWhenStopped;
  const auto activity = [&] {
    GroupActivity now = activityOf(process_->pid());
    // A computing worker sleeps for moments too, between two pieces of work.
    for (int look = 0; look < 5 && !now.computes; ++look) {
      std::this_thread::sleep_for(10ms);
      now = activityOf(process_->pid());
    }
    return now;
  };
  for (int k = 0;; ++k) {
    try {
      return process_->receiveLine(deadline, longestAnswer);
    } catch (const Interrupted&) {
      // A worker that computes may end its piece, so that the run keeps its progress. CPU time is
      // the limit, as the machine may be loaded.
      const GroupActivity now = activity();
      if (!usedWhenStopped) usedWhenStopped = now.cpuSeconds;
      if (!now.computes || now.cpuSeconds - *usedWhenStopped >= lastPiece) throw;
    } catch (const ProcessTimeout&) {
      const GroupActivity now = activity();
      if (k == 0) usedWhenLate = now.cpuSeconds;
      if (!now.computes || now.cpuSeconds - usedWhenLate >= timeout_ || k >= most * slices) throw;
      deadline += std::chrono::duration_cast<ChildProcess::Clock::duration>(
          std::chrono::duration<double>(timeout_ / slices));
    }
  }
}

std::string WorkerEngine::where() const {
  if (sceneName_.empty()) return name_;
  return fmt::format("{}, {} at t = {} s", name_, sceneName_, time_);
}

std::string WorkerEngine::failure(const std::string& what) const {
  const std::string before =
      goodTime_ ? fmt::format(" (last good snapshot: t = {} s)", *goodTime_) : "";
  return fmt::format("{}: {}{}", where(), what, before);
}

std::string WorkerEngine::howItEnded(const std::string& what) const {
  const bool ended = process_->waitForExit(1s);
  const std::string how =
      ended ? fmt::format("ended ({})", process_->exitText()) : "closed its descriptors";
  const std::string words = lastWords(log_);
  const std::string limit =
      memory_ > 0 ? fmt::format("; its memory is limited to {:g} bytes", double(memory_)) : "";
  return fmt::format("{} during {}{}{}{}", how, what, words.empty() ? "" : "; ", words, limit);
}

void WorkerEngine::fail(const std::string& what) const {
  firstFailure_ = failure(what);
  process_.reset();
  throw EngineFailure(firstFailure_);
}

}  // namespace crossgrain
