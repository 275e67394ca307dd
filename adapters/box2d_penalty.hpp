#pragma once

#include <optional>

#include "adapters/box2d_common.hpp"
#include "adapters/stopwatch.hpp"
#include "engines/box2d/penalty_world.hpp"

namespace crossgrain {

/// The scene's soft law on Box2D's broad phase and contact life (see
/// engines/box2d/penalty_world.hpp for what remains Box2D's). Positions, velocities, spins and
/// contacts of a snapshot all belong to the same time.
class Box2dPenalty : public Engine {
 public:
  Capabilities capabilities() const override;
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport report) override;
  Stats stats() const override;

 private:
  Contacts contacts() const;

  std::optional<box2d_granular::PenaltyWorld> world_;
  bool spins_ = false;  ///< whether any force asks for them
  Stopwatch stopwatch_;
};

}  // namespace crossgrain
