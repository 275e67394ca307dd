#pragma once

#include <filesystem>
#include <string>

namespace crossgrain::inline support {

/// Why what the user named cannot be read as a file: "no such file", "is a folder, not a file", "is
/// a named pipe, not a file", …; empty if it can. Nothing is opened: that may wait for ever.
std::string whyNoFile(const std::filesystem::path& path);

/// " (did you mean cases/quick.toml?)": the file that is nearest to one that is not there, or the
/// first files of a folder; empty if there is none. Only files that end alike are looked at.
std::string nearestFile(const std::filesystem::path& path, const std::string& extension);

}  // namespace crossgrain::inline support
