#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// The most disks that a scaled cell can have: above, ids and array files come to their ends.
inline constexpr std::size_t mostScaled = 20'000'000;

/// Whether a case is a Couette cell whose disks are made, not read from a file.
bool canBeScaled(const Case& setup);

/// A cell blown up until it holds `disks` moving disks: both radii grow by one factor, disks and
/// wall disks keep their size, small and large ones their proportion; the wheel turns slower, so
/// that its rim keeps its speed. What is kept is ν̄ of the room that the walls leave: at the same ν̄
/// of the whole ring, of which walls take less and less, a large cell falls below the transition
/// and its disks hardly touch.
/// @pre canBeScaled()
Case scaledCase(Case setup, std::size_t disks);

/// That cell filled, at rest in the bulk, with the case's law, bottom plate and time step; the
/// packing is kept in `folder` as an HDF5 file that is also a `particles.file` of a case, or made
/// anew each time where it cannot be kept.
///
/// A stand-in for cases/preparation, which takes seconds of simulated time: size disorder on a
/// jittered lattice, relaxed without friction in a viscous bath, then sheared for some thousand
/// steps under the law itself. Ids are at random in space, as a real preparation leaves them.
/// Unlike a real packing it has no shear band, no chains of force that shear built up and next to
/// no motion in the bulk, so the list of neighbours is rebuilt for the disks at the wheel alone.
/// tests/bench/README.md has the contacts per disk of both.
/// @param progress  called with the fraction done, 0 … 1, if it has to be made
Packing scaledPacking(const Case& scaled, const std::filesystem::path& folder,
                      const std::function<void(double)>& progress);

}  // namespace crossgrain::inline cases
