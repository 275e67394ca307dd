#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "adapters/engine.hpp"
#include "stability/transform.hpp"

namespace crossgrain::test {

/// How an engine that is right holds a scene.
struct Disguise {
  Transform transform;                  ///< order is drawn when a scene is loaded
  std::optional<std::uint64_t> order;   ///< seed of the numbers of its disks
  std::optional<std::uint64_t> nudge;   ///< seed of a rounding of the start
  unsigned long long restartEvery = 0;  ///< n: every n-th advance begins in another engine
};

/// The in-house engine, right, that holds the scene otherwise: turned, mirrored, in other units,
/// renumbered, its start rounded once more, taken up again and again. What it answers is told as
/// it was asked. Whoever finds a fault with it gives a false alarm.
class DisguisedEngine final : public Engine {
 public:
  DisguisedEngine(const Disguise& disguise, std::filesystem::path scratch);

  Capabilities capabilities() const override;
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override;

 private:
  void beginAnew();

  Disguise disguise_;
  std::filesystem::path scratch_;
  std::unique_ptr<Engine> engine_;
  Transform by_;
  Scene own_;  ///< as it holds it
  unsigned long long advances_ = 0;
  Stats before_;  ///< of engines that it began in
};

/// A snapshot of the transformed scene, told as one of the scene.
Snapshot transformedBack(Snapshot snapshot, const Transform& by);

}  // namespace crossgrain::test
