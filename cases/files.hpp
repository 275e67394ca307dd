#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crossgrain {

/// A folder or file cannot be written; what() names it and says why.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Creates the folder and those above it. @throws OutputError
void makeDirectory(const std::filesystem::path& dir);

/// Writes a file beside its final name and renames it, so that a reader sees the old file or the
/// whole new one. @throws OutputError; the old file, if any, is then as it was
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The whole file; absent if it cannot be read.
std::optional<std::string> readFile(const std::filesystem::path& file);

}  // namespace crossgrain
