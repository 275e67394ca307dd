#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace crossgrain::inline results {

/// "/snapshot-NNN", counted from 0: the group of a snapshot in a file of snapshots, whose datasets
/// docs/files.md has.
inline std::string snapshotGroup(std::size_t k) {
  return fmt::format("/snapshot-{:03d}", k);
}

}  // namespace crossgrain::inline results
