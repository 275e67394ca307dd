#pragma once

#include <string>
#include <vector>

namespace crossgrain::inline support {

/// What stands between commas, empty parts too: "a,,b" is three parts, "" is one.
inline std::vector<std::string> commaList(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t from = 0, comma = 0; comma != std::string::npos; from = comma + 1) {
    comma = list.find(',', from);
    parts.push_back(list.substr(from, comma - from));
  }
  return parts;
}

}  // namespace crossgrain::inline support
