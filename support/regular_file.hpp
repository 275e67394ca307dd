#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "support/descriptor.hpp"

namespace crossgrain::inline support {

/// A file that a worker may have put there, open for reading. A pipe or a device under its name
/// might never end, or hold who opens it: it is not opened for reading at all.
class RegularFile {
 public:
  enum class State { open, missing, special };

  explicit RegularFile(const std::filesystem::path& file);
  /// One that is open already.
  explicit RegularFile(Descriptor in);

  State state() const { return state_; }
  std::size_t size() const { return size_; }  ///< [bytes] when it was opened; 0 unless open

  /// Fills `bytes` from `offset` on. @returns how many there were
  std::size_t read(std::size_t offset, std::span<std::byte> bytes) const;

 private:
  Descriptor in_;
  State state_ = State::missing;
  std::size_t size_ = 0;
};

}  // namespace crossgrain::inline support
