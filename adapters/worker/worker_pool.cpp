#include "adapters/worker/worker_pool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "adapters/worker/json.hpp"

namespace crossgrain {
namespace {

/// They hold the memory of their last scene.
constexpr std::size_t mostWaiting = 24;

/// Springs that a contact remembers act from the second step on; a leftover shows in the first.
constexpr double trialSteps = 10.0;

/// All that an engine shows after a few steps from a scene, compared to the bit.
struct LoadFingerprint {
  std::string words;
  std::vector<std::byte> arrays;
  std::uint64_t steps = 0, contactEvaluations = 0;
  bool contacts = false;
  bool operator==(const LoadFingerprint&) const = default;
};

LoadFingerprint fingerprintOf(Engine& engine, const EffectiveParameters& effective) {
  const Capabilities can = engine.capabilities();
  ContactReport report = ContactReport::none;
  if (can.instantContacts)
    report = ContactReport::instant;
  else if (can.accumulatedContacts)
    report = ContactReport::accumulated;
  engine.advance(trialSteps * effective.dt);
  const Snapshot seen = engine.snapshot(report);
  const Stats stats = engine.stats();
  ArrayWriter arrays;
  LoadFingerprint print{toJson(seen, arrays).dump(), arrays.bytes(), stats.steps,
                        stats.contactEvaluations};
  print.contacts = report == ContactReport::none || (seen.contacts && !seen.contacts->i.empty());
  return print;
}

}  // namespace

WorkerPool::~WorkerPool() {
  for (Waiting& each : waiting_) each.worker->dismiss();  // they end side by side
}

WorkerPool::Taken WorkerPool::take(const Kind& kind, const std::filesystem::path& scratch,
                                   double timeout) {
  for (;;) {
    Waiting found;
    {
      const std::scoped_lock lock(mutex_);
      // The last that was given back: its memory is the likeliest to be in cache.
      const auto last = std::ranges::find(waiting_.rbegin(), waiting_.rend(), kind, &Waiting::kind);
      if (last == waiting_.rend()) return {};
      const auto place = std::prev(last.base());
      found = std::move(*place);
      waiting_.erase(place);
    }
    if (!found.worker->isReady()) continue;  // no run's failure: its runs were over
    try {
      found.worker->moveTo(scratch, timeout);
      return {std::move(found.worker), found.loaded};
    } catch (const EngineFailure&) {
      // Its folder has gone; a new one takes its place.
    }
  }
}

void WorkerPool::giveBack(const Kind& kind, std::unique_ptr<WorkerEngine> worker, bool loaded) {
  Waiting tooMany;  // ends once the lock is no longer held
  const std::scoped_lock lock(mutex_);
  waiting_.push_back({kind, std::move(worker), loaded});
  if (waiting_.size() <= mostWaiting) return;
  tooMany = std::move(waiting_.front());
  waiting_.erase(waiting_.begin());
}

WorkerPool::Loads WorkerPool::loadsOf(const Kind& kind) const {
  const std::scoped_lock lock(mutex_);
  const auto known = std::ranges::find(known_, kind, &Known::kind);
  return known == known_.end() ? Loads::untried : known->loads;
}

void WorkerPool::learn(const Kind& kind, Loads loads, const std::string& why) {
  const std::scoped_lock lock(mutex_);
  const auto known = std::ranges::find(known_, kind, &Known::kind);
  if (known == known_.end())
    known_.push_back({kind, loads, why});
  else if (known->loads != Loads::notAfresh)  // seen once is enough
    *known = {kind, loads, why};
}

std::string WorkerPool::reasonNotReused(const std::string& name) const {
  const std::scoped_lock lock(mutex_);
  for (const Known& known : known_)
    if (known.kind.name == name && known.loads == Loads::notAfresh) return known.why;
  return {};
}

WorkerPool& workerPool() {
  static WorkerPool pool;
  return pool;
}

PooledEngine::PooledEngine(WorkerPool& pool, WorkerPool::Kind kind, std::filesystem::path scratch,
                           double timeout)
    : pool_(pool), kind_(std::move(kind)), scratch_(std::move(scratch)), timeout_(timeout) {
  auto [worker, loaded] = pool_.take(kind_, scratch_, timeout_);
  worker_ = worker ? std::move(worker) : startNew();
  loaded_ = loaded;
}

PooledEngine::~PooledEngine() {
  const bool sound = trusted_ && worker_->pid() >= 0;
  if (sound && (!loaded_ || pool_.loadsOf(kind_) == WorkerPool::Loads::afresh))
    pool_.giveBack(kind_, std::move(worker_), loaded_);
}

std::unique_ptr<WorkerEngine> PooledEngine::startNew() const {
  return std::make_unique<WorkerEngine>(kind_.name, kind_.call, scratch_, timeout_);
}

template <typename Work>
std::invoke_result_t<Work> PooledEngine::ask(Work&& work) const {
  try {
    return work();
  } catch (const UnsupportedScene&) {
    throw;
  } catch (...) {
    trusted_ = false;
    throw;
  }
}

EffectiveParameters PooledEngine::load(const Scene& scene, const Settings& settings) {
  return ask([&] {
    if (!loaded_ && pool_.loadsOf(kind_) == WorkerPool::Loads::untried)
      return loadTried(scene, settings);
    loaded_ = true;
    return worker_->load(scene, settings);
  });
}

EffectiveParameters PooledEngine::loadTried(const Scene& scene, const Settings& settings) {
  loaded_ = true;
  const EffectiveParameters effective = worker_->load(scene, settings);
  std::string why = "what it did after a second load is not what it did after the first";
  try {
    const LoadFingerprint first = fingerprintOf(*worker_, effective);
    const LoadFingerprint second = fingerprintOf(*worker_, worker_->load(scene, settings));
    if (first == second) {
      if (first.contacts) pool_.learn(kind_, WorkerPool::Loads::afresh);
      return worker_->load(scene, settings);
    }
  } catch (const std::runtime_error& failure) {
    // If it is not the loading that it broke down over, the run reports so itself.
    why = fmt::format("it broke down while it was loaded twice: {}", failure.what());
  }
  pool_.learn(kind_, WorkerPool::Loads::notAfresh, why);
  worker_ = startNew();
  return worker_->load(scene, settings);
}

/// Whether loads are afresh is tried in the plane alone: until then no other run gets the worker
/// of a scene in space.
EffectiveParameters PooledEngine::loadInSpace(const SpaceScene& scene, const Settings& settings) {
  return ask([&] {
    loaded_ = true;
    return worker_->loadInSpace(scene, settings);
  });
}

SpaceSnapshot PooledEngine::snapshotInSpace(ContactReport contacts) {
  return ask([&] { return worker_->snapshotInSpace(contacts); });
}

double PooledEngine::advance(double t) {
  return ask([&] { return worker_->advance(t); });
}

Snapshot PooledEngine::snapshot(ContactReport contacts) {
  return ask([&] { return worker_->snapshot(contacts); });
}

Stats PooledEngine::stats() const {
  return ask([&] { return worker_->stats(); });
}

void PooledEngine::checkpoint(const std::filesystem::path& file) {
  ask([&] { worker_->checkpoint(file); });
}

void PooledEngine::restore(const std::filesystem::path& file) {
  ask([&] { worker_->restore(file); });
}

}  // namespace crossgrain
