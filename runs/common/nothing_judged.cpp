#include "runs/common/nothing_judged.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/flow.hpp"

namespace crossgrain::inline runs {

std::optional<NothingJudged> nothingJudged(const Case& setup, std::span<const EndpointRow> rows,
                                           std::size_t named) {
  const auto judged = [](const EndpointRow& row) {
    return row.kind == PairKind::closedForm && row.answer != Answer::undecided;
  };
  if (std::ranges::any_of(rows, judged)) return std::nullopt;
  if (hasClosedForms(setup))
    return NothingJudged{"no engine has a value that comes back when its one start is run again"};
  if (named < 2) return NothingJudged{"one engine has nothing to be held against", true};
  if (setup.averaging.endpoints.empty())
    return NothingJudged{setup.average ? "the case has no [[endpoints]]"
                                       : "the case has no [averaging.endpoints]"};
  constexpr int fewest = 4;  // of packings, for any test
  int endpoints = 0, most = 0;
  for (const EndpointRow& row : rows) {
    if (row.kind != PairKind::peer) continue;
    ++endpoints;
    most = std::max(most, row.packings);
  }
  if (endpoints == 0)
    return NothingJudged{"no two engines finished a run that shows an endpoint with a margin"};
  if (most == 0) return NothingJudged{"no endpoint has a value on two engines"};
  if (most >= fewest) return std::nullopt;
  return NothingJudged{fmt::format("{} packing{} of both engines, and a verdict needs at least {}",
                                   most, most == 1 ? "" : "s", fewest)};
}

}  // namespace crossgrain::inline runs
