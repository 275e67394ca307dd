#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "oracle/collision_quantities.hpp"
#include "results/causes.hpp"
#include "results/schema.hpp"

/// Outcomes of collisions as tables, and how far they are from the oracle's.
namespace crossgrain::inline results {

/// Something of every quantity that a collision may have.
template <typename T>
class PerQuantity {
 public:
  std::optional<T>& operator[](QuantityId id) { return of_[static_cast<std::size_t>(id)]; }
  const std::optional<T>& operator[](QuantityId id) const {
    return of_[static_cast<std::size_t>(id)];
  }
  void fields(auto& io) {
    for (const CollisionQuantity& quantity : collisionQuantities())
      io.present(quantity.name.data(), (*this)[quantity.id]);
  }

 private:
  std::array<std::optional<T>, quantityCount> of_;
};

/// Collisions, one per row, in the units of CollisionQuantity.
struct CollisionTable {
  std::vector<double> psi;  ///< Ψ_i
  std::vector<double> vn;   ///< speed of approach [m/s]
  /// Of convex bodies, else empty: CollisionStart's [degrees, rad/s].
  std::vector<double> orientation, spin;
  PerQuantity<std::vector<std::optional<double>>> columns;  ///< absent: known of no row
  std::vector<bool> noLimit;  ///< of the oracle: no limit of small time steps; empty: nowhere

  std::size_t size() const { return psi.size(); }
  /// Absent where it is not known of that row.
  std::optional<double> at(QuantityId id, std::size_t row) const {
    const auto& column = columns[id];
    if (!column || row >= column->size()) return std::nullopt;
    const std::optional<double>& value = (*column)[row];
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  void fields(auto& io) {
    presentUnlessEmpty(io, "psi_i", psi);
    presentUnlessEmpty(io, "v_n", vn);
    presentUnlessEmpty(io, "orientation", orientation);
    presentUnlessEmpty(io, "spin_before", spin);
    columns.fields(io);
    presentUnlessEmpty(io, "limitless", noLimit);
  }

 protected:
  static void presentUnlessEmpty(auto& io, const char* key, auto& list) {
    auto there = list.empty() ? std::nullopt : std::optional(list);
    io.present(key, there);
    if (there) list = std::move(*there);
  }
};

/// Result of an engine in a sweep.
struct CollisionPoints : CollisionTable {
  std::vector<std::string> reason;  ///< why there is no reference to judge by; else empty
  std::vector<bool> sticks;         ///< which pairs do not part by the oracle; empty: none

  /// Whether there is a reference to judge a row by.
  bool isKnown(std::size_t row) const { return row >= reason.size() || reason[row].empty(); }
  bool parted(std::size_t row) const { return at(QuantityId::psiF, row).has_value(); }
  bool shouldPart(std::size_t row) const { return row >= sticks.size() || !sticks[row]; }
  /// Half of them, which scores ask for.
  bool mostAreKnown() const {
    std::size_t known = 0;
    for (std::size_t row = 0; row < size(); ++row) known += isKnown(row);
    return known > 0 && 2 * known >= size();
  }
  /// As files have it: a pair that parted may have no limit to be compared with.
  std::string status(std::size_t row) const {
    if (!parted(row)) return "not parted";
    if (isKnown(row)) return "parted";
    return orientation.empty() ? "no limit" : "not judged";
  }

  void fields(auto& io) {
    CollisionTable::fields(io);
    std::vector<std::string> words;
    for (std::size_t row = 0; row < size(); ++row) words.push_back(status(row));
    presentUnlessEmpty(io, "status", words);
    presentUnlessEmpty(io, "reason", reason);
    presentUnlessEmpty(io, "sticks", sticks);
  }
};

/// Unit of a quantity's errors.
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
  std::optional<double> limit;  ///< of max; absent: the case has none
  /// Within the limit; absent without one, and where it is beyond it by no more than rounding is or
  /// the time step makes of anybody.
  std::optional<bool> held;
  std::optional<std::string> why;  ///< of the limit

