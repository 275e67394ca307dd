#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

std::string orderText(const OrderFit& fit) {
  return readable(fit.order, fit.halfWidth);
}

/// An engine with its integrator, unless that is its own.
std::string schemeText(const OrderFit& fit) {
  return fit.engine + (fit.integrator.empty() ? "" : ", " + spaced(fit.integrator));
}

/// "failed 2, below 3 times … 1"
std::string leftOutText(const OrderFit& fit) {
  std::map<std::string, int> counts;
  for (const LeftOut& left : fit.leftOut) ++counts[left.why.substr(0, left.why.find(':'))];
  std::vector<std::string> words;
  for (const auto& [why, count] : counts) words.push_back(fmt::format("{} {}", count, why));
  return words.empty() ? "" : fmt::format("left out: {}", fmt::join(words, "; "));
}

const char* styleOf(OrderVerdict verdict) {
  constexpr std::array styles = {"agree", "disagree", "agree", "undecided", "", ""};
  return styles[static_cast<std::size_t>(verdict)];
}

/// A scheme converges to its engine's own limit: where an order was fitted against that, what is
/// found against the case's law is the same again, or its model.
bool isToldOfOwnLimit(const CostResults& results, const OrderFit& fit) {
  return std::ranges::any_of(results.orders, [&](const OrderFit& own) {
    return own.engine == fit.engine && own.kind == fit.kind && own.integrator == fit.integrator &&
           own.measure == ownOf(fit.measure) && own.order;
  });
}

}  // namespace

std::vector<std::string> unmetOrders(const CostResults& results) {
  std::vector<std::pair<std::string, std::vector<std::string>>> findings;
  for (const OrderFit& fit : results.orders) {
    if (fit.verdict != OrderVerdict::notMet || isToldOfOwnLimit(results, fit)) continue;
    const std::string claim = fmt::format("Finding: {}: order {} is claimed and not met",
                                          schemeText(fit), readableSetting(fit.theory));
    auto found = std::ranges::find(findings, claim, [](const auto& one) { return one.first; });
    if (found == findings.end()) found = findings.insert(found, {claim, {}});
    found->second.push_back(
        fmt::format("{} {} {}", toString(fit.kind), measureWords(fit.measure), orderText(fit)));
  }
  std::vector<std::string> sentences;
  for (const auto& [claim, fitted] : findings)
    sentences.push_back(fmt::format("{}: {}.", claim, fmt::join(fitted, ", ")));
  return sentences;
}

Json orderRows(const CostResults& results) {
  Json rows = Json::array();
  for (const OrderFit& fit : results.orders) {
    const std::size_t used = fit.used.size();
    const std::string range =
        fit.dtLow ? fmt::format(", {} to {} s", readable(fit.dtLow), readable(fit.dtHigh)) : "";
    rows.push_back({{"scheme", schemeText(fit)},
                    {"what", toString(fit.kind) + ": " + measureHtml(fit.measure)},
                    {"order", orderText(fit)},
                    {"theory", readableSetting(fit.theory)},
                    {"verdict", toString(fit.verdict)},
                    {"class", styleOf(fit.verdict)},
                    {"reason", fit.reason},
                    {"used", fmt::format("{} of {}{}", used, used + fit.leftOut.size(), range)},
                    {"leftOut", leftOutText(fit)}});
  }
  return rows;
}

}  // namespace crossgrain::reports
