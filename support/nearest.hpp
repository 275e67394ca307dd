#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace crossgrain::inline support {

/// Number of characters to insert, delete or replace to turn one word into the other
/// (Levenshtein 1966), swapped neighbours counting once.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The candidate nearest to a misspelt word; none if all of them are too far to be meant.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);

/// " (did you mean X?)" or, where nothing is near, " (there are: X, Y, Z)".
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

}  // namespace crossgrain::inline support
