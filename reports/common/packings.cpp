#include "reports/common/packings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string indicesInWords(const std::vector<int>& indices) {
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

}  // namespace crossgrain::reports
