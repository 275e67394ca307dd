#include "tests/bench/stream.hpp"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <map>
#include <thread>
#include <vector>

namespace crossgrain::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t length = std::size_t{1} << 24;
constexpr int passes = 30;

double measure(int threads) {
  std::vector<double> a(length), b(length, 1.0), c(length, 2.0);
  std::vector<Clock::time_point> time;
  std::barrier pass(threads, [&time]() noexcept { time.push_back(Clock::now()); });
  time.reserve(passes + 1);
  const auto work = [&](int thread) {
    const std::size_t begin = length * static_cast<std::size_t>(thread) / threads;
    const std::size_t end = length * static_cast<std::size_t>(thread + 1) / threads;
    pass.arrive_and_wait();
    for (int k = 0; k < passes; ++k) {
      const double factor = 3.0 + k;  // so that no pass is the one before
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + factor * c[i];
      pass.arrive_and_wait();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(work, thread);
    work(0);
  }
  double best = 1e9;
  for (std::size_t k = 1; k < time.size(); ++k)
    best = std::min(best, std::chrono::duration<double>(time[k] - time[k - 1]).count());
  return 3.0 * sizeof(double) * length / best;
}

}  // namespace

double streamBandwidth(int threads) {
  static std::map<int, double> known;
  if (!known.contains(threads)) known[threads] = measure(threads);
  return known[threads];
}

}  // namespace crossgrain::bench
