#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/files/contact_table.hpp"
#include "adapters/files/file_units.hpp"
#include "adapters/files/frame.hpp"

/// From the ids of files to those of a scene.
namespace crossgrain::files {

/// Which particle of the files is which disk: disks by rising id, wall disks by where they are.
class ParticleIds {
 public:
  /// @param walls  rows that are wall disks, in the order of wall disks
  ParticleIds(const std::vector<std::int64_t>& idOfRow, const std::vector<std::size_t>& walls);

  std::size_t disks() const { return disks_; }
  std::size_t size() const { return theirs_.size(); }
  /// Disks, then wall disks; absent: no such particle.
  std::optional<std::size_t> ourOf(std::int64_t id) const;
  std::int64_t theirOf(std::size_t our) const { return theirs_[our]; }

 private:
  RowOfId rows_;
  std::vector<std::size_t> ours_;  ///< of rows
  std::vector<std::int64_t> theirs_;
  std::size_t disks_ = 0;
};

/// Contacts of a frame by our ids, i < j, each once.
/// @param snapshot  all but its contacts; its planes follow from the basis, and in a periodic box
///                  the pairs are those of nearest images
/// @param remarks   what is missing and what that costs is added
/// @returns absent where the files do not say them
/// @throws BadInput naming the frame and the contact
template <int D>
std::optional<ContactsOf<D>> frameContacts(const FileFrame& frame, const FileUnits& units,
                                           const ParticleIds& ids, const SnapshotOf<D>& snapshot,
                                           const AuditBasisOf<D>& basis,
                                           std::set<std::string>& remarks);

}  // namespace crossgrain::files
