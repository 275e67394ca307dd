#include "adapters/files/text_file.hpp"

#include <fmt/format.h>

#include <zlib.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "support/bad_input.hpp"
#include "support/input_file.hpp"

namespace crossgrain::files {
namespace {

/// Lines of result files have some hundred characters; a longer one is no text.
constexpr std::size_t bufferSize = std::size_t{1} << 20;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// A word in quotes for a message, cut to fit a line.
std::string quoted(std::string_view word) {
  constexpr std::size_t most = 40;
  return fmt::format("\"{}{}\"", word.substr(0, most), word.size() > most ? "…" : "");
}

/// from_chars takes no plus sign.
std::from_chars_result parse(const char* from, const char* to, double& value) {
  if (from < to && *from == '+' && (to - from < 2 || from[1] != '-')) ++from;
  return std::from_chars(from, to, value);
}

}  // namespace

/// zlib's reader of one file.
struct TextFile::Gzip {
  explicit Gzip(const std::filesystem::path& path)
      : file(::gzopen(path.c_str(), "rb")), name(path.string()) {
    if (!file) throw BadInput(fmt::format("{}: cannot be read", name));
    ::gzbuffer(file, 1u << 17);
  }
  ~Gzip() { ::gzclose_r(file); }
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;

  /// The bytes that follow. @throws BadInput for a file that is damaged or was cut off
  std::size_t read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const std::size_t more = std::min(bytes.size() - done, std::size_t{1} << 30);
      const int got = ::gzread(file, bytes.data() + done, static_cast<unsigned>(more));
      int status = Z_OK;
      if (got <= 0) ::gzerror(file, &status);
      if (got < 0 || status != Z_OK)
        throw BadInput(fmt::format("{}: what gzip packed into it is damaged or was cut off", name));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

  gzFile file;
  std::string name;
};

bool isGzip(const std::filesystem::path& file) {
  char head[2] = {};
  RegularFile(file).read(0, std::as_writable_bytes(std::span(head)));
  return head[0] == '\x1f' && head[1] == '\x8b';
}

std::string headOf(const std::filesystem::path& file, std::size_t bytes) {
  return TextFile(file).head(bytes);
}

std::string TextFile::head(std::size_t bytes) {
  std::string text(bytes, '\0');
  text.resize(readAt(0, std::as_writable_bytes(std::span(text))));
  return text;
}

TextFile::TextFile(const std::filesystem::path& file)
    : path_(file), file_(file), buffer_(std::make_unique_for_overwrite<char[]>(bufferSize)) {
  if (file_.state() == RegularFile::State::open) {
    if (isGzip(file)) gzip_ = std::make_unique<Gzip>(file);
    return;
  }
  const std::string why = fileFault(file);
  throw BadInput(fmt::format("{}: {}", file.string(), why.empty() ? "cannot be read" : why));
}

TextFile::~TextFile() = default;
TextFile::TextFile(TextFile&&) noexcept = default;

std::size_t TextFile::size() const {
  constexpr std::size_t mostPacked = 1032;  // zlib packs so many bytes into one
  return gzip_ ? mostPacked * file_.size() : file_.size();
}

std::size_t TextFile::bytesRead() const {
  if (!gzip_) return position();
  return static_cast<std::size_t>(std::max<z_off_t>(::gzoffset(gzip_->file), 0));
}

/// @pre of a packed file: behind what was read before
std::size_t TextFile::readAt(std::size_t offset, std::span<std::byte> bytes) {
  return gzip_ ? gzip_->read(bytes) : file_.read(offset, bytes);
}

bool TextFile::fill() {
  std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  offset_ += begin_;
  end_ -= begin_;
  begin_ = 0;
  const std::size_t got = readAt(
      offset_ + end_, std::as_writable_bytes(std::span(buffer_.get() + end_, bufferSize - end_)));
  end_ += got;
  return got > 0;
}

bool TextFile::takeLine() {
  std::size_t seen = begin_;
  const char* stop = nullptr;
  for (;;) {
    stop = static_cast<const char*>(std::memchr(buffer_.get() + seen, '\n', end_ - seen));
    if (stop) break;
    const std::size_t length = end_ - begin_;
    if (length == bufferSize) {
      ++number_;
      fail("the line is longer than a megabyte: this is no text file");
    }
    if (!fill()) break;
    seen = begin_ + length;
  }
  if (!stop && begin_ == end_) return false;
  const char* const start = buffer_.get() + begin_;
  const char* const until = stop ? stop : buffer_.get() + end_;
  line_ = {start, static_cast<std::size_t>(until - start)};
  begin_ += line_.size() + (stop ? 1 : 0);
  if (++number_ == 1 && line_.starts_with(byteOrderMark)) line_.remove_prefix(byteOrderMark.size());
  return true;
}

bool TextFile::next() {
  if (again_) return !(again_ = false);
  while (takeLine())
    if (std::ranges::any_of(line_, [](char c) { return !isBlank(c); })) return true;
  line_ = {};
  return false;
}

bool TextFile::nextUncommented(char mark) {
  while (next())
    if (line_[line_.find_first_not_of(" \t\r\v\f")] != mark) return true;
  return false;
}

std::string_view TextFile::need(std::string_view what) {
  if (!next()) fail(fmt::format("the file ends where {} should be: it was cut off", what));
  return line_;
}

void TextFile::take(std::span<std::byte> bytes) {
  if (gzip_) fail("numbers in binary are not read from what gzip packed: unpack it before");
  const std::size_t from = position();
  skip(bytes.size());
  if (file_.read(from, bytes) != bytes.size()) fail("the file was cut off while it was read");
}

void TextFile::skip(std::size_t bytes) {
  if (gzip_) fail("numbers in binary are not read from what gzip packed: unpack it before");
  if (bytes > size() - std::min(size(), position()))
    fail(fmt::format("{} bytes should follow, the file has {}: it was cut off", bytes,
                     size() - std::min(size(), position())));
  const std::size_t there = std::min(bytes, end_ - begin_);
  begin_ += there;
  if (there == bytes) return;
  offset_ += end_ + (bytes - there);
  begin_ = end_ = 0;
}

std::size_t TextFile::rows(std::int64_t claimed, std::size_t columns) const {
  // A column is a digit and a blank at least.
  const std::size_t most =
      (size() - std::min(size(), position())) / (2 * std::max<std::size_t>(columns, 1)) + 1;
  if (claimed < 0 || static_cast<std::uint64_t>(claimed) > most)
    fail(fmt::format("{} rows are announced, the rest of the file has room for {} at most", claimed,
                     most));
  return static_cast<std::size_t>(claimed);
}

void TextFile::fail(const std::string& what) const {
  throw BadInput(fmt::format("{}:{}: {}", path_.string(), number_, what));
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t at = 0;;) {
    while (at < line.size() && isBlank(line[at])) ++at;
    if (at == line.size()) return found;
    const std::size_t from = at;
    while (at < line.size() && !isBlank(line[at])) ++at;
    found.push_back(line.substr(from, at - from));
  }
}

