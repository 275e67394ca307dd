#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crossgrain {

/// A program and how it is started: never by a shell.
struct ProgramCall {
  ProgramCall() = default;
  ProgramCall(std::vector<std::string> words) : argv(std::move(words)) {}  // NOLINT: words are one

  std::vector<std::string> argv;  ///< the program, looked up in PATH, and its arguments
  std::filesystem::path folder;   ///< in which it is started; empty: the caller's
  std::map<std::string, std::string> environment;  ///< set beside what the caller has
  std::uint64_t memory = 0;  ///< most address space that it may have [bytes]; 0: no limit
  /// Of the program as it is now: becomes part of its version, so that runs of another are not
  /// taken up. Empty: its version says enough.
  std::string stamp;

  bool operator==(const ProgramCall&) const = default;
};

}  // namespace crossgrain
