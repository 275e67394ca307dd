#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/draw.hpp"

namespace crossgrain::test {

/// A text with a few of its bytes, words, numbers or lines changed, left out or doubled.
std::string damagedText(std::string text, Draw& draw);

/// Bytes with a few changed, or cut short.
std::string damagedBytes(std::string bytes, Draw& draw);

/// A document of which one value, wherever it is, is another, gone, or of another type.
nlohmann::json damagedJson(const nlohmann::json& document, Draw& draw);

}  // namespace crossgrain::test
