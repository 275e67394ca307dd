#include "adapters/worker/worker_pool.hpp"

#include <algorithm>
#include <iterator>

namespace crossgrain {
namespace {

/// They hold the memory of their last scene.
constexpr std::size_t mostWaiting = 24;

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
    if (!found.worker->isReady()) continue;  // nobody's failure: its runs were over
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

std::string WorkerPool::whyAlwaysNew(const std::string& name) const {
  const std::scoped_lock lock(mutex_);
  for (const Known& known : known_)
    if (known.kind.name == name && known.loads == Loads::notAfresh) return known.why;
  return {};
}

WorkerPool& workerPool() {
  static WorkerPool pool;
  return pool;
}

}  // namespace crossgrain
