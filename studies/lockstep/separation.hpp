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
std::vector<double> distances(const LockstepFrame& one, const LockstepFrame& other,
                              double diameter);

Farthest farthest(const LockstepFrame& one, const LockstepFrame& other, double diameter);

/// All components of the separation as one vector: positions in d, and spins by the angle of a
/// rim's turn since the start, (Δω t/2) [-], where both show them at one time.
std::vector<double> separationVector(const LockstepFrame& one, const LockstepFrame& other,
                                     double diameter);

/// Contacts of the mirror in one window, each counted once for each kind that it was seen as.
/// @param wallFrom  ids from here on are the walls'
ContactKinds kindsVisited(const std::vector<LockstepFrame>& mirror, std::size_t wallFrom);

/// Forces of the first frame. Absent where the engine does not report them.
std::optional<LockstepForces> forcesOfFirstStep(const LockstepWindow& window);

/// Of many starts: counts add up, the largest difference stays.
LockstepForces together(const LockstepForces& one, const LockstepForces& other);

/// Where the two first differ by more than `limits` [d], by frame; the start is left at 0.
std::optional<FirstExceedance> firstExceedance(const LockstepWindow& window, double diameter,
                                               const std::vector<double>& limits,
                                               std::size_t wallFrom);

}  // namespace crossgrain::inline studies
