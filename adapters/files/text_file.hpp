#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "support/regular_file.hpp"

namespace crossgrain::files {

/// Whether it is packed by gzip.
bool isGzip(const std::filesystem::path& file);
/// So many bytes from its beginning, unpacked; fewer where it ends before.
std::string headOf(const std::filesystem::path& file, std::size_t bytes);

/// A text file read line by line through one buffer, whatever its size, packed by gzip or not.
class TextFile {
 public:
  /// @throws BadInput where it is no file that can be read
  explicit TextFile(const std::filesystem::path& file);
  ~TextFile();
  TextFile(TextFile&&) noexcept;

  /// So many bytes from the beginning, before any line is read.
  std::string head(std::size_t bytes);
  /// Goes on to the next line that is not blank; false after the last.
  /// @throws BadInput where a line is longer than the buffer
  bool next();
  /// The same line once more at the next next().
  void back() { again_ = true; }
  /// Goes on to the next line that is not blank and not after `mark`, a comment.
  bool nextUncommented(char mark);
  /// The next line that is not blank. @throws BadInput after the last
  std::string_view need(std::string_view what);

  /// The present line, without its end; until the next next().
  std::string_view line() const { return line_; }
  const std::filesystem::path& path() const { return path_; }
  /// Of the present line, from 1.
  std::size_t number() const { return number_; }
  /// Bytes of lines that were read.
  std::size_t position() const { return offset_ + begin_; }
  /// Of the whole file; at most, where it is packed.
  std::size_t size() const;
  /// Of the file as it is, packed or not.
  std::size_t fileSize() const { return file_.size(); }
  /// Bytes of it that were read.
  std::size_t bytesRead() const;
  /// The bytes behind the present line, whatever they are; the next line begins behind them.
  /// @throws BadInput where the file ends before
  void take(std::span<std::byte> bytes);
  /// Goes on behind so many bytes. @throws BadInput likewise
  void skip(std::size_t bytes);
  /// How many of `claimed` rows the rest of the file can hold, each of `columns` numbers: room is
  /// taken for so many. @throws BadInput where they are fewer than claimed
  std::size_t rows(std::int64_t claimed, std::size_t columns) const;

  /// @throws BadInput "file:line: what"
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Gzip;

  bool fill();
  bool takeLine();
  std::size_t readAt(std::size_t offset, std::span<std::byte> bytes);

  std::filesystem::path path_;
  RegularFile file_;
  std::unique_ptr<Gzip> gzip_;       ///< of a packed file, which is read from front to back
  std::unique_ptr<char[]> buffer_;   ///< not filled before it is read: small files touch little
  std::size_t begin_ = 0, end_ = 0;  ///< of what is left in the buffer
  std::size_t offset_ = 0;           ///< of the buffer in the file
  std::size_t number_ = 0;           ///< of the line
  std::string_view line_;
  bool again_ = false;
};

/// Words of a line, which blanks part. @throws nothing
std::vector<std::string_view> words(std::string_view line);

/// Words of a line, which commas (or what else) part; blanks around them and quotes do not count.
std::vector<std::string_view> separatedWords(std::string_view line, char separator = ',');
/// The separator of a table's columns, by its line of names: ',' or ';', blanks and tabs around
/// them aside, else tabs; absent where it has both, or none of the three.
std::optional<char> separatorOf(std::string_view names);

/// Bytes that some programs put before UTF-8 text; they are no part of it.
inline constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

/// All of a word as a finite number. @throws BadInput naming the line
double numberOf(const TextFile& text, std::string_view word, std::string_view what);
std::int64_t countOf(const TextFile& text, std::string_view word, std::string_view what);

/// Where a column that is not read goes.
inline constexpr std::uint8_t unread = 255;

/// The numbers of a row into their places: values[places[k]] is the k-th. Columns that are not read
/// may hold anything.
/// @param separator  ' ' for blanks and tabs, else this character
/// @throws BadInput naming line and column where there are more or fewer columns, or no finite
/// number
void readRow(const TextFile& text, char separator, std::span<const std::uint8_t> places,
             double* values);

/// A whole number that a double holds to the last digit. @throws BadInput naming the line
std::int64_t wholeNumber(const TextFile& text, double value, std::string_view what);

}  // namespace crossgrain::files
