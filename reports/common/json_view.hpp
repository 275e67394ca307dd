#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

/// Looking into results.json: what is not there, or is of another type, is absent.
namespace crossgrain::reports {

using Json = nlohmann::json;

/// The member, or null.
const Json& member(const Json& object, std::string_view key);

/// The member if it is an array, else an empty array.
const Json& list(const Json& object, std::string_view key);

/// The element of an array, or null.
const Json& element(const Json& array, std::size_t index);

/// A finite number, or absent.
std::optional<double> number(const Json& value);
std::optional<double> number(const Json& object, std::string_view key);

/// A string, or an empty one.
std::string text(const Json& object, std::string_view key);

/// The first element of list(object, key) whose member `name` is the string `value`, or null.
const Json& findByText(const Json& object, std::string_view key, std::string_view name,
                       std::string_view value);

}  // namespace crossgrain::reports
