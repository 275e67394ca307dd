#include "reports/common/packings.hpp"

#include <fmt/format.h>

namespace crossgrain::reports {

Json packingRows(const std::vector<PackingRow>& packings) {
  Json rows = Json::array();
  for (const PackingRow& packing : packings)
    rows.push_back({{"index", fmt::format("{}", packing.index)},
                    {"seed", fmt::format("{}", packing.seed)},
                    {"hash", packing.hash},
                    {"source", packing.fromCache ? "earlier, kept" : "for this run"}});
  return rows;
}

}  // namespace crossgrain::reports
