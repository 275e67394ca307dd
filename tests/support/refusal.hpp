#pragma once

#include <string>

#include "support/bad_input.hpp"

namespace crossgrain::test {

/// What is said when `act` is refused; empty where it is not.
template <typename Error = BadInput>
std::string refusalOf(const auto& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace crossgrain::test
