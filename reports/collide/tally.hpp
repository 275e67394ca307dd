#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/collide/table.hpp"

/// Counting the sweeps of an engine in some variants.
namespace crossgrain::reports {

/// The quantity furthest beyond its limit.
struct Worst {
  double times = 0.0;       ///< error/limit
  std::string_view symbol;  ///< the quantity's

  void look(const CurveScore& score);
  std::string words() const;  ///< "Ψ_f 3.1 × its limit"
};

/// Sweeps of an engine in some variants, by outcome.
struct Tally : SweepCount {
  Worst worst, worstOfModel;
  std::string refusal, reason;         ///< the first
  std::optional<double> ownDeviation;  ///< the largest
  bool ownPassed = true;
};

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine);

/// Of sweeps that did not pass: the worst quantities, and the own scheme.
std::vector<std::string> shortfalls(const Tally& tally);

}  // namespace crossgrain::reports
