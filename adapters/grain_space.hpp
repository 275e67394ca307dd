#pragma once

#include "adapters/engine.hpp"
#include "engines/grain/spheres.hpp"

namespace crossgrain {

/// A scene in space on the in-house engine.
class GrainSpheres {
 public:
  /// @param scene  as it is run, with the engine's own conventions
  /// @param skin, maxOverlap  the engine's settings
  /// @throws UnsupportedScene naming the first thing that it does not have in space
  GrainSpheres(const SpaceScene& scene, double skin, double maxOverlap);

  EffectiveParameters effective() const;
  SpaceSnapshot snapshot(ContactReport report) const;

  grain::Spheres& simulation() { return simulation_; }
  const grain::Spheres& simulation() const { return simulation_; }

 private:
  SpaceScene scene_;
  grain::Spheres simulation_;
};

}  // namespace crossgrain
