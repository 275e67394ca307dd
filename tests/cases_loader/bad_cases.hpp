#pragma once

#include <vector>

#include "files.hpp"

namespace crossgrain::test {

using LoaderErrors = InFolder;

struct Bad {
  std::string text;     ///< of case.toml
  std::string message;  ///< all of it
};

inline void expectMessages(const std::vector<Bad>& bads) {
  for (const Bad& bad : bads) {
    std::ofstream("case.toml") << bad.text;
    EXPECT_EQ(messageOf("case.toml"), bad.message) << bad.text;
  }
}

/// The sound case with one line replaced, or with lines added from line 24 on.
inline std::string line(int number, const std::string& text) {
  return withLine(soundCase, number, text);
}
inline std::string plus(const std::string& lines) {
  return soundCase + lines;
}

/// The sound collision likewise; lines are added from line 13 on.
inline std::string collision(int number, const std::string& text) {
  return withLine(soundCollision, number, text);
}

}  // namespace crossgrain::test
