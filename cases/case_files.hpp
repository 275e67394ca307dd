#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// The case files (*.toml) of a folder, sorted. @throws BadInput if there is none
std::vector<std::filesystem::path> caseFilesIn(const std::filesystem::path& folder);

/// Description of a case file by itself.
struct CaseSummary {
  std::filesystem::path file;
  std::string name, kind;
  std::string what;  ///< first line of the comment at its head
};

/// All cases of a folder and the folders in it, sorted by file. What has no kind is what cases
/// extend, not a case. @throws BadInput if there is none, or one cannot be read
std::vector<CaseSummary> casesBelow(const std::filesystem::path& folder);

/// Whether a name holds a pattern, or fits it where that has a *, ? or [.
bool fitsPattern(const std::string& name, const std::string& pattern);

/// Whether a case's NAME, or NAME/VARIANT, fits one of these patterns, with commas between them.
bool fits(const Case& setup, const std::string& patterns);

/// The cases that fit, of which each pattern has one. The first variant of a case stays where
/// others are measured against it (copies_differ).
/// @throws BadInput if there is none
std::vector<Case> selectedCases(const std::vector<Case>& cases, const std::string& patterns);

/// Reports tell cases by their names. @throws BadInput for a name that two files have
void requireOwnNames(const std::vector<Case>& cases);

}  // namespace crossgrain::inline cases
