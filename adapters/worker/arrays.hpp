#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/vec2.hpp"
#include "support/descriptor.hpp"
#include "support/regular_file.hpp"

namespace crossgrain {

/// Array files: raw little-endian arrays one after the other. The JSON beside them lists, for each,
/// its name, type ("f64" | "i32" | "u8"), count of elements and offset [bytes].
/// A list of vectors is one f64 array: x0 y0 x1 y1 … in the plane, of twice as many elements; x0 y0
/// z0 x1 … in space.

/// Collects arrays and writes them as one file.
class ArrayWriter {
 public:
  void add(const std::string& name, std::span<const double> values);
  void add(const std::string& name, std::span<const std::int32_t> values);
  void add(const std::string& name, std::span<const std::uint8_t> values);
  template <int N>
  void add(const std::string& name, const std::vector<VecOf<N>>& values) {
    add(name, std::span(reinterpret_cast<const double*>(values.data()), N * values.size()));
  }

  /// Writes the file anew, whatever lies under its name. @returns the list that describes it
  /// @throws std::runtime_error naming the file
  nlohmann::json write(const std::filesystem::path& file) const;

  /// Writes into the file from its start on, over what is there; makes it if there is none.
  /// @returns, @throws likewise
  nlohmann::json writeOver(const std::filesystem::path& file) const;

  /// Content of the file, and the list that describes it.
  const std::vector<std::byte>& bytes() const { return bytes_; }
  const nlohmann::json& list() const { return list_; }

 private:
  void append(const std::string& name, const char* type, std::size_t count,
              std::span<const std::byte> bytes);
  nlohmann::json writeTo(const std::filesystem::path& file, int flags) const;

  nlohmann::json list_ = nlohmann::json::array();
  std::vector<std::byte> bytes_;
};

/// Reads an array file; nothing in it is trusted. Every failure is a std::runtime_error that names
/// the file, the array and what was expected. Memory is taken for the arrays that are asked for
/// alone, however long the file is.
class ArrayReader {
 public:
  /// Checks the list against the length of the file, which must be a regular one.
  ArrayReader(const std::filesystem::path& file, const nlohmann::json& list);
  /// The same of a file that is open. @param file  its name, for messages
  ArrayReader(RegularFile in, std::string file, const nlohmann::json& list);
  /// The same of its content.
  ArrayReader(std::string content, std::string file, const nlohmann::json& list);

  bool has(const std::string& name) const { return arrays_.contains(name); }

  /// The array of that name with exactly `count` elements, all finite.
  std::vector<double> f64(const std::string& name, std::size_t count) const;
  template <int N>
  std::vector<VecOf<N>> vectors(const std::string& name, std::size_t count) const {
    const std::vector<double> numbers = f64(name, N * count);
    std::vector<VecOf<N>> vectors(count);
    for (std::size_t k = 0; k < count; ++k) vectors[k] = VecOf<N>::Map(&numbers[N * k]);
    return vectors;
  }
  std::vector<std::int32_t> i32(const std::string& name, std::size_t count) const;
  std::vector<std::uint8_t> u8(const std::string& name, std::size_t count) const;

  /// An array of any type and count, as numbers.
  std::vector<double> numbers(const std::string& name) const;

  /// Number of elements of an array. @throws std::runtime_error if there is none of that name
  std::size_t count(const std::string& name) const { return find(name).count; }

 private:
  struct Entry {
    std::string type;
    std::size_t count = 0, offset = 0;
  };

  const Entry& find(const std::string& name) const;
  template <typename Value>
  std::vector<Value> read(const std::string& name, const char* type, std::size_t count) const;

  void take(const nlohmann::json& list, std::size_t length);

  std::string file_;
  std::optional<RegularFile> in_;  ///< absent: content_ is all there is
  std::string content_;
  std::map<std::string, Entry> arrays_;
};

/// Files in which arrays travel between the harness and one worker: a new one for each exchange, or
/// always the same for a worker that overwrites files. (Making and removing a file takes as long as
/// the exchange of a small scene.)
///
///   next ── write (load) or read (snapshot) ── done ── next …
class ExchangeFile {
 public:
  /// @param stem  SCRATCH/NAME of files SCRATCH/NAME-1.bin, NAME-2.bin, … or SCRATCH/NAME.bin
  explicit ExchangeFile(std::filesystem::path stem) : stem_(std::move(stem)) {}
  ~ExchangeFile();
  ExchangeFile(const ExchangeFile&) = delete;
  ExchangeFile& operator=(const ExchangeFile&) = delete;

  /// The file of the next exchange. One that is kept holds 0xff alone: NaN, and an id below 0, so
  /// that what a worker forgets to write is not taken for what it wrote before.
  /// @throws std::system_error
  const std::filesystem::path& next(bool keep);

  /// @returns the list that describes it. @throws std::system_error
  nlohmann::json write(const ArrayWriter& arrays);
  /// @throws std::runtime_error as ArrayReader
  ArrayReader read(const nlohmann::json& list) const;

  /// Ends the exchange: a file that is not kept is removed.
  void done();

 private:
  void drop();
  void spoil();

  std::filesystem::path stem_;
  std::filesystem::path path_;
  unsigned count_ = 0;
  std::optional<Descriptor> kept_;  ///< ours, whatever the worker puts under its name
};

}  // namespace crossgrain
