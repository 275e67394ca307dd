#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/cell_grid.hpp"
#include "engines/grain/pair_list.hpp"
#include "engines/grain/skin.hpp"
#include "engines/grain/thread_team.hpp"

namespace grain {

/// A disk whose position is not finite; the number is the state's.
struct NotFinite {
  std::size_t disk;
};

/// Where the disks of a pair belong: j in the same part as i, in a later part, or of a wall.
enum class Sort { inside, across, walls };
/// In the order in which a disk's pairs are summed up.
inline constexpr std::array sorts{Sort::inside, Sort::across, Sort::walls};

/// @throws NotFinite
void requireFinite(const Places& now);

/// Verlet lists of two levels. A step works through the near pairs. They are chosen from the far
/// ones for as long as every disk stays within its allowance, which is what it would travel in some
/// steps: fast disks have a long one, so that slow ones need not be listed with all their
/// neighbourhood. The far pairs are collected from a cell grid when the skin is used up. Neither
/// changes a bit of the forces: a pair that does not touch adds nothing, and those that do are
/// always in the same order.
///
/// The moving disks are cut into as many parts as there are threads. A pair is listed with the part
/// of its lower disk i.
template <class Real>
class PairLists {
 public:
  /// @param moving   disks 0 … moving−1 move; those after belong to walls and never meet each other
  /// @param maxOverlap  of any pair, in units of the smaller radius; it may be infinite
  /// @param range  how far apart bodies may be in contact [m]
  PairLists(std::size_t moving, std::size_t parts, PairSprings springs, Skin skin,
            double maxOverlap, double range = 0.0);

  std::size_t partBegin(std::size_t part) const { return moving_ * part / parts(); }
  std::size_t parts() const { return lists_.size(); }

  /// Chooses the near pairs anew, and collects the far ones where the skin does not last.
  /// @param travel  of each disk in a step [m]
  /// @throws NotFinite, TooDeep; so do all that choose near pairs
  void update(const Places& now, std::span<const double> travel, std::size_t stepsSince,
              ThreadTeam& team);
  /// Collects everything anew.
  void rebuild(const Places& now, std::span<const double> travel, ThreadTeam& team);
  /// The same for disks that have other numbers now. @param newNumber  old → new
  void renumber(std::span<const std::int32_t> newNumber, const Places& now,
                std::span<const double> travel, ThreadTeam& team);

  /// How far each disk may be from where it was at the last update [m].
  std::span<const double> allowances() const { return allowance_; }

  PairList<Real>& list(std::size_t part, Sort sort) {
    return lists_[part][static_cast<std::size_t>(sort)];
  }
  const PairList<Real>& list(std::size_t part, Sort sort) const {
    return lists_[part][static_cast<std::size_t>(sort)];
  }
  PairSprings springs() const { return springs_; }
  PairCounts counts() const;
  const Skin& skin() const { return skin_; }
  void pairsTook(double seconds) { skin_.pairsTook(seconds, counts().near); }

  /// All springs that are not at rest, in any order; and such springs into lists built anew.
  std::vector<KeptSpring> stretched() const;
  void restoreSprings(std::vector<KeptSpring> springs, const Places& now,
                      std::span<const double> travel, ThreadTeam& team);

 private:
  double skinUsed(const Places& now) const;
  void carrySprings();
  void collect(const Places& now, ThreadTeam& team);
  void collectPart(std::size_t part, const Places& now);
  void refresh(const Places& now, ThreadTeam& team);
  std::size_t partOf(std::int32_t disk) const;

  std::size_t moving_;
  PairSprings springs_;
  double maxOverlap_, range_;
  Skin skin_;
  CellGrid grid_;
  std::vector<std::array<PairList<Real>, 3>> lists_;
  std::vector<std::vector<std::int32_t>> row_;  ///< by part: partners of the disk at hand
  std::vector<std::size_t> touching_;           ///< by part, at the last update
  std::vector<double> allowance_;               ///< of each disk [m]
  std::vector<Vec<double>> built_;              ///< places at the last rebuild
};

}  // namespace grain
