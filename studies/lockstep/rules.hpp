#pragma once

#include <array>

/// Rules of lockstep. Fixed before any engine was measured, each with its reason.
namespace crossgrain::inline studies {

/// Double precision rounds positions to 1e-16 d; in 0.1 s of flow the separation of two runs grows
/// by e^(40/s · 0.1 s) = 55. The smallest difference of interest, 1e-4 of k_n, shows at 1e-7 d.
inline constexpr double lockstepRounding = 1e-10;  // [d]

/// A tenth of a per cent of k_n is far below what a constant of a granular material is known to.
inline constexpr double lockstepSameLaw = 1e-3;  // of the reference constant

/// Changes of the reference constant whose response in the mirror is the measure of a separation:
/// the rule itself and a tenth of it, both ways. Time goes in steps: a contact that is made or
/// broken a step earlier parts two runs by some 1e-6 d however little they differed before, and the
/// sooner the more they differ. Where a tenth of the rule still acts in proportion, with larger
/// separations than those of a right engine, no such event weighs as much as that tenth.
inline constexpr std::array referencePerturbations = {1e-4, -1e-4, 1e-3, -1e-3};  // of the constant

/// A disk's responses are in proportion where the largest of the four, per unit of change, is at
/// most twice the smallest: a reading is then good to that factor, and the verdict's limit is no
/// sharper. An event parts its two disks and then their neighbours; a start is read as long as half
/// of the disks that move at all are in proportion.
inline constexpr double responsesAlike = 2.0;

/// ... and lies a factor of ten below 0.1 d, where disks have other neighbours and separations
/// saturate.
inline constexpr double largestResponse = 0.01;  // [d]

/// Where no response shows, since nothing touches, disks follow no law but inertia and gravity. Two
/// right engines then differ by rounding; what differs by as much as an event is another motion.
inline constexpr double visibleMotion = 1e-6;  // [d]

/// The share of starts from which a right engine may be read beyond the rule, by an event that the
/// four responses do not have. Only a larger share is a difference, and that it is larger must be
/// shown: by the exact (Clopper-Pearson) bound of a share at this confidence, and from two starts
/// at least. 2 of 4, 3 of 16 and 7 of 64 starts show it; 1 of 4, 2 of 16 and 6 of 64 do not.
inline constexpr double strayShare = 0.05;
inline constexpr double shareConfidence = 0.95;

/// Fewer starts that can be read say nothing; all of them, where fewer were asked for.
inline constexpr std::size_t leastRead = 4;

/// From a fraction of a contact to where chaos has had its part. The last is the window's length.
inline constexpr std::array lockstepTimes = {1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 50e-3, 100e-3};  // [s]

/// A smaller separation of an engine from its mirror is rounding and contacts made a step earlier,
/// and has no name.
inline constexpr double leastNamed = 1e-6;  // of the reference constant

/// Starts along the flow; what n windows do not show happens in less than 3/n of all, at 95 %.
inline constexpr std::size_t lockstepStarts = 16;
inline constexpr std::size_t quickLockstepStarts = 4;  ///< of commands in a hurry

/// Windows within an engine's own run that reference perturbations are applied to: as many as
/// starts.
inline constexpr std::size_t lateWindowsMeasured = lockstepStarts;

/// A mirror whose spot check leaves more than a margin of an endpoint open says nothing of it that
/// the engine's own runs would not say better.
inline constexpr double largestReach = 1.0;  // [margins]

/// Every engine runs seven windows from each start of a baseline, and a start takes some megabytes.
inline constexpr std::size_t baselineStarts = 8;

/// Enough contacts of every kind to tell conventions apart, and every trial runs from each.
inline constexpr std::size_t identifyStarts = 6;

/// Starts lie within so many steps of the hand-over, so that finding them costs seconds.
inline constexpr double startSteps = 40000;

}  // namespace crossgrain::inline studies