  void fields(auto& io) {
    FIELDS(io, max, rms, unit, unitIs, limit, held);
    io.present("why", why);
  }
};

/// Names in files of the verdict on a curve.
inline constexpr support::EnumNames<Verdict, 3> curveVerdictNames{
    {{Verdict::notMeasured, "not judged"}, {Verdict::pass, "held"}, {Verdict::fail, "fell short"}}};

/// A curve against the oracle.
struct CurveScore {
  Verdict verdict = Verdict::notMeasured;
  PerQuantity<QuantityScore> of;  ///< those that engine and oracle both have
  /// How far rounding of places alone can take outcomes, by the speed of approach [-]; absent where
  /// no margin is as small, as in double precision.
  std::optional<double> rounding;

  /// Whether what is beyond a limit is not judged, as rounding can take it there.
  bool isRounded() const { return verdict == Verdict::notMeasured && rounding.has_value(); }

  /// The errors of Ψ_f, and e_n's in its own unit, stand there twice: so they are found at once.
  void fields(auto& io) {
    of.fields(io);
    io("verdict", verdict, curveVerdictNames);
    std::optional<double> max, rms, limit, enError;
    if (const auto& psi = of[QuantityId::psiF]) {
      max = psi->max;
      rms = psi->rms;
      limit = psi->limit;
    }
    if (const auto& en = of[QuantityId::en]) enError = en->max * en->unit;
    io("max_error", max);
    io("rms_error", rms);
    io("limit", limit);
    io("e_n_error", enError);
    io.present("rounding", rounding);
  }
};

/// The value of a law's option, or a constant of it.
using LawValue = std::variant<std::string, double>;
/// Options and constants of a law by their names.
using LawDescription = std::map<std::string, LawValue>;

/// Evidence of the law that an engine declares.
enum class DeclaredReference {
  none,
  oracle,
  /// The in-house engine with that law at that time step: the law has no limit of small steps, or
  /// what the curve is short of the oracle by is due to conventions of time stepping and the step
  mirror,
  itself  ///< it has no limit of small steps, and the curve is the in-house engine's own: the law
};
constexpr auto namesOf(DeclaredReference) {
  return std::array<std::string_view, 4>{"none", "oracle", "mirror", "itself"};
}

/// A curve against the law that its engine declares: the scene's, with the conventions that the
/// engine has in place of those it lacks.
struct DeclaredScore {
  LawDescription law;  ///< in what it is another law than the scene's
  DeclaredReference reference = DeclaredReference::none;
  CurveScore score;
  std::string oracleReason;  ///< why there is no oracle of it, or not everywhere

  void fields(auto& io) { FIELDS(io, law, reference, score, oracleReason); }
};

/// Causes of what a curve differs by from the in-house engine's under the scene's law.
struct CollisionCauses : Causes {
  PerQuantity<QuantityCauses> of;  ///< those that the sweep is scored in

  void fields(auto& io) {
    Causes::fields(io);
    io("quantities", of);
  }
};

/// A head-on impact, step by step, against the discrete oracle of the engine's own scheme: what
/// deviates by more than rounding is no truncation.
struct SchemeScore {
  std::string scheme;  ///< EffectiveParameters::integrator
  /// Largest of all steps, of positions by the smaller diameter and velocities by the approach's;
  /// absent where there is no discrete oracle.
  std::optional<double> position, velocity;
  std::optional<double> limit;  ///< of both; absent: not judged
  std::optional<bool> held;
  std::string reason;  ///< why there is none, or it was not judged

  void fields(auto& io) { FIELDS(io, scheme, position, velocity, limit, held, reason); }
};

/// An order of convergence p, error ∝ dt^p.
struct FittedOrder {
  double order = 0.0;
  std::optional<double> standardError;  ///< from three time steps on

  void fields(auto& io) {
    io("order", order);
    io("stderr", standardError);
  }
};

/// Of one engine in one variant.
struct ConvergenceOrder {
  std::string engine, name, variant;      ///< name: the case's
  std::map<std::string, double> errorAt;  ///< rms error of Ψ_f by time step in s
  PerQuantity<FittedOrder> of;

  /// Ψ_f's stands there twice, so that it is found at once.
  void fields(auto& io) {
    io("engine", engine, aName);
    io("case", name, aName);
    FIELDS(io, variant, errorAt);
    io("quantities", of);
    std::optional<double> ofPsi, error;
    if (const auto& psi = of[QuantityId::psiF]) {
      ofPsi = psi->order;
      error = psi->standardError;
    }
    io("order", ofPsi);
    io("stderr", error);
  }
};

}  // namespace crossgrain::inline results
