#include "studies/regression/record_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "support/bad_input.hpp"
#include "support/fingerprint.hpp"
#include "support/json_text.hpp"

namespace crossgrain::inline studies {
namespace {

using nlohmann::json;

std::string checksum(std::string_view line, std::string_view bytes) {
  return fmt::format("{:016x}", fnv1a(bytes, fnv1a(line)));
}

/// "baseline" of "baseline-3"
std::string_view kindOf(std::string_view format) {
  return format.substr(0, format.find('-'));
}

}  // namespace

std::string textOf(const Record& record) {
  json line = record.line;
  line["bytes"] = record.bytes.size();
  // An engine's answer need not be UTF-8.
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace);
  return text + '\n' + record.bytes + checksum(text, record.bytes) + '\n';
}

std::string headText(std::string_view format, json head) {
  head["crossgrain"] = format;
  return textOf({std::move(head), {}});
}

RecordReader::RecordReader(const std::filesystem::path& file, std::string_view format)
    : file_(file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw BadInput(fmt::format("{}: no such file", file.string()));
  length_ = std::filesystem::file_size(file, error);
  in_.open(file, std::ios::binary);
  std::optional<Record> first;
  try {
    first = next();
  } catch (const BadInput&) {
    // Reported below.
  }
  if (!first || !first->line.contains("crossgrain"))
    throw BadInput(fmt::format("{0}: is no {1}; `crossgrain {2} CASE --out FILE` makes one",
                               file.string(), kindOf(format),
                               format.starts_with("recording") ? "record" : kindOf(format)));
  head_ = std::move(first->line);
  count_ = 0;
  if (head_["crossgrain"] != format)
    throw BadInput(fmt::format("{}: has format {}, this crossgrain reads \"{}\"", file.string(),
                               asOneLine(head_["crossgrain"].dump(), 60), format));
}

std::optional<Record> RecordReader::next() {
  if (in_.peek() == std::ifstream::traits_type::eof()) return std::nullopt;
  ++count_;
  const auto damaged = [&](const std::string& what) {
    return BadInput(fmt::format("{}: is damaged: record {} {}", file_.string(), count_, what));
  };
  Record record;
  std::string text, sum;
  std::getline(in_, text);
  try {
    record.line = parseJson(text);
  } catch (const std::exception& error) {
    throw damaged(error.what());
  }
  const json bytes = record.line.is_object() ? record.line.value("bytes", json()) : json();
  const auto at = static_cast<std::uintmax_t>(std::max<std::streamoff>(0, in_.tellg()));
  if (!bytes.is_number_unsigned() || bytes.get<std::uintmax_t>() > length_ - std::min(at, length_))
    throw damaged("is cut off");
  record.bytes.resize(bytes.get<std::size_t>());
  in_.read(record.bytes.data(), static_cast<std::streamsize>(record.bytes.size()));
  std::getline(in_, sum);
  if (in_.eof()) throw damaged("is cut off");
  if (sum != checksum(text, record.bytes)) throw damaged("is not what its checksum says");
  return record;
}

Record RecordReader::require() {
  if (auto record = next()) return *std::move(record);
  throw BadInput(fmt::format("{}: is damaged: it ends after {} records", file_.string(), count_));
}

}  // namespace crossgrain::inline studies
