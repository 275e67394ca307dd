#include "engines/grain/thread_team.hpp"

#include <chrono>
#include <utility>

namespace grain {
namespace {

/// Waits until `value` is no longer `old`.
void waitWhile(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  constexpr int spins = 2000, turns = 200;  // some 50 µs, and where cores are taken some more
  for (int spin = 0; spin < spins; ++spin) {
    if (value.load(std::memory_order_acquire) != old) return;
    __builtin_ia32_pause();
  }
  for (int turn = 0; turn < turns; ++turn) {
    if (value.load(std::memory_order_acquire) != old) return;
    std::this_thread::yield();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

double ThreadTeam::steadyTime() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ThreadTeam::ThreadTeam(std::size_t parts, double (*now)()) : now_(now), thrown_(parts) {
  for (std::size_t part = 1; part < parts; ++part)
    threads_.emplace_back([this, part] { serve(part); });
}

ThreadTeam::~ThreadTeam() {
  stop_.store(true, std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
}

/// Keeps to what took less when last tried, and tries the other from time to time, for no longer
/// than the kept one took: threads may be many times slower where others have the processors.
/// Means, as what others take of a processor is seldom and long.
void ThreadTeam::took(double seconds) {
  sum_ += seconds;
  const bool trying = trials_ % retried == 0;
  const double kept = alone_ ? togetherTook_ : aloneTook_;  // at first it is 0
  if (++steps_ < trial && !(trying && kept > 0.0 && sum_ > kept)) return;
  steps_ = 0;
  (alone_ ? aloneTook_ : togetherTook_) = std::exchange(sum_, 0.0);
  alone_ = aloneTook_ < togetherTook_;
  if (++trials_ % retried == 0) alone_ = !alone_;
}

void ThreadTeam::runTask(const Task& task) {
  if (threads_.empty()) return task.call(task.work, 0);
  task_ = task;
  if (alone_) {
    for (std::size_t part = 0; part < thrown_.size(); ++part) finish(part);
    return rethrow();
  }
  pending_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  finish(0);
  for (std::uint32_t left; (left = pending_.load(std::memory_order_acquire)) != 0;)
    waitWhile(pending_, left);
  rethrow();
}

void ThreadTeam::rethrow() {
  std::exception_ptr first;
  for (std::exception_ptr& thrown : thrown_) {
    if (!first) first = thrown;
    thrown = nullptr;
  }
  if (first) std::rethrow_exception(first);
}

void ThreadTeam::serve(std::size_t part) {
  for (std::uint32_t round = 0;; ++round) {
    waitWhile(round_, round);
    if (stop_.load(std::memory_order_relaxed)) return;
    finish(part);
    pending_.fetch_sub(1, std::memory_order_release);
    pending_.notify_one();
  }
}

void ThreadTeam::finish(std::size_t part) noexcept {
  try {
    task_.call(task_.work, part);
  } catch (...) {
    thrown_[part] = std::current_exception();
  }
}

}  // namespace grain
