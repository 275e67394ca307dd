#pragma once

#include <string>

namespace crossgrain::reports {

inline bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace crossgrain::reports
