#pragma once

#include <array>

/// What lockstep goes by. Fixed before any engine was looked at, each with its reason.
namespace crossgrain::inline runs {

/// Double precision rounds positions to 1e-16 d; in 0.1 s of flow the separation of two runs grows
/// by e^(40/s · 0.1 s) = 55. The smallest difference of interest, 1e-4 of k_n, shows at 1e-7 d.
inline constexpr double lockstepRounding = 1e-10;  // [d]

/// A tenth of a per cent of k_n is far below what a constant of a granular material is known to.
inline constexpr double lockstepSameLaw = 1e-3;  // of the yardstick

/// Changes of the yardstick that separations are held against, both ways. Time goes in steps: a
/// contact that is made or broken a step earlier parts two runs by some 1e-6 d however little they
/// differed before, and more of them the more they differ. So a separation is not divided by that
/// of one change alone: it is found between those of several, which have such events too.
inline constexpr std::array yardstickChanges = {1e-6, 1e-4, 1e-2};  // of the constant

/// From a fraction of a contact to where chaos has had its part. The last is the window's length.
inline constexpr std::array lockstepTimes = {1e-3, 10e-3, 50e-3, 100e-3};  // [s]

/// By which constants are changed in search of what is off: small, so that no contact is made or
/// broken at another step, and large against rounding.
inline constexpr double termChange = 1e-4;  // of the constant

/// A term is named where it leaves less than half of the separation.
inline constexpr double termUnexplained = 0.5;

/// Starts along the flow; what n windows do not show happens in less than 3/n of all, at 95 %.
inline constexpr std::size_t lockstepStarts = 16;
inline constexpr std::size_t quickLockstepStarts = 4;  ///< of commands in a hurry

/// Windows within an engine's own run that the yardstick is applied to: as many as starts.
inline constexpr std::size_t lateWindowsMeasured = lockstepStarts;

/// A separation beyond that of the largest change tried is outside of what was measured, so no
/// bound on averages follows from it. Forces that differ by more move a stress by more.
inline constexpr double lateLimit = yardstickChanges.back();  // of the constant; of the force

/// Every engine runs seven windows from each start of a baseline, and a start takes some megabytes.
inline constexpr std::size_t baselineStarts = 8;

/// Enough contacts of every kind to tell conventions apart, and every trial runs from each.
inline constexpr std::size_t identifyStarts = 6;

/// Starts lie within so many steps of the hand-over, so that finding them costs seconds.
inline constexpr double startSteps = 40000;

}  // namespace crossgrain::inline runs
