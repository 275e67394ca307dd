#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Sentences that are put together by rule.
namespace crossgrain::reports {

/// "a, b and c"
std::string listed(const std::vector<std::string>& names);

/// The first few, and how many more: "a, b and 3 more".
std::string listedShortly(const std::vector<std::string>& names, std::size_t most);

/// "all 4 runs", "both runs", "the one run"
std::string allOf(std::size_t count, std::string_view noun);

/// "1 field", "2 fields"
std::string counted(std::size_t count, std::string_view noun);

/// The first letter, of ASCII, as a capital one.
std::string capitalised(std::string text);

/// Indices that rise, runs of three or more by their ends: "0, 2 to 5, 7".
std::string indicesText(const std::vector<int>& indices);

/// Drops empty ones.
std::vector<std::string> nonEmpty(std::vector<std::string> texts);

/// "is" or "are", "differs" or "differ": by how many there are.
inline std::string_view verb(std::size_t count, std::string_view one, std::string_view many) {
  return count == 1 ? one : many;
}

/// Subjects by their predicate, in the order in which each predicate came first.
class SaidOf {
 public:
  void add(const std::string& subject, const std::string& said);
  const std::vector<std::pair<std::string, std::vector<std::string>>>& all() const { return said_; }
  bool empty() const { return said_.empty(); }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> said_;
};

}  // namespace crossgrain::reports
