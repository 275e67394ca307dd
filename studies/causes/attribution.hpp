#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "results/causes.hpp"

namespace crossgrain::inline studies {

/// Differences that a run takes from the peer, bit by bit: 0 is the reference, all bits the peer.
using Mixture = std::uint64_t;

/// Numbers of a run of that mixture, v(S), always the same ones in one order; absent where it
/// cannot be run.
using RunMixture = std::function<std::optional<Numbers>(Mixture)>;

/// A difference of numbers, taken apart: v(all) − v(0) = Σ parts + interaction.
struct Attribution {
  std::vector<Numbers> parts;  ///< by difference; absent where a run has no such number
  Numbers interaction;         ///< 0 where all mixtures ran
};

/// How a difference is taken apart.
struct AttributionPlan {
  /// Up to so many all 2^k mixtures run. Of more, those that do nothing at either end are left out
  /// first.
  std::size_t mostMixed = 6;
  /// Whether, where not all mixtures ran, pairs that interact are run, and a path from the
  /// reference to the peer.
  bool searches = true;
  std::vector<double> units = {};  ///< of each number, for what is taken over all; empty: 1
};

/// Parts of v(all) − v(0) that differences have.
///
/// Effect of t differences T together, beyond those of fewer of them, beside others S,
///   Δ_T(S) = Σ_{L ⊆ T} (−1)^{t − |L|} v(S ∪ L).
/// Where all mixtures of k differences ran, its mean over all orders in which they can be taken
/// (Grabisch and Roubens 1999),
///   I_T = Σ_{S ∌ T} |S|! (k − |S| − t)!/(k − t + 1)! · Δ_T(S),
/// is of one difference its part, the Shapley value (Shapley 1953), and of two how they interact.
/// Else the part is the mean of what i does alone and what taking it back does,
///   ½ [Δ_i(0) + Δ_i(all less i)],
/// and two interact by Δ_ij(0).
/// @param causes  the differences, by index; mixtures, interactions, path and runs are added
/// @returns nothing where one of the runs that it takes cannot be made
std::optional<Attribution> attribute(Causes& causes, const AttributionPlan& plan,
                                     const RunMixture& run);

/// Mixtures that attribute() asks for where it does not search, from the reference to the peer.
/// @param mostMixed  AttributionPlan::mostMixed
std::set<Mixture> mixturesOf(std::size_t differences, std::size_t mostMixed);

}  // namespace crossgrain::inline studies
