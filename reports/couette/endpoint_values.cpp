#include <fmt/format.h>

#include <algorithm>

#include "reports/common/numbers.hpp"
#include "reports/couette/endpoint_words.hpp"
#include "reports/couette/overview.hpp"

namespace crossgrain::reports {

namespace {

OverviewCell cellOf(double value, const std::string& unit, CellState state) {
  const bool plain = unit.empty() || unit == "1" || unit == "-";
  return {state, value, unit, readable(value) + (plain ? "" : " " + unit), {}, {}};
}

}  // namespace

std::vector<DigestValue> compareValues(const CompareResults& results) {
  std::vector<DigestValue> values;
  if (results.engines.empty()) return values;
  const std::string& reference = results.engines.front().name;
  for (const EndpointRow& row : results.endpoints.rows) {
    const auto of = finite(row.reference), difference = finite(row.difference);
    if (row.a != reference || !of) continue;
    const std::string quantity = "mean of " + endpointWords(row.endpoint);
    const auto known = std::ranges::find_if(values, [&](const DigestValue& value) {
      return value.engine == reference && value.quantity == quantity;
    });
    if (known == values.end())
      values.push_back({reference, quantity, cellOf(*of, row.unit, CellState::figure)});
    const auto other = std::ranges::find(results.engines, row.b, &EngineRow::name);
    if (!difference || other == results.engines.end()) continue;
    values.push_back(
        {row.b, quantity, cellOf(*of + *difference, row.unit, endpointCell(results, row).state)});
  }
  return values;
}

}  // namespace crossgrain::reports
