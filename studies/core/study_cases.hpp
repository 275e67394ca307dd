#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/effects.hpp"
#include "cases/case.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

/// The one flow that a command was given, without variants; shortened by --quick.
/// @throws BadInput
Case onlyFlow(const CommandLine& line, const char* command);

/// Changes by --quick of a flow: nothing becomes longer than the case has it.
/// @param rotations  averaged
std::vector<std::string> quickOverrides(const Case& setup, double rotations = 0.1);

/// Keys and sections that the case says and that mean nothing to a command, settings of engines
/// that it does not know among them; else none for `check`, which reads all of it.
std::vector<std::string> keysWithoutUse(const Case& setup, std::string_view command);

/// One line with them, if there are any: nothing that a user said is ignored in silence. On stdout
/// a comment, so that what is printed to be pasted loads. It waits for printNotes().
void reportKeysWithoutUse(const Case& setup, std::string_view command, std::FILE* to);
/// The same of many cases, once for each file.
void reportKeysWithoutUse(const std::vector<Case>& cases, std::string_view command, std::FILE* to);

/// Prints those lines, once it is known that the command can begin: a refusal stands alone.
void printNotes();

/// Warns of what loads but is hardly meant, one line each on standard error.
void printWarnings(const Case& setup);

}  // namespace crossgrain::inline studies
