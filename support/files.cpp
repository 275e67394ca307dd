#include "support/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>

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
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw OutputError(file, errno);
  int error = writeAll(descriptor, content);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(part.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(part.c_str());
  throw OutputError(file, error);
}

std::optional<std::string> readFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace crossgrain::inline support
