#include "reports/flow/agreement_entries.hpp"

#include <algorithm>

namespace crossgrain::reports {

namespace {

bool isOf(const auto& row, const std::string& a, const std::string& b) {
  return (row.a == a && row.b == b) || (row.a == b && row.b == a);
}

/// The different values of a member, in the order of the rows.
std::vector<std::string> differentOnes(const auto& rows, auto member) {
  std::vector<std::string> values;
  for (const auto& row : rows)
    if (std::ranges::find(values, row.*member) == values.end()) values.push_back(row.*member);
  return values;
}

template <typename Row>
const Row* find(const std::vector<Row>& rows, const std::string& a, const std::string& b,
                std::string Row::*member, const std::string& value) {
  const auto found = std::ranges::find_if(
      rows, [&](const Row& row) { return row.*member == value && isOf(row, a, b); });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> fieldsOf(const Agreement& agreement) {
  return differentOnes(agreement, &AgreementRow::field);
}

std::vector<std::string> endpointsOf(const Endpoints& endpoints) {
  return differentOnes(endpoints, &EndpointRow::endpoint);
}

const AgreementRow* rowOf(const Agreement& agreement, const std::string& a, const std::string& b,
                          const std::string& field) {
  return find(agreement, a, b, &AgreementRow::field, field);
}

const EndpointRow* rowOf(const Endpoints& endpoints, const std::string& a, const std::string& b,
                         const std::string& endpoint) {
  return find(endpoints, a, b, &EndpointRow::endpoint, endpoint);
}

std::vector<const EndpointRow*> rowsOf(const Endpoints& endpoints, const std::string& a,
                                       const std::string& b) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& row : endpoints)
    if (isOf(row, a, b)) rows.push_back(&row);
  return rows;
}

std::vector<std::string> closedFormEngines(const Endpoints& endpoints) {
  Endpoints rows = endpoints;
  std::erase_if(rows, [](const EndpointRow& row) { return row.kind != PairKind::closedForm; });
  return differentOnes(rows, &EndpointRow::b);
}

std::vector<std::string> peersOf(const Endpoints& endpoints,
                                 const std::vector<EngineRuns>& engines) {
  std::vector<std::string> peers;
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (std::ranges::any_of(endpoints, [&](const EndpointRow& row) {
          return row.kind == PairKind::peer && isOf(row, engines.front().name, engines[k].name);
        }))
      peers.push_back(engines[k].name);
  return peers;
}

}  // namespace crossgrain::reports