std::vector<std::string_view> separatedWords(std::string_view line, char separator) {
  std::vector<std::string_view> found;
  for (std::size_t from = 0, end = 0; end != std::string_view::npos; from = end + 1) {
    end = line.find(separator, from);
    std::string_view word =
        trimmed(line.substr(from, end == std::string_view::npos ? end : end - from));
    if (word.size() > 1 && word.front() == '"' && word.back() == '"')
      word = trimmed(word.substr(1, word.size() - 2));
    found.push_back(word);
  }
  return found;
}

std::optional<char> separatorOf(std::string_view names) {
  const auto has = [&](char c) { return names.find(c) != std::string_view::npos; };
  if (has(',') || has(';'))
    return has(',') && has(';') ? std::nullopt : std::optional(has(',') ? ',' : ';');
  return has('\t') ? std::optional('\t') : std::nullopt;
}

double numberOf(const TextFile& text, std::string_view word, std::string_view what) {
  double value = 0.0;
  const auto [end, error] = parse(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    text.fail(fmt::format("{}: {} should be a finite number", what, quoted(word)));
  return value;
}

std::int64_t countOf(const TextFile& text, std::string_view word, std::string_view what) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < 0)
    text.fail(fmt::format("{}: {} should be a whole number, 0 or more", what, quoted(word)));
  return value;
}

void readRow(const TextFile& text, char separator, std::span<const std::uint8_t> places,
             double* values) {
  const bool blanks = separator == ' ';
  const char* at = text.line().data();
  const char* const end = at + text.line().size();
  for (std::size_t k = 0; k < places.size(); ++k) {
    while (at < end && isBlank(*at)) ++at;
    if (at == end && (blanks || k > 0))
      text.fail(fmt::format("{} columns, there should be {}", k, places.size()));
    const char* stop = at;
    if (places[k] != unread) {
      double value = 0.0;
      const auto [last, error] = parse(at, end, value);
      stop = last;
      if (error != std::errc() || !std::isfinite(value) ||
          (stop < end && !isBlank(*stop) && *stop != separator)) {
        const char* const word =
            std::find_if(at, end, [&](char c) { return isBlank(c) || c == separator; });
        text.fail(fmt::format("column {}: {} should be a finite number", k + 1,
                              quoted({at, static_cast<std::size_t>(word - at)})));
      }
      values[places[k]] = value;
    } else {
      while (stop < end && *stop != separator && (!blanks || !isBlank(*stop))) ++stop;
    }
    at = stop;
    if (blanks) continue;
    while (at < end && isBlank(*at)) ++at;
    if (at == end || k + 1 == places.size()) continue;
    if (*at != separator) text.fail(fmt::format("no '{}' after column {}", separator, k + 1));
    ++at;
  }
  while (at < end && isBlank(*at)) ++at;
  if (at != end) text.fail(fmt::format("more than {} columns", places.size()));
}

std::int64_t wholeNumber(const TextFile& text, double value, std::string_view what) {
  if (std::abs(value) > 0x1p53 || value != std::floor(value))
    text.fail(fmt::format("{}: {} should be a whole number", what, value));
  return static_cast<std::int64_t>(value);
}

}  // namespace crossgrain::files
