#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engines/grain/skin.hpp"
#include "engines/grain/space_cells.hpp"
#include "engines/grain/space_contacts.hpp"
#include "engines/grain/thread_team.hpp"

namespace grain {

/// Verlet lists of two levels, as PairLists of the plane: near pairs for as long as every sphere
/// stays within its allowance, chosen from far ones, which a cell grid collects when the skin is
/// used up. Pairs are in ascending (i, j), whatever the skin; i moves, j moves or is of a wall.
///
/// The spheres are cut into as many parts as there are threads; those of walls are the last part's.
/// A pair is listed with the part of its i: inside, or across if j is another part's.
class SpaceLists {
 public:
  /// @param moving   spheres 0 … moving−1 move; those after belong to walls and never meet
  /// @param range    how far apart bodies may be in contact [m]
  /// @param records  of contacts
  SpaceLists(std::size_t moving, std::size_t parts, const SpaceBox& box, Skin skin, double range,
             const SpaceRecords& records, const SpaceKernels& kernels);

  std::size_t parts() const { return parts_.size(); }
  /// The first moving sphere of a part; of part parts() their end.
  std::size_t partBegin(std::size_t part) const { return moving_ * part / parts(); }
  /// Whether a sphere, of a wall or not, is of this part or one before.
  bool isUpTo(std::size_t part, std::size_t sphere) const {
    return part + 1 == parts() || sphere < partBegin(part + 1);
  }

  /// Chooses the near pairs anew, and collects the far ones where the skin does not last.
  /// @param position  w: radius  @param travel  of each in a step [m]
  /// @throws NotFinite
  void update(std::span<const Quad> position, std::span<const double> travel,
              std::size_t stepsSince, ThreadTeam& team);

  /// A pair that touches, on its way to other numbers or a file.
  struct Kept {
    std::int32_t i, j;
    SpaceMemory<double> memory;
    SpaceResult result;
  };
  /// In ascending (i, j).
  std::vector<Kept> touching();
  /// Lists built anew, of pairs that touch.
  /// @throws NotFinite
  void restore(std::vector<Kept> touching, std::span<const Quad> position,
               std::span<const double> travel, ThreadTeam& team);

  /// The same for spheres that have other numbers now. @param newNumber  old → new
  void renumber(std::span<const std::int32_t> newNumber, std::span<const Quad> position,
                std::span<const double> travel, ThreadTeam& team);

  /// How far each sphere may be from where it was at the last update [m].
  std::span<const double> allowances() const { return allowance_; }
  SpacePairs inside(std::size_t part) { return parts_[part].near[0].view(); }
  SpacePairs across(std::size_t part) { return parts_[part].near[1].view(); }
  /// Calls visit(pairs) for each list of near pairs.
  void forNear(auto&& visit) {
    for (Part& part : parts_)
      for (NearPairs& pairs : part.near) visit(pairs.view());
  }
  std::size_t rebuilds() const { return skin_.rebuilds(); }
  /// A pair that touches costs as much as some thirty that are only looked at.
  void pairsTook(double seconds, std::size_t touching) {
    skin_.pairsTook(seconds, counts().near + 30 * touching);
  }

 private:
  struct NearPairs {
    std::vector<std::int32_t> i, j;
    Array<Quad> shifts;  ///< none, then those of pairs across a border
    std::vector<std::int32_t> shiftOf;
    std::vector<double> within;
    SpaceContacts contacts;  ///< with room to spare, as pushes
    std::vector<std::uint8_t> touches;
    std::vector<SpacePush> pushes;  ///< of pairs across
    /// Those that touched at the choice before, in ascending (i, j).
    std::vector<std::int32_t> beforeI, beforeJ;
    SpaceContacts before;

    explicit NearPairs(const SpaceRecords& records) : contacts(records), before(records) {}
    SpacePairs view();
    void rememberTouching();
    void remember(const std::vector<Kept>& touching);
    void makeRoom(std::size_t count, bool apart);
  };
  struct Part {
    std::vector<SpaceNeighbour> far, row;
    std::vector<std::int32_t> farBegin;
    std::vector<SpaceChoice> chosen;
    std::array<NearPairs, 2> near;  ///< inside, across
    double skinUsed = 0.0;          ///< [m]

    explicit Part(const SpaceRecords& records) : near{NearPairs(records), NearPairs(records)} {}
  };

  void requireFinite(std::span<const Quad> position) const;
  void rebuild(std::span<const Quad> position, ThreadTeam& team);
  double skinUsed(std::size_t part, std::span<const Quad> position) const;
  void collect(std::size_t part, std::span<const Quad> position);
  void choose(std::span<const Quad> position, ThreadTeam& team);
  void chooseNear(std::size_t part, std::span<const Quad> position);
  static void sortChosen(Part& part, std::size_t count);
  PairCounts counts() const;
  /// Spheres of a part among `all`, those of walls too.
  std::array<std::size_t, 2> members(std::size_t part, std::size_t all) const {
    return {partBegin(part), part + 1 == parts() ? all : partBegin(part + 1)};
  }

  std::size_t moving_;
  Skin skin_;
  double range_;
  SpaceNeighbourKernel neighbours_;
  SpaceChoiceKernel choose_;
  SpaceCells cells_;
  std::vector<Part> parts_;
  // Data that the choice from far pairs needs. The images are those of the 27 numbers.
  Array<Quad> place_, image_;
  std::vector<double> allowance_;
  Array<Quad> built_;  ///< places at the last rebuild
};

}  // namespace grain
