#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace grain {

/// Into how many parts bodies are cut for so many threads: one with no body would be of no use.
inline std::size_t partCount(int threads, std::size_t bodies) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1,
                                 std::max<std::size_t>(bodies, 1));
}

/// Threads that do one thing together, part by part, again and again. They spin for a while between
/// two calls, as steps follow each other within microseconds, then give way to others, then sleep.
/// Where steps are short or processors are taken, one thread does all parts in less time: the team
/// tries both every few thousand steps, the slower for no longer than the other takes. The parts
/// are the same, and so are the results.
class ThreadTeam {
 public:
  /// @param now  the time [s], from anywhere
  explicit ThreadTeam(std::size_t parts, double (*now)() = steadyTime);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Does a step, in which work is shared out.
  template <class Step>
  void step(const Step& work) {
    if (threads_.empty()) return work();
    const double begin = now_();
    work();
    took(now_() - begin);
  }

  /// Calls work(part) for every part, part 0 on the calling thread, and waits for all of them.
  /// Throws what a part throws, the lowest part's first.
  template <class Work>
  void run(const Work& work) {
    runTask(
        {&work, [](const void* it, std::size_t part) { (*static_cast<const Work*>(it))(part); }});
  }

 private:
  static constexpr std::size_t trial = 64, retried = 32;  ///< [steps], [trials]

  /// A std::function would allocate for all but the smallest lambda, twice a step.
  struct Task {
    const void* work;
    void (*call)(const void* work, std::size_t part);
  };

  static double steadyTime();
  void took(double seconds);
  void runTask(const Task& task);
  void rethrow();
  void serve(std::size_t part);
  void finish(std::size_t part) noexcept;

  double (*now_)();
  Task task_{};
  std::atomic<std::uint32_t> round_{0}, pending_{0};
  std::atomic<bool> stop_{false};
  bool alone_ = false;  ///< the calling thread does all parts
  std::size_t steps_ = 0, trials_ = 0;
  double sum_ = 0.0, aloneTook_ = 0.0, togetherTook_ = 0.0;  ///< of a trial [s]
  std::vector<std::exception_ptr> thrown_;
  std::vector<std::jthread> threads_;
};

}  // namespace grain
