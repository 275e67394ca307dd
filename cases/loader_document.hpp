#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crossgrain {

/// A case file with all it extends, one variant and the command line's changes merged into it.
/// Every node still knows the file, line and column (or the `--set`) that it came from.
struct CaseDocument {
  std::string variant;  ///< name; empty where the file lists no variants
  toml::table root;     ///< without case.extends and variants
};

/// One document per `[[variants]]` entry, or one if there are none. Tables are merged key by key,
/// anything else is replaced; later wins: extended file, file, variant, overrides in their order,
/// fragment.
/// @throws BadInput
std::vector<CaseDocument> readCaseDocuments(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides,
                                            const std::string& fragment = {});

/// Names of cases and variants become parts of file names and cells of CSV files: letters, digits
/// and . _ - +, not starting with a dot.
bool usableName(std::string_view name);
inline constexpr const char* usableNameRule =
    "must be of letters, digits and . _ - +, and not start with a dot";

/// Whether there is a regular file of that name; any trouble in finding out means no.
bool isFile(const std::filesystem::path& file);

/// Whether a node came from the command line.
bool isOverride(const toml::source_region& source);

/// "file:line:column: ", "file: " or "--set key=value: ".
std::string location(const toml::source_region& source);

}  // namespace crossgrain
