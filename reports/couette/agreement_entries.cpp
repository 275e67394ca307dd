#include "reports/couette/agreement_entries.hpp"

#include <algorithm>

namespace crossgrain::reports {

namespace {

bool isOf(const Json& entry, const std::string& a, const std::string& b) {
  const std::string first = text(entry, "a"), second = text(entry, "b");
  return (first == a && second == b) || (first == b && second == a);
}

}  // namespace

std::vector<std::string> fieldsOf(const Json& results) {
  std::vector<std::string> fields;
  for (const Json& entry : list(results, "agreement"))
    if (const std::string field = text(entry, "field");
        std::ranges::find(fields, field) == fields.end())
      fields.push_back(field);
  return fields;
}

const Json& entryOf(const Json& results, const std::string& a, const std::string& b,
                    const std::string& field) {
  for (const Json& entry : list(results, "agreement"))
    if (text(entry, "field") == field && isOf(entry, a, b)) return entry;
  static const Json none;
  return none;
}

bool compared(const Json& results, const std::string& a, const std::string& b) {
  return std::ranges::any_of(list(results, "agreement"),
                             [&](const Json& entry) { return isOf(entry, a, b); });
}

std::vector<std::string> peersOf(const Json& results, const std::vector<EngineResults>& engines) {
  std::vector<std::string> peers;
  for (std::size_t k = 1; k < engines.size(); ++k)
    if (engines[k].mirrors.empty() && compared(results, engines.front().name, engines[k].name))
      peers.push_back(engines[k].name);
  return peers;
}

}  // namespace crossgrain::reports
