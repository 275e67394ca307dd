#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {

/// Treatment of the starts of a case. Packings that are all the same are refused where several
/// are to be made: they have no scatter. Where none is made nothing speaks against them.
enum class Starts { made, notMade };

/// Reads a case file (TOML, SI units; docs/cases.md has every key): resolves what it extends,
/// expands its variants, applies the command line's changes, and checks everything, so that nothing
/// that uses a Case has to check it again.
///
/// @param overrides  "key.path=value" each, as after `--set`: the value is TOML, a bare word is a
///                   string; they come last and hold for every variant
/// @param fragment   TOML that is merged after them, as if it were a file that extends this one
/// @param only       as of selectedCases(): a variant that it leaves out may have faults
/// @return one case per variant in the file's order, or one case with an empty variant
/// @throws BadInput  with one line: where, what is there, what would be right
std::vector<Case> loadCase(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides = {},
                           const std::string& fragment = {}, Starts starts = Starts::made,
                           const std::optional<std::string>& only = {});

/// A case that was loaded, with a fragment of TOML merged in, as if it were a file that extends it.
/// @throws BadInput for what makes no case
Case caseWith(const Case& setup, const std::string& fragment);

/// As case.kind has it: "couette", "collision" or "assembly".
std::string kindOf(const Case& setup);

/// The case of loadCase(), all layers merged, as one case file that loads to the same again,
/// wherever it lies: one case as it is, several as variants of each of which everything is said.
std::string resolvedFile(const std::vector<Case>& cases);

}  // namespace crossgrain::inline cases
