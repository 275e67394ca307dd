// A worker that misbehaves on purpose: entries.hpp says how.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/grain.hpp"
#include "adapters/worker/serve.hpp"

namespace crossgrain::test {
namespace {

void sayGarbage() {
  constexpr char text[] = "%!PS-Adobe-3.0\n";
  if (::write(4, text, sizeof text - 1) < 0) std::abort();
}

void speedUp(Snapshot& snapshot, double factor) {
  for (Vec2& velocity : snapshot.velocity) velocity *= factor;
  if (snapshot.spin)
    for (double& spin : *snapshot.spin) spin *= factor;
  if (snapshot.energies) snapshot.energies->kinetic *= factor * factor;
  if (snapshot.ledger) snapshot.ledger->kinetic *= factor * factor;
}

/// The scene with the law that the engine has in place of it.
Scene otherwise(const std::string& mischief, Scene scene) {
  const Disks& disks = scene.disks;
  if (mischief == "hertz-radius" && scene.law.normal == NormalLaw::hertz) {
    const double first = disks.radius.front();
    const double reduced = scene.planeCount() > 0 ? first
                           : scene.wallDiskCount() > 0
                               ? 0.5 * first
                               : first * disks.radius[1] / (first + disks.radius[1]);
    for (double* const constant : {&scene.law.kn, &scene.law.kt}) *constant /= std::sqrt(reduced);
  }
  if (scene.law.soft()) return scene;
  const auto [least, most] = std::ranges::minmax(disks.radius);
  if ((mischief == "impulse-planes" && scene.planeCount() > 0) ||
      (mischief == "impulse-sizes" && least != most))
    scene.law.en *= 0.8;
  return scene;
}

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
  std::vector<double> turned_;  ///< rotation of the bodies by then [rad]
};

Capabilities MisbehavingEngine::capabilities() const {
  Capabilities can = engine_->capabilities();
  can.checkpoints =
      mischief_ == "no-checkpoints" || mischief_ == "forgetful" || mischief_ == "checkpoints";
  return can;
}

EffectiveParameters MisbehavingEngine::load(const Scene& scene, const Settings& settings) {
  EffectiveParameters effective = engine_->load(otherwise(mischief_, scene), settings);
  scene_ = scene;
  dt_ = effective.dt;
  behind_ = 0.0;
  stepsBehind_ = 0;
  turned_.clear();
  return effective;
}

void MisbehavingEngine::checkpoint(const std::filesystem::path& file) {
  if (mischief_ == "no-checkpoints") Engine::checkpoint(file);
  engine_->checkpoint(file);
}

void MisbehavingEngine::restore(const std::filesystem::path& file) {
  engine_->restore(file);
  if (mischief_ == "forgetful") beginAnew(1.0, false);
}

void MisbehavingEngine::beginAnew(double friction, bool springs) {
  const Snapshot now = engine_->snapshot(springs ? ContactReport::instant : ContactReport::none);
  Scene scene = scene_;
  scene.law.mu *= friction;
  scene.disks.position = now.position;
  scene.disks.velocity = now.velocity;
  if (now.spin) scene.disks.spin = *now.spin;
  auto wall = now.wallPosition.begin();
  for (WallBody& body : scene.bodies)
    for (Vec2& place : body.diskPosition) place = *wall++;
  stepsBehind_ = engine_->stats().steps;
  engine_->load(scene, {});
  if (springs) beginUnderWay(*engine_, *now.contacts);
  behind_ = now.positionTime;
  turned_.clear();
  for (const BodySnapshot& body : now.bodies) turned_.push_back(body.angle);
}

double MisbehavingEngine::advance(double t) {
  const double until = static_cast<double>(step_) * dt_;
  if (mischief_ == "slippery" || mischief_ == "worn") {
    if (t < until || behind_ > 0.0) return engine_->advance(t - behind_) + behind_;
    engine_->advance(until);
    const bool worn = mischief_ == "worn";
    beginAnew(worn ? 0.7 : 0.02, worn);  // not zero: disks go on to have spins
    return engine_->advance(t - behind_) + behind_;
  }
  if (step_ == 0) return engine_->advance(t - behind_) + behind_;
  if (t < until || mischief_ == "pump" || mischief_ == "nan" || mischief_ == "short")
    return engine_->advance(t);
  engine_->advance(until);
  std::fprintf(stderr, "step %llu\n", static_cast<unsigned long long>(step_));
  if (mischief_ == "exit") std::exit(3);
  if (mischief_ == "crash") std::abort();
  if (mischief_ == "hang")
    for (;;) ::pause();
  if (mischief_ == "garbage") sayGarbage();
  return engine_->advance(t);
}

Stats MisbehavingEngine::stats() const {
  Stats stats = engine_->stats();
  stats.steps += stepsBehind_;
  return stats;
}

Snapshot MisbehavingEngine::snapshot(ContactReport contacts) {
  Snapshot snapshot = engine_->snapshot(contacts);
  for (double* const time : {&snapshot.positionTime, &snapshot.velocityTime, &snapshot.contactTime})
    *time += behind_;
  for (std::size_t k = 0; k < turned_.size(); ++k) snapshot.bodies[k].angle += turned_[k];
  const std::uint64_t steps = engine_->stats().steps;
  if (steps < step_ || step_ == 0) return snapshot;
  if (mischief_ == "nan") snapshot.position.front().x() = std::numeric_limits<double>::quiet_NaN();
  if (mischief_ == "short") snapshot.position.pop_back();
  if (mischief_ == "pump") speedUp(snapshot, 1.0 + 0.01 * static_cast<double>(steps - step_));
  return snapshot;
}

}  // namespace
}  // namespace crossgrain::test

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs(
        "usage: misbehaving_engine MISCHIEF STEP, as a worker: tests/misbehaving/entries.hpp\n",
        stderr);
    return 2;
  }
  crossgrain::test::MisbehavingEngine engine(crossgrain::makeGrain(), argv[1],
                                             std::stoull(argv[2]));
  return crossgrain::serve(engine);
}
