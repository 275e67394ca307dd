#include "support/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <span>
#include <sstream>

#include "support/bad_input.hpp"
#include "support/input_file.hpp"
#include "support/interrupt.hpp"
#include "support/regular_file.hpp"

namespace crossgrain::inline support {

namespace {

bool meansNoRoom(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

}  // namespace

OutputError::OutputError(const std::filesystem::path& path, int error)
    : OutputError(path, systemReason(error)) {
  noRoom = meansNoRoom(error);
}

OutputError::OutputError(const std::system_error& error)
    : std::runtime_error(error.what()), noRoom(meansNoRoom(error.code().value())) {}

OutputError::OutputError(const std::filesystem::path& path, const std::string& why)
    : std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), why)) {}

OutputError OutputError::with(const std::string& more) const {
  OutputError longer(what() + more);
  longer.noRoom = noRoom;
  return longer;
}

std::string systemReason(int error) {
  return error == 0 ? "the system does not say why" : std::generic_category().message(error);
}

namespace {

/// @returns 0 or the errno of what went wrong
int writeAll(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  // A full disk may show only when the data really go there.
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void makeDirectory(const std::filesystem::path& dir) {
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error) throw OutputError(dir, error.value());
}

void writeFile(const std::filesystem::path& file, std::string_view content) {
  const std::filesystem::path part = file.string() + fmt::format(".part{}", ::getpid());
  ::unlink(part.c_str());  // what is there may be a link that leads elsewhere
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw OutputError(file, errno);
  int error = writeAll(descriptor, content);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(part.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(part.c_str());
  throw OutputError(file, error);
}

bool readPieces(const std::filesystem::path& file, std::size_t most,
                const std::function<void(std::string_view)>& take) {
  const auto refuse = [&](const std::string& why) {
    throw BadInput(fmt::format("{}: {}", file.string(), why));
  };
  const RegularFile in(file);
  if (in.state() == RegularFile::State::missing) {
    const std::string why = fileFault(file);
    if (why == noSuchFile) return false;
    refuse(why.empty() ? "cannot be read" : why);
  }
  if (in.state() == RegularFile::State::special) refuse(fileFault(file));
  constexpr double mega = 1e6;
  // The size of a system's file is only known once it is read.
  std::string piece(std::size_t{1} << 20, '\0');
  for (std::size_t done = 0;;) {
    throwIfInterrupted();
    if (in.size() > most || done > most)
      refuse(fmt::format("has {:.1f} MB; at most {:.1f} MB are read",
                         static_cast<double>(std::max(in.size(), done)) / mega,
                         static_cast<double>(most) / mega));
    errno = 0;
    const std::size_t got = in.read(done, std::as_writable_bytes(std::span(piece)));
    if (got == 0) {
      if (errno != 0 || done < in.size()) refuse("cannot be read");
      return true;
    }
    take(std::string_view(piece).substr(0, got));
    done += got;
  }
}

std::optional<std::string> readFile(const std::filesystem::path& file, std::size_t most) {
  std::string text;
  if (!readPieces(file, most, [&](std::string_view piece) { text += piece; })) return std::nullopt;
  return text;
}

namespace {

constexpr int gzipFormat = 15 + 16;  ///< zlib's largest window, and gzip's head and checksum

}  // namespace

std::string packed(std::string_view text) {
  z_stream stream{};
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzipFormat, 8,
                     Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string content(::deflateBound(&stream, text.size()), '\0');
  // zlib does not write to what it reads.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(content.data());
  stream.avail_out = static_cast<uInt>(content.size());
  ::deflate(&stream, Z_FINISH);
  content.resize(stream.total_out);
  ::deflateEnd(&stream);
  return content;
}

std::optional<std::string> unpacked(std::string_view content, std::size_t most) {
  z_stream stream{};
  if (::inflateInit2(&stream, gzipFormat) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  std::string text, piece(std::size_t{1} << 20, '\0');
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    text.append(piece, 0, piece.size() - stream.avail_out);
  }
  ::inflateEnd(&stream);
  if (state != Z_STREAM_END || text.size() > most) return std::nullopt;
  return text;
}

bool isProgram(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none) && ::access(path.c_str(), X_OK) == 0;
}

bool isOnPath(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (isProgram(std::filesystem::path(folder) / program)) return true;
  return false;
}

}  // namespace crossgrain::inline support
