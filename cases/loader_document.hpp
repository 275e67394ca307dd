#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossgrain::inline cases {

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

/// A file that is no case. @throws BadInput where it cannot be read or is no TOML
toml::table readTomlFile(const std::filesystem::path& file);

/// A document that was printed, with a fragment merged in. @throws BadInput
CaseDocument documentOf(const std::string& printed, const std::string& variant,
                        const std::string& fragment);

/// A file as it is before variants and overrides, with all it extends. @throws BadInput
CaseDocument readBaseDocument(const std::filesystem::path& file);

/// Whether a node came from the command line.
bool isOverride(const toml::source_region& source);

/// Whether a node came from a file that the case extends and that lies outside the case's own
/// folder. Messages say where something is wrong with it, and quote nothing of it.
bool isForeign(const toml::source_region& source);

/// The file that a node came from; absent where it came from the command line or a fragment.
std::optional<std::filesystem::path> fileOf(const toml::source_region& source);

/// Folder that paths are relative to: that of that file, else the working directory.
std::filesystem::path folderOf(const toml::source_region& source);

/// "file:line:column: ", "file: " or "--set key=value: ".
std::string location(const toml::source_region& source);

/// One value as TOML on one line, numbers with the fewest digits that read back the same.
std::string printValue(const toml::node& node);

/// A document as TOML: every table under its full name, its own values first.
std::string printDocument(const toml::table& root);

/// A document as one of [[variants]]: everything in it is what that variant changes.
std::string printVariant(const toml::table& root, const std::string& name);

}  // namespace crossgrain::inline cases
