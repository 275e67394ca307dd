#pragma once

#include <cstddef>
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

/// Peak memory of this program so far [bytes].
std::size_t mostMemory();

/// Most additional memory that a reader may take for a damaged file of some kB, with buffers and
/// the output of zlib [bytes]. Sanitizers keep freed memory for a while.
#ifdef __SANITIZE_ADDRESS__
inline constexpr std::size_t modest = std::size_t{1} << 29;
#else
inline constexpr std::size_t modest = std::size_t{1} << 26;
#endif

}  // namespace crossgrain::test
