#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace crossgrain::inline support {

/// A folder or file cannot be written; what() names it and says why.
struct OutputError : std::runtime_error {
  /// @param error errno; 0 where none is set
  OutputError(const std::filesystem::path& path, int error);
  OutputError(const std::filesystem::path& path, const std::string& why);
  explicit OutputError(const std::system_error& error);

  /// The same, with more said after it.
  OutputError with(const std::string& more) const;

  /// The disk is full, or a quota or limit reached: room has to be made, the input is not at fault.
  bool noRoom = false;

 private:
  using std::runtime_error::runtime_error;
};

/// The system's words for errno; never "Success", which is what it says to 0.
std::string systemReason(int error);

/// Creates the folder and those above it. @throws OutputError
void makeDirectory(const std::filesystem::path& dir);

/// Writes a file beside its final name and renames it, so that a reader sees the old file or the
/// whole new one. @throws OutputError; the old file, if any, is then as it was
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The most that is read of a file which is taken into memory whole [bytes].
inline constexpr std::size_t longestText = std::size_t{1} << 30;

/// Hands out a file that others may have made, piece by piece.
/// @returns whether there is one
/// @throws BadInput where it is no regular file (a pipe or a device might never end), is longer
/// than
///         `most` or cannot be read; Interrupted
bool readPieces(const std::filesystem::path& file, std::size_t most,
                const std::function<void(std::string_view)>& take);

/// The whole file; absent if there is none. @throws as readPieces()
std::optional<std::string> readFile(const std::filesystem::path& file,
                                    std::size_t most = longestText);

/// In gzip's format (RFC 1952), the same bytes for the same text on every machine.
std::string packed(std::string_view text);

/// Unpacks what packed() or gzip made of a text; absent where it is no such thing, damaged or cut
/// off.
/// @param most  of the text [bytes]: what would be longer counts as damaged
std::optional<std::string> unpacked(std::string_view content, std::size_t most = longestText);

/// Whether a file is there that this user may execute.
bool isProgram(const std::filesystem::path& path);

/// Whether a program of that name is in one of PATH's folders.
bool isOnPath(const std::string& program);

}  // namespace crossgrain::inline support
