#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "results/lockstep_findings.hpp"
#include "studies/causes/changes.hpp"

/// Search for the changes of a mirror with which it does what an engine does.
namespace crossgrain::inline studies {

/// By which constants are changed in search of what is off: small, so that no contact is made or
/// broken at another step, and large against rounding.
inline constexpr double termChange = 1e-4;  // of the constant

/// A term is tried with its amount where, to first order, it leaves less than half of the
/// separation ...
inline constexpr double termWorthTrying = 0.5;

/// ... and named where the mirror that has it leaves less than a fifth. A right term leaves terms
/// of second order, which a second trial takes away, and rounding; of several faults at once a
/// fifth is no name.
inline constexpr double termUnexplained = 0.2;

/// Fits alike: worse than the best by less than this part of it.
inline constexpr double fitsAlike = 0.01;

/// A constant is put down as another one from here on: what rounding and what an engine's own way
/// with springs do is less.
inline constexpr double leastConstant = 1e-5;  // of the constant

/// Numbers of an engine less the mirror's, by instant: always the same ones in one order.
using Separations = std::vector<std::vector<double>>;

/// Separations of the engine from the mirror with some changes. Absent where the mirror cannot run
/// like that, or where it is already seen to be further than `limit` at the last instant, by the
/// root of the summed squares.
template <int D>
using SeparationsWith = std::function<std::optional<Separations>(
    const std::vector<AppliedChangeOf<D>>& changes, double limit)>;

/// How much of a separation a change accounts for: for a constant the amount that fits best, in
/// least squares; another convention or a missing effect as it is.
/// @param response  a constant's to a change by termChange of it
template <int D>
NamedTerm asTerm(const MirrorChangeOf<D>& change, const std::vector<double>& separation,
                 const std::vector<double>& response);

/// The term that leaves least, if that is less than termUnexplained.
std::optional<NamedTerm> bestTerm(const std::vector<NamedTerm>& terms);

/// Tries every change, and those constants that explain most to first order with the amount that
/// they would have; where that names none, all constants by amounts of up to the whole of them.
/// @param rounding  what is nearer is not looked at
/// @returns the one that leaves least at one of the instants, in the mirror itself, if that is less
/// than termUnexplained
/// @throws Interrupted
template <int D>
std::optional<NamedTerm> closestTerm(const std::vector<MirrorChangeOf<D>>& changes,
                                     const SeparationsWith<D>& with, double rounding);

/// Changes that ClosestLaw looks for.
enum class ChangeKind {
  convention,  ///< or a missing effect
  /// To first order. Several conventions can be imitated by one, which leaves more than a right
  /// one does.
  constant,
  constantAtLarge,  ///< changed by up to the whole of it
  /// Two conventions at once, where neither alone brings the mirror nearer: arms of f_t and of
  /// v_t are such, which agree with each other in most laws.
  pair
};

/// Begins with the mirror as it is and takes one change after the other, always the one that brings
/// it nearest to the engine: conventions, missing effects and constants. It goes by the last
/// instant. @throws Interrupted, of all that runs
template <int D>
class ClosestLaw {
 public:
  using Changes = std::vector<AppliedChangeOf<D>>;

  /// @param scene     the mirror's, of which changesOf() are made
  /// @param can       of the in-house engine
  /// @param rounding  what is nearer is the same
  ClosestLaw(SceneOf<D> scene, Capabilities can, SeparationsWith<D> with, double rounding);

  /// Goes by what SeparationsWith says from here on.
  void restart();

  /// Root of the summed squares.
  double distance() const { return best_; }
  /// Those taken, all of a constant as one.
  Changes changes() const;
  SceneOf<D> scene() const { return withChanges(scene_, taken_); }
  std::vector<MirrorChangeOf<D>> candidates() const { return changesOf(scene(), can_); }

  /// Distance with further changes, absent where it exceeds `limit` or cannot run like that.
  std::optional<double> distanceWith(const Changes& further, double limit) const;

  /// Takes what of this kind brings the mirror nearest, if it leaves less than that part.
  /// @returns whether anything did
  bool take(ChangeKind kind, double leaving = 1.0 - fitsAlike);

  /// Takes what brings the mirror nearest: a constant where it leaves less than half of what any
  /// convention or missing effect does, which it may imitate. @returns likewise
  bool takeBest();

  /// Undoes every change without which the mirror is at most `times` as far: it was taken while
  /// something else was still amiss.
  void undoNeedless(double times = 1.0 + fitsAlike);

 private:
  Changes withTaken(const Changes& further) const;
  /// Of changes that are all; absent likewise.
  std::optional<double> distanceOf(const Changes& all, double limit) const;
  /// Changes of that kind that leave least, if less than `distance`, which becomes that.
  Changes best(ChangeKind kind, double& distance) const;
  bool take(const Changes& further);

  SceneOf<D> scene_;
  Capabilities can_;
  SeparationsWith<D> with_;
  double rounding_;
  Changes taken_;
  std::vector<double> separation_;
  double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace crossgrain::inline studies
