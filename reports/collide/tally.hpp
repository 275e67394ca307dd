#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/collide/table.hpp"

/// Counting how an engine came through some variants.
namespace crossgrain::reports {

/// What is furthest beyond its limit.
struct Worst {
  double times = 0.0;       ///< error/limit
  std::string_view symbol;  ///< the quantity's

  void look(const CurveScore& score);
  std::string words() const;  ///< "Ψ_f 3.1 × its limit"
};

/// How an engine did in some variants.
struct Tally {
  int held = 0, model = 0, fellShort = 0, refused = 0, failed = 0;
  Worst worst, worstOfModel;
  std::string refusal, reason;         ///< the first
  std::optional<double> ownDeviation;  ///< the largest
  bool ownHeld = true;

  int judged() const { return held + model + fellShort; }
  std::string cssClass() const;
};

Tally tallyOf(const std::vector<const CollisionVariant*>& variants, const std::string& engine);

/// "✓ 24 of 24", "✗ 1, ≠ 3, ✓ 20 of 24", "– refused".
std::string headline(const Tally& tally);

/// What a reader wants to know of sweeps that did not hold, and of the own scheme where it did not.
std::vector<std::string> shortfalls(const Tally& tally);

/// An error, to two digits.
std::string shortly(std::optional<double> value);

}  // namespace crossgrain::reports
