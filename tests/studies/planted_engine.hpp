#pragma once

#include <functional>
#include <memory>

#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"

namespace crossgrain::test {

/// The in-house engine in this process.
inline const EngineEntry inHouse{"grain", "", makeGrain, {}, {}, ""};

/// The in-house engine on another scene than it is given: right but for what is planted.
class PlantedEngine : public Engine {
 public:
  /// @param shown  what is planted in what it shows
  /// @param own  the engine that is right
  explicit PlantedEngine(
      std::function<void(Scene&)> fault, std::function<void(Snapshot&)> shown = [](Snapshot&) {},
      std::shared_ptr<Engine> own = makeGrain())
      : fault_(std::move(fault)), shown_(std::move(shown)), own_(std::move(own)) {}
  Capabilities capabilities() const override { return own_->capabilities(); }
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    Scene other = scene;
    fault_(other);
    return own_->load(other, settings);
  }
  double advance(double t) override { return own_->advance(t); }
  Snapshot snapshot(ContactReport contacts) override {
    Snapshot snapshot = own_->snapshot(contacts);
    shown_(snapshot);
    return snapshot;
  }
  Stats stats() const override { return own_->stats(); }

 private:
  std::function<void(Scene&)> fault_;
  std::function<void(Snapshot&)> shown_;
  std::shared_ptr<Engine> own_;
};

}  // namespace crossgrain::test
