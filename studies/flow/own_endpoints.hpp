#pragma once

#include <optional>
#include <string>

#include "cases/case.hpp"
#include "results/run.hpp"

namespace crossgrain::inline studies {

/// An endpoint that the case makes up itself, of one finished run. [unit of the endpoint]
struct OwnValue {
  std::optional<double> value;  ///< absent where there is nothing to measure
  std::string why;              ///< why it is absent, where more can be said of it
};

/// A run that lacks more than mostMissing of the snapshots that a number is made of has no value: a
/// mean over what is left is off the mean over all by up to that share of the quantity's range, and
/// margins are a tenth to a quarter of what is measured.
OwnValue ownEndpointOf(const OwnEndpoint& endpoint, const Case& setup, const FlowRun& run);

inline constexpr double mostMissing = 0.05;

}  // namespace crossgrain::inline studies
