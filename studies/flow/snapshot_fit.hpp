#pragma once

#include <string>
#include <string_view>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"

/// Checks whether snapshots of files are of the case that they are averaged by. Snapshots of
/// one scene averaged with the bins of another give numbers without meaning.
namespace crossgrain::inline studies {

/// Where snapshots come from, for messages.
struct SnapshotOrigin {
  std::string name;           ///< "out/mine.h5"
  std::string settings = {};  ///< "[engines.mine]", where their units are said; empty: they are SI
  double length = 1.0, mass = 1.0;  ///< units that are said there [m], [kg]
};

/// The unit with which a number would be what it should be: "; are lengths in mm? say length =
/// 0.001 in [engines.mine]". Empty where it is not off by a power of ten.
/// @param key  "length" or "mass"
std::string unitHint(double found, double target, std::string_view key,
                     const SnapshotOrigin& origin);

/// Disks of a file between the case's walls, which are where they are at t = 0. Of an assembly the
/// disks' order is that of its groups.
/// @throws BadInput for another number of disks than the case has
template <int D>
SceneOf<D> sceneAround(const Case& setup, DisksOf<D> disks, const SnapshotOrigin& origin);

/// Mass in the case of a disk, or sphere, of that radius, number k of an assembly [kg].
template <int D>
double massOf(const Case& setup, std::size_t k, double radius);

/// Compared with the case are disks (how many of each radius, their masses; not where the case
/// takes them from a packing file), and of a Couette cell wall disks (how many, radius, distance
/// from the axis), the wheel's rate and where the disks' centres are. Walls of an assembly are the
/// case's own.
/// @throws BadInput naming the origin and all that does not fit, in one line
template <int D>
void requireFit(const SceneOf<D>& scene, const SnapshotOf<D>& first, const Case& setup,
                const SnapshotOrigin& origin);

}  // namespace crossgrain::inline studies
