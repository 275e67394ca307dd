#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "averaging/moments.hpp"
#include "averaging/rings.hpp"
#include "cases/case.hpp"
#include "results/thesis.hpp"
#include "studies/flow/run.hpp"

namespace crossgrain::inline studies {

/// What a cell did rotation by rotation, from the hand-over to the end of the averaged time. Only
/// sums are kept: memory does not grow with the number of snapshots.
///
/// Spans are a rotation long. They begin anew with the averaged time, so that none has snapshots of
/// two densities; the last one before may therefore be shorter.
class ThesisHistory {
 public:
  /// Both outlive it. @param scene  see CouetteAverages
  /// @param settlingSnapshots  of all the time that is not averaged
  ThesisHistory(const Case& setup, const Scene& scene, int settlingSnapshots);

  /// A snapshot stands for the interval before it: the one at a rotation's end belongs to it.
  void add(const Snapshot& snapshot);

  /// Spans that have any snapshot.
  std::vector<ThesisSpan> spans() const;

  /// All that add() has left here, and back again to the bit.
  nlohmann::json state() const;
  void restore(const nlohmann::json& state);

 private:
  struct Sums {
    double from = 0.0, to = 0.0;                          ///< [rotations]
    std::array<double, std::size(spanNumbers)> sum = {};  ///< of maxOverlap the largest
    std::array<std::size_t, std::size(spanNumbers)> count = {};

    void fields(auto& io) {
      io("from", from);
      io("to", to);
      io("sum", sum);
      io("count", count);
    }
  };

  /// What one snapshot shows.
  ThesisSpan momentary(const Snapshot& snapshot);

  const Case& setup_;
  const Scene& scene_;
  Rings rings_;
  MomentSums sums_;
  std::vector<std::vector<Moments>> moments_;
  double half_;  ///< half the least time between two snapshots [rotations]
  std::vector<Sums> spans_;
};

/// One engine on one packing of a case, from the closing of the ring on: the case's name is the
/// caller's to add. No picture is kept.
/// @param finerRings  averaged over beside the case's own, each with all methods of the case
/// @param settlingSnapshots  per rotation that is not averaged
/// @param progress  called with the fraction done, 0 … 1
/// @throws as runFlow()
ThesisRun runCase(const FlowTask& task, const std::vector<int>& finerRings, int settlingSnapshots,
                  const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies
