#include "results/cost_analysis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace crossgrain::inline results {

std::string inWords(const std::vector<CostKind>& kinds) {
  std::vector<std::string> words;
  for (const CostKind kind : kinds) words.push_back(toString(kind));
  return fmt::format("{}", fmt::join(words, " and "));
}

}  // namespace crossgrain::inline results
