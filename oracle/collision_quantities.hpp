#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "oracle/collision_end.hpp"

namespace crossgrain::inline oracle {

/// Energy that a contact's two forces took out of the motion, from the first touch to the last [J].
struct ForceWork {
  double normal = 0.0;      ///< −∫ f_n v_n dt
  double tangential = 0.0;  ///< −∫ f_t v_t dt, sticking and sliding together
};

/// A collision's end and, where it was watched, what its forces did.
struct CollisionOutcome {
  CollisionEnd end;
  std::optional<ForceWork> work;
};

/// csvPlace of the first quantity that stands behind all other columns, in files whose laws have
/// it.
constexpr int firstPlaceAtEnd = 17;

/// With the work that the end's own account of the energy implies: a spring's gain over a whole
/// contact is what it stores in the end.
CollisionOutcome outcomeOf(const CollisionEnd& end);

/// The numbers that a collision has, places in collisionQuantities().
enum class QuantityId {
  psiF,
  en,
  beta,
  et,
  centrePsiF,
  reboundAngle,
  spinI,
  spinJ,
  duration,
  maxOverlap,
  energyLost,
  lostNormalDamping,
  lostTangential,
  lostTangentialDamping,
  lostStiffening,
  lostSliding,
  lostStored,
  lostRollingDamping,
  lostRolling,
  lostPlastic,
  lostDetachment,
  psiFOut,
  spinINormal,
  spinITangent,
  spinJNormal,
  spinJTangent,
  centreNormal,
  energyGained,
  energyBefore,
  energyAfter
};

/// One of them: what every table and file of collisions takes its names and columns from.
struct CollisionQuantity {
  enum class Scored { asItIs, byLargest, surfaceSpeedI, surfaceSpeedJ, energyFraction, never };
  enum class InFiles { exact, nineDigits, no };

  QuantityId id;
  std::string_view name;   ///< as in [collision.margins] and results.json
  std::string_view label;  ///< short, as people write it; _ before what is below the line
  std::string_view unit;   ///< of `value`; empty: -
  int csvPlace;            ///< among the further columns of collisions.csv; 0: none of these
  /// Absent where the collision has none. [unit]
  std::optional<double> (*value)(const CollisionOutcome&);
  /// The unit of its errors: itself; itself, always in units of the curve's largest, as it has a
  /// zero of its own; a ω/v_n of disk i or j [-]; it in units of the energy before.
  Scored scored = Scored::asItIs;
  /// Nine digits are what the oracle's and the engines' errors leave of a number, and half the
  /// file. Not: it follows from others.
  InFiles inFiles = InFiles::nineDigits;
  /// Its value in every sound collision, whether an oracle has the outcome or not.
  std::optional<double> always = {};

  /// The same; absent of a pair that has not parted.
  std::optional<double> valueOf(const CollisionOutcome& outcome) const {
    return outcome.end.parted ? value(outcome) : std::nullopt;
  }
  /// As `scored` says; absent where the collision has none.
  /// @param vn  speed of approach [m/s]
  std::optional<double> scoredValue(const CollisionOutcome& outcome, const CollidingPair& pair,
                                    double vn) const;
};

/// All of them, by QuantityId; the two that every sweep has, psi_f and e_n, first.
std::span<const CollisionQuantity> collisionQuantities();

/// Those that a sweep is scored in.
std::span<const CollisionQuantity> scoredQuantities();

const CollisionQuantity& collisionQuantity(QuantityId id);

/// How many there are.
inline constexpr std::size_t quantityCount = static_cast<std::size_t>(QuantityId::energyAfter) + 1;

}  // namespace crossgrain::inline oracle
