#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crossgrain {

/// The protocol's name of an enumerator; names are in enum order.
template <typename Enum, std::size_t N>
nlohmann::json nameOf(Enum value, const std::array<std::string_view, N>& names) {
  return std::string(names[static_cast<std::size_t>(value)]);
}

/// @throws std::runtime_error saying which names there are
template <typename Enum, std::size_t N>
Enum valueOf(const nlohmann::json& name, const std::array<std::string_view, N>& names) {
  const auto found = std::ranges::find(names, name.get<std::string>());
  if (found == names.end())
    throw std::runtime_error(fmt::format("{} is none of: {}", name.dump(), fmt::join(names, ", ")));
  return static_cast<Enum>(found - names.begin());
}

}  // namespace crossgrain
