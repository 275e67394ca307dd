#pragma once

#include <span>
#include <string_view>

namespace crossgrain::test {

/// A test that an engine cannot run, and part of the reason that it gives.
struct ExpectedSkip {
  std::string_view engine, test, reason;
};

/// All of them. An engine that is not listed skips nothing.
std::span<const ExpectedSkip> expectedSkips();

}  // namespace crossgrain::test
