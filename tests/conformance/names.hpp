#pragma once

#include <algorithm>
#include <string>

namespace crossgrain::test {

/// An engine's name as googletest can have it: letters, digits and underscores.
inline std::string testName(std::string engine) {
  std::ranges::replace(engine, '-', '_');
  return engine;
}

}  // namespace crossgrain::test
