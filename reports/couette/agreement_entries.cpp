#include "reports/couette/agreement_entries.hpp"

#include <algorithm>

namespace crossgrain::reports {

namespace {

bool isOf(const AgreementRow& row, const std::string& a, const std::string& b) {
  return (row.a == a && row.b == b) || (row.a == b && row.b == a);
}

}  // namespace

std::vector<std::string> fieldsOf(const Agreement& agreement) {
  std::vector<std::string> fields;
  for (const AgreementRow& row : agreement)
    if (std::ranges::find(fields, row.field) == fields.end()) fields.push_back(row.field);
  return fields;
}

const AgreementRow* rowOf(const Agreement& agreement, const std::string& a, const std::string& b,
                          const std::string& field) {
  const auto found = std::ranges::find_if(
      agreement, [&](const AgreementRow& row) { return row.field == field && isOf(row, a, b); });
  return found == agreement.end() ? nullptr : &*found;
}

bool compared(const Agreement& agreement, const std::string& a, const std::string& b) {
  return std::ranges::any_of(agreement, [&](const AgreementRow& row) { return isOf(row, a, b); });
}

std::vector<std::string> peersOf(const Agreement& agreement,
                                 const std::vector<EngineRuns>& engines) {
  std::vector<std::string> peers;
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].mirrors.empty() && compared(agreement, engines.front().name, engines[k].name))
      peers.push_back(engines[k].name);
  return peers;
}

}  // namespace crossgrain::reports
