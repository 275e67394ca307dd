#pragma once

#include <optional>
#include <string>
#include <vector>

#include "averaging/regime.hpp"
#include "averaging/trend.hpp"
#include "results/agreement.hpp"

/// In what state runs were while they were averaged: in which regime, and steady or not.
namespace crossgrain::inline results {

/// One run's regime with the figures that it was read from (averaging/regime.hpp).
struct RegimeRow {
  std::optional<Regime> regime;  ///< absent: the run does not show enough
  std::string reason;
  std::optional<double> wheelContacts, wheelSlip, shearShare, inertialNumber, blockedFraction;
};

/// How a series changed over the averaged time (averaging/trend.hpp).
struct SeriesDrift {
  std::string quantity;  ///< name of the series
  RelativeDrift drift;
};

/// Of one engine, over packings.
struct EngineDrift : SeriesDrift {
  std::string engine;
  int packings = 0;
  std::vector<int> drifting;  ///< indices of those that drift by themselves
};

/// The packings that two engines both have a regime for, and those on which it is not the same.
struct RegimesOfPair {
  std::string a, b;
  PairKind kind = PairKind::peer;
  int packings = 0;
  std::vector<int> differ;  ///< indices of packings
};

}  // namespace crossgrain::inline results
