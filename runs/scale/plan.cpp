#include "runs/scale/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <tuple>

#include "support/bad_input.hpp"
#include "support/comma_list.hpp"

namespace crossgrain::inline runs {

std::vector<PlannedTiming> plannedPoints(const ScalePlan& plan, const std::vector<bool>& shares) {
  const std::size_t largest = std::ranges::max(plan.disks);
  std::vector<PlannedTiming> points;
  for (std::size_t engine = 0; engine < shares.size(); ++engine)
    for (const std::size_t disks : plan.disks) {
      points.push_back({disks, engine, 1});
      if (!shares[engine]) continue;
      for (const int workers : plan.workers) {
        points.push_back({disks, engine, workers});
        const std::size_t more = disks * static_cast<std::size_t>(workers);
        if (more <= largest) points.push_back({more, engine, workers});
      }
    }
  const auto order = [](const PlannedTiming& point) {
    return std::tuple(point.disks, point.engine, point.workers);
  };
  std::ranges::sort(points, {}, order);
  const auto repeated = std::ranges::unique(points);
  points.erase(repeated.begin(), repeated.end());
  return points;
}

std::uint64_t stepsFor(std::size_t disks) {
  constexpr std::uint64_t diskSteps = 20'000'000, least = 50;
  return std::max(least, diskSteps / disks);
}

std::uint64_t warmUpSteps(std::uint64_t timed) {
  return std::max<std::uint64_t>(5, timed / 10);
}

double expectedMemory(std::size_t disks, std::size_t fewer, double taken) {
  return taken * static_cast<double>(disks) / static_cast<double>(fewer);
}

std::vector<int> usualWorkers(unsigned cores) {
  std::vector<int> workers;
  const int most = static_cast<int>(std::max(cores, 1u));
  for (int count = 1; count < most; count *= 2) workers.push_back(count);
  workers.push_back(most);
  return workers;
}

std::vector<std::size_t> wholeNumbers(const std::string& option, const std::string& list,
                                      std::size_t least, std::size_t most) {
  std::vector<std::size_t> numbers;
  std::set<std::size_t> seen;
  for (const std::string& text : commaList(list)) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < least || number > most)
      throw BadInput(fmt::format("{} '{}': '{}' must be a whole number from {} to {}", option, list,
                                 text, least, most));
    if (!seen.insert(number).second)
      throw BadInput(fmt::format("{} '{}': {} stands twice", option, list, number));
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace crossgrain::inline runs
