#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "results/lockstep_findings.hpp"
#include "studies/lockstep/window.hpp"

/// How far two runs from the same start have come apart. No engine is asked here.
namespace crossgrain::inline studies {

/// The disk that is farthest off.
struct Farthest {
  std::size_t disk = 0;
  double distance = 0.0;  ///< [d]
};

/// By disk [d].
template <int D>
std::vector<double> distances(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other,
                              double diameter);

template <int D>
Farthest farthest(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other, double diameter);

/// All components of the separation as one vector: positions in d, and spins by the angle of a
/// rim's turn since the start, (Δω t/2) [-], where both show them at one time.
template <int D>
std::vector<double> separationVector(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other,
                                     double diameter);

/// Contacts of the mirror in one window, each counted once for each kind that it was seen as.
/// @param wallFrom  ids from here on are the walls'
template <int D>
ContactKinds kindsVisited(const std::vector<LockstepFrameOf<D>>& mirror, std::size_t wallFrom);

/// Forces of the first frame. Absent where the engine does not report them.
template <int D>
std::optional<LockstepForces> forcesOfFirstStep(const LockstepWindowOf<D>& window);

/// Of many starts: counts add up, the largest difference stays.
LockstepForces together(const LockstepForces& one, const LockstepForces& other);

/// Where the two first differ by more than `limits` [d], by frame; the start is left at 0.
template <int D>
std::optional<FirstExceedance> firstExceedance(const LockstepWindowOf<D>& window, double diameter,
                                               const std::vector<double>& limits,
                                               std::size_t wallFrom);

}  // namespace crossgrain::inline studies
