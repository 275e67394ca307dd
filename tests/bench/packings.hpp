#pragma once

#include <cstddef>
#include <filesystem>

#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "engines/grain/simulation.hpp"

namespace crossgrain::bench {

/// The thesis' cell (cases/couette/nu-0.804.toml) blown up until it holds `disks` moving disks:
/// both radii grow by one factor, disks and wall disks keep their size, small and large ones their
/// proportion; the wheel turns slower, so that its rim keeps its speed. What is kept is ν̄ of the
/// room that the walls leave: at the same ν̄ of the whole ring, of which walls take less and less, a
/// large cell falls below the transition and its disks hardly touch.
Case scaledCase(std::size_t disks);

/// That cell filled, at rest in the bulk, with the thesis' law, bottom plate and time step; the
/// packing is kept in `folder` as an HDF5 file that is also a `particles.file` of a case.
///
/// A stand-in for cases/preparation, which takes seconds of simulated time: size disorder on a
/// jittered lattice, relaxed without friction in a viscous bath, then sheared for some thousand
/// steps under the law itself. Ids are at random in space, as a real preparation leaves them.
/// Unlike a real packing it has no shear band, no chains of force that shear built up and next to
/// no motion in the bulk, so the list of neighbours is rebuilt for the disks at the wheel alone.
/// README.md has the contacts per disk of both.
Packing packed(std::size_t disks, const std::filesystem::path& folder);

/// The same as a scene of the in-house engine.
grain::Setup packedSetup(std::size_t disks, const std::filesystem::path& folder);

}  // namespace crossgrain::bench
