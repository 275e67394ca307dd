#pragma once

#include <functional>
#include <memory>

#include "adapters/grain.hpp"

namespace crossgrain::test {

/// The in-house engine on another scene than it is given: right but for what is planted.
class PlantedEngine : public Engine {
 public:
  explicit PlantedEngine(std::function<void(Scene&)> fault)
      : fault_(std::move(fault)), own_(makeGrain()) {}
  Capabilities capabilities() const override { return own_->capabilities(); }
  Realised load(const Scene& scene, const Settings& settings) override {
    Scene other = scene;
    fault_(other);
    return own_->load(other, settings);
  }
  double advance(double t) override { return own_->advance(t); }
  Snapshot snapshot(ContactReport contacts) override { return own_->snapshot(contacts); }
  Stats stats() const override { return own_->stats(); }

 private:
  std::function<void(Scene&)> fault_;
  std::unique_ptr<Engine> own_;
};

}  // namespace crossgrain::test
