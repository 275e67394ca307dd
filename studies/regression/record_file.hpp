#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

/// The file format of baselines and recordings: a head, then records, each
///
///     a line of JSON, an object; "bytes" is the number of bytes that follow it
///     these bytes: arrays, in the layout of the worker protocol (adapters/worker/README.md)
///     a line with a checksum of both: 64 bits of FNV-1a as 16 hexadecimal digits
///
/// The head is a record, too. Its key "crossgrain" is the format, "baseline-3" or "recording-2".
namespace crossgrain::inline studies {

struct Record {
  nlohmann::json line;
  std::string bytes;
};

/// A record as it is written.
std::string textOf(const Record& record);

/// @param head  an object, to which the format is added
std::string headText(std::string_view format, nlohmann::json head);

/// Reads such a file, whoever made it; nothing in it is trusted.
class RecordReader {
 public:
  /// @param format  "baseline-3": a file of another one is refused
  /// @throws BadInput naming the file: missing, no such file of records, damaged
  RecordReader(const std::filesystem::path& file, std::string_view format);

  const nlohmann::json& head() const { return head_; }

  /// The next record; absent at the end. @throws BadInput naming the file: cut off, malformed, or
  /// not what its checksum says
  std::optional<Record> next();

  /// The next record, which must be there. @throws BadInput
  Record require();

  /// Records read so far, besides the head.
  std::size_t count() const { return count_; }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::uintmax_t length_ = 0;
  std::size_t count_ = 0;
  nlohmann::json head_;
};

}  // namespace crossgrain::inline studies
