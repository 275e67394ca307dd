#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossgrain::inline support {

/// Closes an HDF5 handle of any kind at the end of the scope.
class Hdf5Handle {
 public:
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  ~Hdf5Handle() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: reads as the handle it is

 private:
  hid_t id_;
};

/// An HDF5 file of arrays of doubles and 32-bit integers, with attributes. A new file is built in
/// memory and written in one go by save(), so that a full disk leaves no half file; one that grows
/// over a long run is on disk from the start.
/// HDF5 is used from one thread at a time: an open file holds a lock on the whole library, so open
/// late and close early.
class Hdf5File {
 public:
  /// A new file in memory, to be saved as `file`.
  static Hdf5File create(const std::filesystem::path& file);
  /// A file on disk to which more is added, made if it is missing; save() ends an addition.
  /// @throws OutputError
  static Hdf5File append(const std::filesystem::path& file);
  /// @throws std::runtime_error if it is missing or not HDF5
  static Hdf5File open(const std::filesystem::path& file);

  Hdf5File(Hdf5File&&) noexcept;
  Hdf5File& operator=(Hdf5File&&) = delete;
  ~Hdf5File();

  /// Writes under a path such as "/step-3/position"; groups in between are made.
  /// `columns` > 1 makes the array two-dimensional.
  void write(const std::string& path, const double* values, std::size_t rows, std::size_t columns);
  void write(const std::string& path, const std::vector<double>& values);
  void write(const std::string& path, const std::vector<std::int32_t>& values);
  void writeAttribute(const std::string& name, double value);
  void writeAttribute(const std::string& name, const std::string& value);

  /// Writes, of all that was written so far, a checksum of names and contents.
  void writeChecksum();
  /// Whether what was read so far is all that the file's checksum is of, to the bit: no less, no
  /// more.
  bool isAsWritten() const;

  /// Writes what create() or append() began. @throws OutputError
  void save();

  bool holds(const std::string& path) const;

  /// How many numbers an array has; absent if the file has none of that name.
  std::optional<std::size_t> length(const std::string& path) const;
  /// The whole array, row by row; absent if the file has none of that name.
  std::optional<std::vector<double>> read(const std::string& path) const;
  /// One value; absent if the file has none of that name. @throws std::runtime_error for another
  /// kind of thing under that name
  std::optional<double> readAttribute(const std::string& name) const;
  std::optional<std::string> readTextAttribute(const std::string& name) const;
  /// One value of a group or array instead of the file.
  std::optional<double> readAttributeOf(const std::string& path, const std::string& name) const;

 private:
  enum class Place { memory, disk };
  Hdf5File(hid_t file, std::filesystem::path name, Place place, std::unique_lock<std::mutex> lock);
  void writeArray(const std::string& path, const void* values, hid_t type, std::size_t rows,
                  std::size_t columns);
  void check(herr_t status, const std::string& what) const;
  void saw(const std::string& name, std::string_view bytes) const;
  std::string checksum() const;
  std::optional<double> readAttribute(hid_t of, const std::string& name,
                                      const std::string& shown) const;

  std::unique_lock<std::mutex> lock_;
  hid_t file_;
  std::filesystem::path name_;
  Place place_;
  mutable std::map<std::string, std::uint64_t> seen_;  ///< checksums of what was written or read
};

/// Reads a file that others made for trial, in a process of its own with bounds on memory and time.
/// HDF5 1.10.8 (Debian 12) does not get over every damaged file: it may crash, go round for ever,
/// or take all memory that there is.
/// @param read  what is going to be read of it, by Hdf5File; what it changes is lost
/// @throws BadInput, if it threw or did not come to an end; Interrupted
void tryReading(const std::filesystem::path& file, const std::function<void()>& read);

}  // namespace crossgrain::inline support
