#pragma once

#include <cstdint>
#include <string_view>

namespace crossgrain::inline support {

/// 64 bits of FNV-1a (Fowler, Noll, Vo): separates contents, and keeps nobody out who wants two
/// alike.
/// @param hash  of what comes before the text
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace crossgrain::inline support
