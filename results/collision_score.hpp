#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "results/collision_table.hpp"

namespace crossgrain::inline results {

/// What a quantity's errors are in units of.
enum class ErrorUnitKind {
  range,      ///< of the oracle's curve
  magnitude,  ///< its largest
  absolute,   ///< 1 of the quantity's own unit
  energyBefore
};
constexpr auto namesOf(ErrorUnitKind) {
  return std::array<std::string_view, 4>{"range", "magnitude", "absolute", "energy_before"};
}

/// Errors of one quantity over a whole curve.
struct QuantityScore {
  double max = 0.0, rms = 0.0;  ///< in units of `unit`
  double unit = 1.0;            ///< in the quantity's own unit
  ErrorUnitKind unitIs = ErrorUnitKind::range;
  std::optional<double> limit;     ///< of max; absent: the case has none
  std::optional<bool> held;        ///< within the limit; absent without one
  std::optional<std::string> why;  ///< of the limit
};

enum class CurveVerdict { notJudged, held, fellShort };
constexpr auto namesOf(CurveVerdict) {
  return std::array<std::string_view, 3>{"not judged", "held", "fell short"};
}

/// A curve against the oracle.
struct CurveScore {
  CurveVerdict verdict = CurveVerdict::notJudged;
  PerQuantity<QuantityScore> of;  ///< those that engine and oracle both have
};

/// An order of convergence p, error ∝ dt^p.
struct FittedOrder {
  double order = 0.0;
  std::optional<double> standardError;  ///< from three time steps on
};

/// Of one engine in one variant.
struct ConvergenceOrder {
  std::string engine, name, variant;      ///< name: the case's
  std::map<std::string, double> errorAt;  ///< rms error of Ψ_f by time step in s
  PerQuantity<FittedOrder> of;
};

}  // namespace crossgrain::inline results
