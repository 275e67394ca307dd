#pragma once

#include <string>

#include "adapters/engine.hpp"

namespace crossgrain::test {

/// Free flight, x(t) = x_0 + v t, and a "contact" of disks 0 and 1 whose numbers are functions of
/// the state: an engine with nothing to go wrong in it, but for what `mischief` asks for.
class ToyEngine final : public Engine {
 public:
  explicit ToyEngine(std::string mischief = "") : mischief_(std::move(mischief)) {}

  Capabilities capabilities() const override;
  EffectiveParameters load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override;

 private:
  std::string mischief_;
  Scene scene_;
  std::uint64_t steps_ = 0;
  int loads_ = 0;
};

/// Two disks, two wall bodies, one of them with a plane, numbers that no decimal prints shortly.
Scene toyScene();

/// Runs the worker of `worker_tests --worker MISCHIEF` instead of tests.
int toyWorker(const std::string& mischief);

}  // namespace crossgrain::test
