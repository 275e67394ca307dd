#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/lockstep/terms.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {

/// How far apart two runs from each of some starts are at one time.
struct TermLook {
  double time = 0.0;                     ///< since the start [s]
  std::vector<LockstepFrame> unchanged;  ///< what the mirror does, by start
  std::vector<double> separation;        ///< of all starts, as separationVector() has it
};

/// What is to be accounted for.
struct TermSearch {
  std::vector<Scene> scenes;            ///< the mirror's, by start
  std::vector<TermLook> looks;          ///< in order of time
  double diameter = 0.0;                ///< [m]
  std::vector<MirrorChange> more = {};  ///< to be tried besides changesOf()
};

/// Tries every change of the mirror from every start, and those constants that explain most to
/// first order with the amount that they would have. @returns the one that leaves least at one of
/// the looks, in the mirror itself, if that is less than termUnexplained
/// @throws Interrupted
std::optional<NamedTerm> closestTerm(Engine& mirror, const TermSearch& search);

/// Separations of all starts at one of their frames.
std::vector<double> separationOfAll(const std::vector<std::vector<LockstepFrame>>& one,
                                    const std::vector<std::vector<LockstepFrame>>& other,
                                    std::size_t frame, double diameter);

/// Frames among which looks are chosen: all up to the first of those reported, and these.
std::vector<std::size_t> framesForTerms(const std::vector<std::size_t>& reported);

/// The looks, indices into framesForTerms(): from the first that shows what was first seen to the
/// first of those reported, or else that one alone. The earlier the better: a contact made or
/// broken at another step is no term's doing; but the first may hold little but what is beside the
/// term.
/// @param times  of all frames [s]
std::vector<std::size_t> looksForTerms(const std::vector<std::size_t>& reported,
                                       const std::vector<double>& times,
                                       const std::optional<FirstExceedance>& first);

/// Those of a window's frames, without their contacts.
std::vector<LockstepFrame> chosen(const std::vector<LockstepFrame>& window,
                                  const std::vector<std::size_t>& frames);

}  // namespace crossgrain::inline studies
