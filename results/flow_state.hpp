#pragma once

#include <optional>
#include <string>
#include <vector>

#include "averaging/regime.hpp"
#include "averaging/trend.hpp"
#include "results/agreement.hpp"
#include "results/json_fields.hpp"

/// In what state runs were while they were averaged: in which regime, and steady or not.
namespace crossgrain::inline results {

/// One run's regime with the figures that it was read from (averaging/regime.hpp).
struct RegimeRow {
  std::optional<Regime> regime;  ///< absent: the run does not show enough
  std::string reason;
  std::optional<double> wheelContacts, wheelSlip, shearShare, inertialNumber, blockedFraction;

  void fields(auto& io) {
    io("name", regime);
    io("reason", reason);
    io("wheel_contacts", wheelContacts);
    io("wheel_slip", wheelSlip);
    io("shear_share", shearShare);
    io("inertial_number", inertialNumber);
    io("blocked_share", blockedFraction);
  }
};

/// How a series changed over the averaged time (averaging/trend.hpp).
struct SeriesDrift {
  std::string quantity;  ///< name of the series
  RelativeDrift drift;

  void fields(auto& io) {
    io("quantity", quantity, aName);
    io("verdict", drift.verdict);
    io("change", drift.change);
    io("half_width", drift.half);
    io("excluded", drift.excluded);
  }
};

/// Of one engine, over packings.
struct EngineDrift : SeriesDrift {
  std::string engine;
  int packings = 0;
  std::vector<int> drifting;  ///< indices of those that drift by themselves

  void fields(auto& io) {
    SeriesDrift::fields(io);
    io("engine", engine, aName);
    io("packings", packings);
    io("drifting", drifting);
  }
};

/// The packings that two engines both have a regime for, and those on which it is not the same.
struct RegimesOfPair {
  std::string a, b;
  PairKind kind = PairKind::peer;
  int packings = 0;
  std::vector<int> differ;  ///< indices of packings

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    io("kind", kind);
    io("packings", packings);
    io("differ", differ);
  }
};

}  // namespace crossgrain::inline results
