#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::test {

/// Hands everything on to another engine, and misbehaves from a step on: entries.hpp says how.
class MisbehavingEngine final : public Engine {
 public:
  MisbehavingEngine(std::unique_ptr<Engine> engine, std::string mischief, std::uint64_t step)
      : engine_(std::move(engine)), mischief_(std::move(mischief)), step_(step) {}

  Capabilities capabilities() const override;
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override;
  void checkpoint(const std::filesystem::path& file) override;
  void restore(const std::filesystem::path& file) override;

 private:
  /// Begins anew from here with that part of the friction; the springs stay or are lost.
  void beginAnew(double friction, bool springs);

  std::unique_ptr<Engine> engine_;
  std::string mischief_;
  std::uint64_t step_;
  double dt_ = 0.0;
  Scene scene_;
  std::uint64_t stepsBehind_ = 0;
  double behind_ = 0.0;         ///< time at which the engine was loaded anew [s]
  std::vector<double> turned_;  ///< what bodies had turned by then [rad]
};

}  // namespace crossgrain::test
