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
  Mixtures mixtures = Mixtures::all;
  std::vector<Numbers> parts;  ///< by difference; absent where a run has no such number
  Numbers interaction;         ///< 0 where all mixtures ran
  /// By index of differences; the largest first, those that matter.
  struct Pair {
    std::size_t one, other;
    double share;
  };
  std::vector<Pair> pairs;
  struct Step {
    std::size_t taken;
    double left;
  };
  std::vector<Step> path;
  int runs = 0;
};

/// How a difference is taken apart.
struct AttributionPlan {
  std::size_t differences = 0;
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
/// Where all mixtures of k differences ran, the part of i is its Shapley value (Shapley 1953),
///   φ_i = Σ_{S ∌ i} |S|! (k − |S| − 1)!/k! · [v(S ∪ i) − v(S)],
/// the mean over all orders in which differences can be taken of what i adds when its turn comes;
/// two interact by (Grabisch and Roubens 1999)
///   I_ij = Σ_{S ∌ i, j} |S|! (k − |S| − 2)!/(k − 1)! · [v(S ∪ ij) − v(S ∪ i) − v(S ∪ j) + v(S)].
/// Else the part is the mean of what i does alone and what taking it back does,
///   ½ [v(i) − v(0) + v(all) − v(all less i)],
/// and I_ij is that of S = 0.
/// @returns nothing where one of the runs that it takes cannot be made
std::optional<Attribution> attribute(const AttributionPlan& plan, const RunMixture& run);

/// Mixtures that attribute() asks for where it does not search, from the reference to the peer.
/// @param mostMixed  AttributionPlan::mostMixed
std::set<Mixture> mixturesOf(std::size_t differences, std::size_t mostMixed);

}  // namespace crossgrain::inline studies
