#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace crossgrain::reports {

/// Creates the folder and those above it. @throws std::runtime_error naming it and the reason
void makeDirectory(const std::filesystem::path& dir);

/// Writes a file beside its final name and renames it, so that a reader sees the old file or the
/// whole new one. @throws std::runtime_error naming the file and the system's reason; the old file,
/// if any, is then as it was
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The whole file; absent if it cannot be read.
std::optional<std::string> readFile(const std::filesystem::path& file);

}  // namespace crossgrain::reports
