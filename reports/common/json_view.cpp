#include "reports/common/json_view.hpp"

#include <cmath>

namespace crossgrain::reports {

namespace {
const Json nothing;
const Json emptyList = Json::array();
}  // namespace

const Json& member(const Json& object, std::string_view key) {
  if (!object.is_object()) return nothing;
  const auto found = object.find(std::string(key));
  return found == object.end() ? nothing : *found;
}

const Json& list(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  return value.is_array() ? value : emptyList;
}

const Json& element(const Json& array, std::size_t index) {
  return array.is_array() && index < array.size() ? array[index] : nothing;
}

std::optional<double> number(const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const double result = value.get<double>();
  if (!std::isfinite(result)) return std::nullopt;
  return result;
}

std::optional<double> number(const Json& object, std::string_view key) {
  return number(member(object, key));
}

std::string text(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

const Json& findByText(const Json& object, std::string_view key, std::string_view name,
                       std::string_view value) {
  for (const Json& candidate : list(object, key))
    if (text(candidate, name) == value) return candidate;
  return nothing;
}

}  // namespace crossgrain::reports
