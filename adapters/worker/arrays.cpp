#include "adapters/worker/arrays.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace crossgrain {
namespace {

static_assert(std::endian::native == std::endian::little, "array files are little-endian");
static_assert(sizeof(Vec2) == 2 * sizeof(double), "a list of Vec2 is a list of doubles");
static_assert(sizeof(Vec3) == 3 * sizeof(double), "a list of Vec3 is a list of doubles");

std::size_t sizeOfType(const std::string& type) {
  if (type == "f64") return 8;
  if (type == "i32") return 4;
  if (type == "u8") return 1;
  return 0;
}

/// One that has grown beyond is made anew rather than spoiled [bytes].
constexpr off_t longestKept = off_t{16} << 20;

/// Writes at a descriptor's beginning. @throws std::system_error naming the file
void writeBytes(int descriptor, std::span<const std::byte> bytes,
                const std::filesystem::path& file) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t put =
        ::pwrite(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0)
      throw std::system_error(put < 0 ? errno : EIO, std::generic_category(),
                              fmt::format("cannot write {}", file.string()));
    done += static_cast<std::size_t>(put);
  }
}

}  // namespace

void ArrayWriter::append(const std::string& name, const char* type, std::size_t count,
                         std::span<const std::byte> bytes) {
  bytes_.resize((bytes_.size() + 7) / 8 * 8);  // so that a reader may map the file
  list_.push_back({{"name", name}, {"type", type}, {"count", count}, {"offset", bytes_.size()}});
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void ArrayWriter::add(const std::string& name, std::span<const double> values) {
  append(name, "f64", values.size(), std::as_bytes(values));
}

void ArrayWriter::add(const std::string& name, std::span<const std::int32_t> values) {
  append(name, "i32", values.size(), std::as_bytes(values));
}

void ArrayWriter::add(const std::string& name, std::span<const std::uint8_t> values) {
  append(name, "u8", values.size(), std::as_bytes(values));
}

// A worker knows where the next file will be and may have put something there: opening a pipe would
// wait for ever, following a link would write what it points to.
nlohmann::json ArrayWriter::write(const std::filesystem::path& file) const {
  ::unlink(file.c_str());
  return writeTo(file, O_EXCL);
}

nlohmann::json ArrayWriter::writeOver(const std::filesystem::path& file) const {
  return writeTo(file, 0);
}

nlohmann::json ArrayWriter::writeTo(const std::filesystem::path& file, int flags) const {
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0666));
  if (out.get() < 0)
    throw std::system_error(errno, std::generic_category(),
                            fmt::format("cannot write {}", file.string()));
  writeBytes(out.get(), bytes_, file);
  return list_;
}

ArrayReader::ArrayReader(const std::filesystem::path& file, const nlohmann::json& list)
    : ArrayReader(RegularFile(file), file.filename().string(), list) {}

ArrayReader::ArrayReader(RegularFile in, std::string file, const nlohmann::json& list)
    : file_(std::move(file)), in_(std::move(in)) {
  if (in_->state() == RegularFile::State::missing)
    throw std::runtime_error(fmt::format("there is no array file {}", file_));
  if (in_->state() == RegularFile::State::special)
    throw std::runtime_error(fmt::format("{} is not a regular file", file_));
  take(list, in_->size());
}

ArrayReader::ArrayReader(std::string content, std::string file, const nlohmann::json& list)
    : file_(std::move(file)), content_(std::move(content)) {
  take(list, content_.size());
}

void ArrayReader::take(const nlohmann::json& list, std::size_t length) {
  for (const nlohmann::json& item : list) {
    const auto name = item.at("name").get<std::string>();
    for (const char* key : {"count", "offset"})
      if (!item.at(key).is_number_integer() || item.at(key).get<std::int64_t>() < 0)
        throw std::runtime_error(fmt::format("{}: {} of {} is {}, not a whole number ≥ 0", file_,
                                             key, name, item.at(key).dump()));
    const Entry entry{item.at("type").get<std::string>(), item.at("count").get<std::size_t>(),
                      item.at("offset").get<std::size_t>()};
    const std::size_t size = sizeOfType(entry.type);
    if (size == 0)
      throw std::runtime_error(fmt::format("{}: {} has the type '{}' (it is one of: f64, i32, u8)",
                                           file_, name, entry.type));
    if (entry.offset > length || entry.count > (length - entry.offset) / size)
      throw std::runtime_error(
          fmt::format("{} is too short: {} needs {} × {} bytes from byte {}, the file has {} bytes",
                      file_, name, entry.count, size, entry.offset, length));
    if (!arrays_.try_emplace(name, entry).second)
      throw std::runtime_error(fmt::format("{}: {} is listed twice", file_, name));
  }
}

const ArrayReader::Entry& ArrayReader::find(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end())
    throw std::runtime_error(fmt::format("{} has no array '{}'", file_, name));
  return found->second;
}

template <typename Value>
std::vector<Value> ArrayReader::read(const std::string& name, const char* type,
                                     std::size_t count) const {
  const Entry& entry = find(name);
  if (entry.type != type || entry.count != count)
    throw std::runtime_error(fmt::format("{}: {} is {} × {}, expected {} × {}", file_, name,
                                         entry.count, entry.type, count, type));
  std::vector<Value> values(count);
  const auto bytes = std::as_writable_bytes(std::span(values));
  if (!in_)  // take() made sure that it lies within
    std::memcpy(bytes.data(), content_.data() + entry.offset, bytes.size());
  else if (in_->read(entry.offset, bytes) != bytes.size())
    throw std::runtime_error(fmt::format("cannot read {} of {}", name, file_));
  return values;
}

std::vector<double> ArrayReader::numbers(const std::string& name) const {
  const Entry& entry = find(name);
  const auto widened = [](const auto& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  if (entry.type == "i32") return widened(i32(name, entry.count));
  if (entry.type == "u8") return widened(u8(name, entry.count));
  return f64(name, entry.count);
}

std::vector<double> ArrayReader::f64(const std::string& name, std::size_t count) const {
  std::vector<double> values = read<double>(name, "f64", count);
  for (std::size_t k = 0; k < count; ++k)
    if (!std::isfinite(values[k]))
      throw std::runtime_error(fmt::format("{}: {}[{}] is {}", file_, name, k, values[k]));
  return values;
}

std::vector<std::int32_t> ArrayReader::i32(const std::string& name, std::size_t count) const {
  return read<std::int32_t>(name, "i32", count);
}

std::vector<std::uint8_t> ArrayReader::u8(const std::string& name, std::size_t count) const {
  return read<std::uint8_t>(name, "u8", count);
}

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
