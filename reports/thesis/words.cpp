#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/common/numbers.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {

std::vector<std::string> claimCounts(const ThesisResults& results) {
  struct Count {
    int of[3] = {0, 0, 0};  ///< by verdict
  };
  std::vector<std::pair<std::string, Count>> counts;
  std::set<std::pair<std::string, std::string>> seen;
  for (const ClaimRow& claim : results.claims) {
    if (!seen.insert({claim.engine, claim.id}).second) continue;  // another reading
    auto own = std::ranges::find(counts, claim.engine, &std::pair<std::string, Count>::first);
    if (own == counts.end()) own = counts.insert(counts.end(), {claim.engine, {}});
    ++own->second.of[static_cast<std::size_t>(claim.verdict)];
  }
  // Engines are what a reader asks for; what needs none comes after them.
  std::ranges::stable_partition(counts, [](const auto& own) { return own.first != "-"; });
  std::vector<std::string> lines;
  for (const auto& [engine, count] : counts)
    lines.push_back(fmt::format("Claims {}: {} reproduced, {} refuted, {} undecided",
                                engine == "-" ? "that need no engine" : "on " + engine, count.of[0],
                                count.of[1], count.of[2]));
  return lines;
}

std::string boundsInWords(const ClaimFigure& figure) {
  if (figure.low && figure.high)
    return fmt::format("{} … {}", readableSetting(figure.low), readableSetting(figure.high));
  if (figure.low) return "≥ " + readableSetting(figure.low);
  if (figure.high) return "≤ " + readableSetting(figure.high);
  return "";
}

std::string claimsText(const ThesisResults& results) {
  std::string text;
  for (const ClaimRow& claim : results.claims) {
    std::string figure;
    if (!claim.figures.empty()) {
      const ClaimFigure& first = claim.figures.front();
      const std::string bounds = boundsInWords(first);
      figure = fmt::format("{}: {}{}{}{}", first.name, readable(first.value, first.standardError),
                           first.unit.empty() ? "" : " ", first.unit,
                           bounds.empty() ? "" : " [" + bounds + "]");
    }
    text += fmt::format("{:<4} {:<10} {:<16} {}; {}\n", claim.id, nameOf(claim.verdict),
                        claim.engine, figure, claim.reading);
  }
  return text;
}

}  // namespace crossgrain::reports
