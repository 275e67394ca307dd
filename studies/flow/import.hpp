#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studies/core/study.hpp"
#include "studies/flow/snapshot_sources.hpp"

namespace crossgrain::inline studies {

/// Options of `import` beside its files and case.
struct ImportOptions {
  std::string format;               ///< of adapters/files/frame.hpp
  std::optional<std::string> name;  ///< of the settings' [engines.NAME]; absent: defaultName()
  std::string out;                  ///< the file to write
};

/// Files that were written.
struct Imported {
  std::string name;  ///< of who made them
  std::size_t snapshots = 0, disks = 0;
  double from = 0.0, to = 0.0;       ///< of the first and the last snapshot [s]
  std::vector<std::string> remarks;  ///< data that the files lack, with the consequence
};

/// Writes the snapshots of one run as HDF5 of our own layout (docs/files.md), with an XDMF file
/// beside it: those of the averaged time, each found sound. One snapshot is in memory at a time.
/// Replaces `out` if it is such a file. Of a dry run nothing is written, and there is the name
/// alone.
/// @throws BadInput naming the file, the snapshot and what is wrong: then nothing is written;
///         OutputError, Interrupted
Imported importSnapshots(const CommandLine& line, const ImportOptions& options);

}  // namespace crossgrain::inline studies
