#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crossgrain::inline support {

/// Names from outside become parts of file names, cells of CSV files and words of plots: letters,
/// digits and . _ - +, at most 80 of them, not starting with a dot.
bool usableName(std::string_view name);
inline constexpr const char* usableNameRule =
    "must be of letters, digits and . _ - +, at most 80, and not start with a dot";

/// Whether it is UTF-8, which is all that results, reports and tables can hold.
bool isUtf8(std::string_view text);

inline constexpr const char* noSuchFile = "no such file";

/// Why what the user named cannot be read as a file: "no such file", "is a folder, not a file", "is
/// a named pipe, not a file", …; empty if it can. Nothing is opened: that may wait for ever.
std::string fileFault(const std::filesystem::path& path);

/// " (did you mean cases/quick.toml?)": the file that is nearest to one that is not there, or the
/// first files of a folder; empty if there is none. Only files that end alike are looked at.
std::string nearestFile(const std::filesystem::path& path, const std::string& extension);

/// The parts between commas, empty ones too: "a,,b" is three parts, "" is one.
inline std::vector<std::string> commaList(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t from = 0, comma = 0; comma != std::string::npos; from = comma + 1) {
    comma = list.find(',', from);
    parts.push_back(list.substr(from, comma - from));
  }
  return parts;
}

}  // namespace crossgrain::inline support
