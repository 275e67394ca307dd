#pragma once

#include <filesystem>
#include <string>

#include "adapters/effects.hpp"
#include "cases/case.hpp"
#include "cli/command.hpp"

namespace crossgrain::inline cli {

/// The one Couette case that a command was given, without variants; shortened by --quick.
/// @throws BadInput
Case onlyCase(const CommandLine& line, const char* command);

/// The same, or an assembly that says what is averaged.
Case onlyFlow(const CommandLine& line, const char* command);

/// Says which command can.
[[noreturn]] void refuseKind(const Case& setup, const std::filesystem::path& input,
                             const char* command);

/// "effects called for: friction, rotation; left out: gravity"
std::string effectsInWords(const Effects& called);

}  // namespace crossgrain::inline cli
