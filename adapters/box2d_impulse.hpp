#pragma once

#include <map>
#include <optional>
#include <utility>

#include "adapters/box2d_common.hpp"
#include "adapters/stopwatch.hpp"
#include "engines/box2d/impulse_world.hpp"

namespace crossgrain {

/// Box2D's own solver for rigid disks, extended by tangential restitution (see
/// engines/box2d/impulse_world.hpp). A soft law is run as the rigid one that restores as much, pair
/// by pair: that is a deviation.
///
/// Forces are impulses divided by the time in which they acted: the last step for instant
/// contacts, and the time since the last accumulated snapshot for accumulated ones. Before the
/// first step there are none, so contacts and wall forces are absent.
class Box2dImpulse : public Engine {
 public:
  Capabilities capabilities() const override;
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport report) override;
  Stats stats() const override;

 private:
  /// What disk i and disk or wall j use.
  box2d_granular::Restitution restitution(std::int32_t i, std::int32_t j);
  box2d_granular::Restitution restitutionOf(const box2d_granular::PairInertia& pair);

  Disks disks_;
  ContactLaw law_;
  /// Restitutions of a soft law, by what the contact feels of the two.
  std::map<std::pair<double, double>, box2d_granular::Restitution> known_;
  std::optional<box2d_granular::ImpulseWorld> world_;
  bool rotation_ = false;
  bool spins_ = false;  ///< whether any force asks for them
  Stopwatch stopwatch_;
};

}  // namespace crossgrain
