#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "adapters/worker/arrays.hpp"
#include "support/descriptor.hpp"

namespace crossgrain {

/// The files in which arrays travel between the harness and one worker, one for each exchange: each
/// a new one, or, for a worker that writes over what is there, the same again and again. (Making
/// and removing a file takes as long as the exchange of a small scene does.)
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

  /// The exchange is over: a file that is not kept goes.
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
