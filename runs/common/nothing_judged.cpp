#include "runs/common/nothing_judged.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crossgrain::inline runs {

std::optional<NothingJudged> nothingJudged(const Case& setup,
                                           std::span<const AgreementRow> agreement,
                                           std::size_t named) {
  if (named < 2) return NothingJudged{"one engine has nothing to be held against", true};
  if (setup.averaging.margins.empty()) return NothingJudged{"the case has no [averaging.margins]"};
  constexpr int fewest = 4;  // of packings, for a test of any ring
  int fields = 0, most = 0;
  for (const AgreementRow& row : agreement) {
    if (row.kind != PairKind::peer) continue;
    ++fields;
    for (const AgreementRing& ring : row.rings) most = std::max(most, ring.packings.value_or(0));
  }
  if (fields == 0)
    return NothingJudged{"no two engines finished a run that shows a field with a margin"};
  if (most == 0) return NothingJudged{"no ring has a value on two engines"};
  if (most >= fewest) return std::nullopt;
  return NothingJudged{fmt::format("{} packing{} of both engines, and a verdict needs at least {}",
                                   most, most == 1 ? "" : "s", fewest)};
}

}  // namespace crossgrain::inline runs
