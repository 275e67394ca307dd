#include "adapters/worker/arrays.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace crossgrain {
namespace {

static_assert(std::endian::native == std::endian::little, "array files are little-endian");
static_assert(sizeof(Vec2) == 2 * sizeof(double), "a list of Vec2 is a list of doubles");

std::size_t sizeOfType(const std::string& type) {
  if (type == "f64") return 8;
  if (type == "i32") return 4;
  if (type == "u8") return 1;
  return 0;
}

std::span<const double> flat(std::span<const Vec2> values) {
  return {reinterpret_cast<const double*>(values.data()), 2 * values.size()};
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

void ArrayWriter::add(const std::string& name, std::span<const Vec2> values) {
  add(name, flat(values));
}

nlohmann::json ArrayWriter::write(const std::filesystem::path& file) const {
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes_.data()),
            static_cast<std::streamsize>(bytes_.size()));
  out.close();
  if (!out)
    throw std::system_error(errno ? errno : EIO, std::generic_category(),
                            fmt::format("cannot write {}", file.string()));
  return list_;
}

// O_NONBLOCK: opening a pipe would wait for who writes to it.
ArrayReader::ArrayReader(const std::filesystem::path& file, const nlohmann::json& list)
    : file_(file.filename().string()),
      in_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  if (in_.get() < 0)
    throw std::runtime_error(fmt::format("there is no array file {}", file.string()));
  struct stat status {};
  if (::fstat(in_.get(), &status) != 0 || !S_ISREG(status.st_mode))
    throw std::runtime_error(fmt::format("{} is not a regular file", file_));
  const auto length = static_cast<std::size_t>(status.st_size);

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
    arrays_[name] = entry;
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
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(in_.get(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(entry.offset + done));
    if (got > 0)
      done += static_cast<std::size_t>(got);
    else if (got == 0 || errno != EINTR)
      throw std::runtime_error(fmt::format("cannot read {} of {}", name, file_));
  }
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

std::vector<Vec2> ArrayReader::vec2(const std::string& name, std::size_t count) const {
  const std::vector<double> numbers = f64(name, 2 * count);
  std::vector<Vec2> vectors(count);
  for (std::size_t k = 0; k < count; ++k) vectors[k] = {numbers[2 * k], numbers[2 * k + 1]};
  return vectors;
}

std::vector<std::int32_t> ArrayReader::i32(const std::string& name, std::size_t count) const {
  return read<std::int32_t>(name, "i32", count);
}

std::vector<std::uint8_t> ArrayReader::u8(const std::string& name, std::size_t count) const {
  return read<std::uint8_t>(name, "u8", count);
}

}  // namespace crossgrain
