#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/bad_input.hpp"

namespace crossgrain::test {

/// Message of the error that `act` throws; empty if it throws none.
template <typename Error = BadInput>
std::string refusalOf(const auto& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Requires each of these words in a message.
inline void expectSays(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
}

}  // namespace crossgrain::test
