#pragma once

#include <functional>
#include <memory>

#include "adapters/grain.hpp"

namespace crossgrain::test {

/// The in-house engine on another scene than it is given: right but for what is planted.
class PlantedEngine : public Engine {
 public:
  /// @param shown  what is planted in what it shows
  explicit PlantedEngine(
      std::function<void(Scene&)> fault, std::function<void(Snapshot&)> shown = [](Snapshot&) {})
      : fault_(std::move(fault)), shown_(std::move(shown)), own_(makeGrain()) {}
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
  std::unique_ptr<Engine> own_;
};

}  // namespace crossgrain::test
