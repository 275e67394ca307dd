#pragma once

#include "adapters/engine.hpp"
#include "engines/grain/spheres.hpp"

namespace crossgrain {

/// A scene of the plane as one in space, at z = 0: its law has no twist there, and every equation
/// is the plane's.
/// @throws UnsupportedScene of a scene with a bottom plate
SpaceScene inSpace(const Scene& scene);
ContactsOf<3> inSpace(const Contacts& contacts);
/// Snapshot of such a scene as one of the plane.
Snapshot inPlane(const SpaceSnapshot& snapshot);

/// A scene in space on the in-house engine.
class GrainSpheres {
 public:
  /// @param scene  as it is run, with the engine's own conventions
  /// @param skin, maxOverlap, threads  the engine's settings
  /// @throws UnsupportedScene naming the first thing that it does not have in space
  GrainSpheres(const SpaceScene& scene, double skin, double maxOverlap, int threads);

  EffectiveParameters effective() const;
  SpaceSnapshot snapshot(ContactReport report);
  /// As beginUnderWay() of adapters/grain.hpp.
  void beginUnderWay(const ContactsOf<3>& contacts);

  grain::Spheres& simulation() { return simulation_; }
  const grain::Spheres& simulation() const { return simulation_; }

 private:
  SpaceScene scene_;
  grain::Spheres simulation_;
};

}  // namespace crossgrain
