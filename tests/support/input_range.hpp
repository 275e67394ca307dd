#pragma once

#include <cstdint>
#include <cstdlib>

namespace crossgrain::test {

/// Numbers of generated inputs that a test reads, each input a function of its number alone.
struct InputRange {
  std::uint64_t from, to;  ///< to: one past the last
  std::uint64_t size() const { return to - from; }
};

/// CROSSGRAIN_FUZZ inputs from CROSSGRAIN_FUZZ_FROM on, of the environment; else `usual` from 0 on.
inline InputRange inputs(std::uint64_t usual) {
  const auto said = [](const char* name, std::uint64_t otherwise) {
    const char* const given = std::getenv(name);
    return given ? std::strtoull(given, nullptr, 10) : otherwise;
  };
  const std::uint64_t from = said("CROSSGRAIN_FUZZ_FROM", 0);
  return {from, from + said("CROSSGRAIN_FUZZ", usual)};
}

}  // namespace crossgrain::test
