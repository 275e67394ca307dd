#pragma once

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "results/flow_numbers.hpp"

namespace crossgrain::inline studies {

/// Adds the numbers that any scene has: the snapshot's time, kinetic energy, what contacts show and
/// the engine's ledger, where it keeps one.
void addGlobalNumbers(RunSeries& rows, const Scene& scene, const Snapshot& now);

/// Collects numbers of the whole cell over time.
class CouetteSeries {
 public:
  /// Both outlive it. The scene has the Couette cell's two bodies.
  CouetteSeries(const Case& setup, const Scene& scene) : setup_(setup), scene_(scene) {}

  void add(const Snapshot& now);

  const RunSeries& rows() const { return rows_; }

 private:
  const Case& setup_;
  const Scene& scene_;
  RunSeries rows_;
};

}  // namespace crossgrain::inline studies
