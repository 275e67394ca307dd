#include "reports/common/sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

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

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string capitalised(std::string text) {
  if (!text.empty())
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string indicesText(const std::vector<int>& indices) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < indices.size();) {
    std::size_t end = k + 1;
    while (end < indices.size() && indices[end] == indices[end - 1] + 1) ++end;
    if (end - k < 3) end = k + 1;
    parts.push_back(end - k == 1 ? fmt::format("{}", indices[k])
                                 : fmt::format("{} to {}", indices[k], indices[end - 1]));
    k = end;
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> nonEmpty(std::vector<std::string> texts) {
  std::erase(texts, std::string());
  return texts;
}

void SaidOf::add(const std::string& subject, const std::string& said) {
  const auto found = std::ranges::find(said_, said, [](const auto& one) { return one.first; });
  if (found == said_.end())
    said_.push_back({said, {subject}});
  else if (std::ranges::find(found->second, subject) == found->second.end())
    found->second.push_back(subject);
}

}  // namespace crossgrain::reports
