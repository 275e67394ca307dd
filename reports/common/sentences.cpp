#include "reports/common/sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace crossgrain::reports {

std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string allOf(std::size_t count, std::string_view noun) {
  if (count == 1) return fmt::format("the one {}", noun);
  return count == 2 ? fmt::format("both {}s", noun) : fmt::format("all {} {}s", count, noun);
}

std::string listedShortly(const std::vector<std::string>& names, std::size_t most) {
  if (names.size() <= most) return listed(names);
  std::vector<std::string> few(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(most));
  few.push_back(fmt::format("{} more", names.size() - most));
  return listed(few);
}

void SaidOf::add(const std::string& subject, const std::string& said) {
  const auto found = std::ranges::find(said_, said, [](const auto& one) { return one.first; });
  if (found == said_.end())
    said_.push_back({said, {subject}});
  else if (std::ranges::find(found->second, subject) == found->second.end())
    found->second.push_back(subject);
}

}  // namespace crossgrain::reports
