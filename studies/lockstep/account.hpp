#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "results/lockstep_findings.hpp"
#include "studies/lockstep/responses.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {

/// The verdict and what it rests on, from readings and what else a row has: track, kinds, starts,
/// precise.
/// @param moved  whether the reference constant moves anything from any start
/// @param alone  of the starts beyond the rule, how many are seen to part first at two disks that
///               touch nothing else, or at one that touches nothing
void judge(LockstepRow& row, bool moved, std::size_t alone);

/// Whether so many of the starts read are shown to be a larger share than chance may part.
bool exceedsStrayShare(std::size_t count, std::size_t read);

/// Adds up what windows show of an engine and of what it is compared with, start by start.
class SeparationAccount {
 public:
  /// @param times  of the frames of every window, since the start [s]
  /// @param reported  frames whose separations are reported one by one
  SeparationAccount(double diameter, std::vector<double> times, std::vector<std::size_t> reported);

  /// @param start     its index
  /// @param wallFrom  ids from here on are the walls'
  /// @param limits    what the declared precision explains, by frame [d]: precisionLimits()
  template <int D>
  void add(std::size_t start, const LockstepWindowOf<D>& window, const Responses& responses,
           std::size_t wallFrom, const std::vector<double>& limits = {});

  /// The verdict and what it rests on; neither the engine's name nor the term that is off.
  LockstepRow row() const;

 private:
  LockstepSeparation separationAt(std::size_t which) const;
  /// Whether the declared precision explains how far it is then.
  bool explained(std::size_t start, std::size_t which) const;
  std::optional<double> equivalentAt(std::size_t start, std::size_t which) const;
  StartReading readingOf(std::size_t start) const;
  std::optional<double> resolution() const;

  double diameter_;
  std::vector<double> times_;
  std::vector<std::size_t> reported_;
  std::vector<std::vector<double>> tracks_;  ///< by start and frame [d]
  /// By start: whether it is seen to part first at two disks that touch nothing else, or at one
  /// that touches nothing.
  std::vector<bool> alone_;
  /// By start, time reported and disk [d].
  std::vector<std::vector<std::vector<double>>> apart_;
  std::vector<Responses> responses_;         ///< by start
  std::vector<std::vector<double>> limits_;  ///< by start and frame [d]; none of double precision
  LockstepRow row_;
};

}  // namespace crossgrain::inline studies
