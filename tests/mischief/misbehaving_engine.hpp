#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "adapters/engine.hpp"

namespace crossgrain::test {

/// Hands everything on to another engine, and misbehaves from a step on: entries.hpp says how.
class MisbehavingEngine final : public Engine {
 public:
  MisbehavingEngine(std::unique_ptr<Engine> engine, std::string mischief, std::uint64_t step)
      : engine_(std::move(engine)), mischief_(std::move(mischief)), step_(step) {}

  Capabilities capabilities() const override;
  Realised load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override { return engine_->stats(); }

 private:
  std::unique_ptr<Engine> engine_;
  std::string mischief_;
  std::uint64_t step_;
  double dt_ = 0.0;
};

}  // namespace crossgrain::test
