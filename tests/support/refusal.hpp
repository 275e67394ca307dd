#pragma once

#include <string>

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

}  // namespace crossgrain::test
