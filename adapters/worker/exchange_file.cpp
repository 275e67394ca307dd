#include "adapters/worker/exchange_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

namespace crossgrain {
namespace {

/// One that has grown beyond is made anew rather than spoiled [bytes].
constexpr off_t longestKept = off_t{16} << 20;

}  // namespace

ExchangeFile::~ExchangeFile() {
  drop();
}

void ExchangeFile::drop() {
  kept_.reset();
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
  path_.clear();
}

const std::filesystem::path& ExchangeFile::next(bool keep) {
  struct stat status {};
  if (keep && kept_ && ::fstat(kept_->get(), &status) == 0 && status.st_size <= longestKept) {
    spoil();
    return path_;
  }
  drop();
  path_ = stem_;
  path_ += keep ? ".bin" : fmt::format("-{}.bin", ++count_);
  if (!keep) return path_;
  // The worker may have put something there: opening a pipe would wait for ever.
  ::unlink(path_.c_str());
  kept_.emplace(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (kept_->get() < 0) {
    const int error = errno;
    kept_.reset();
    throw std::system_error(error, std::generic_category(), path_.string());
  }
  return path_;
}

void ExchangeFile::spoil() {
  struct stat status {};
  if (::fstat(kept_->get(), &status) != 0 || status.st_size == 0) return;
  const std::vector<std::byte> nothing(static_cast<std::size_t>(status.st_size), std::byte{0xff});
  writeBytes(kept_->get(), nothing, path_);
}

nlohmann::json ExchangeFile::write(const ArrayWriter& arrays) {
  if (!kept_) return arrays.write(path_);
  writeBytes(kept_->get(), arrays.bytes(), path_);
  return arrays.list();
}

ArrayReader ExchangeFile::read(const nlohmann::json& list) const {
  const std::string name = path_.filename().string();
  if (!kept_) return {path_, list};
  return {RegularFile(Descriptor(::fcntl(kept_->get(), F_DUPFD_CLOEXEC, 5))), name, list};
}

void ExchangeFile::done() {
  if (!kept_) drop();
}

}  // namespace crossgrain
