#pragma once

#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/fits.hpp"
#include "averaging/rings.hpp"

namespace crossgrain::inline averaging {

/// Mean spin ⟨Σ V ω⟩/⟨Σ V⟩ in rings three to a disk diameter, which is what it takes to see
/// the oscillation from layer to layer (fitSpinOscillation). Disks count where their centres are:
/// slicing would smear a period of 2d over each disk's own d.
class LayerSpin {
 public:
  /// @param cell  its walls and d are taken, its rings are not
  LayerSpin(const Rings& cell, const Scene& scene);

  /// A snapshot without spins adds nothing.
  void add(const Snapshot& snapshot);

  /// (r̃, scale · S) of the rings that held disks; no errors, so that a fit weighs them alike.
  std::vector<FitPoint> points(double scale) const;

 private:
  Rings rings_;
  std::vector<double> radius_;
  std::vector<double> area_, spin_;  ///< Σ a² and Σ a² ω per slot
};

}  // namespace crossgrain::inline averaging
