#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <numbers>
#include <string>

#include "adapters/registry.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/scenes.hpp"

namespace crossgrain::test {

inline Scene emptyScene() {
  Scene scene;
  scene.name = "yade test";
  scene.law = thesisLaw();
  scene.dt = 4e-5;
  return scene;
}

inline WallBody ringBody(const std::string& name, Vec2 centre, double radius, int count,
                         Motion motion) {
  WallBody body;
  body.name = name;
  body.centre = centre;
  body.motion = motion;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    body.diskPosition.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    body.diskRadius.push_back(wallRadius);
  }
  return body;
}

/// Disks pressed together by gravity onto a turning wheel and a floor that shakes.
inline Scene crowdedScene(const ContactLaw& law = emptyScene().law) {
  Scene scene = emptyScene();
  scene.law = law;
  scene.gravity = {-1.0, -9.81};
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 5; ++column) {
      const bool big = (row + column) % 3 == 0;
      addDisk(scene, big ? largeRadius : smallRadius, big ? largeMass : smallMass,
              {8.3e-3 * column + 2e-3 * row, 0.0165 + 8.1e-3 * row},
              {0.02 * row, 0.03 - 0.01 * column}, 5.0 - column);
    }
  scene.bodies.push_back(ringBody("wheel", {0.017, 0.001}, 0.01, 24, rotating(2.0)));
  WallBody floor;
  floor.name = "floor";
  floor.planes = {{{0.0, 0.005}, {0.0, 1.0}}, {{-0.006, 0.0}, {1.0, 0.0}}};
  floor.motion.kind = Motion::Kind::oscillating;
  floor.motion.amplitude = {1e-4, 2e-4};
  floor.motion.frequency = 300.0;
  scene.bodies.push_back(floor);
  return scene;
}

class YadeWorker : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (findEngine("yade")->missing().empty()) engine_ = startYade("yade");
  }
  static void TearDownTestSuite() {
    engine_.reset();
    std::filesystem::remove_all(scratch());
  }
  void SetUp() override {
    if (!engine_) GTEST_SKIP() << findEngine("yade")->missing();
  }

  /// Of this process alone: others may run at the same time.
  static std::filesystem::path scratch() {
    return std::filesystem::path(::testing::TempDir()) /
           ("crossgrain-yade-" + std::to_string(getpid()));
  }
  static std::unique_ptr<WorkerEngine> startYade(const std::string& name) {
    return std::make_unique<WorkerEngine>(name, findEngine("yade")->command(), scratch() / name,
                                          120.0);
  }

  static inline std::unique_ptr<WorkerEngine> engine_;
};

/// Why the scene is refused, or "ran".
inline std::string refusalOf(Engine& engine, const Scene& scene) {
  try {
    engine.load(scene, {});
  } catch (const UnsupportedScene& error) {
    return error.what();
  }
  return "ran";
}

/// Newton's second law ties velocities, which YADE integrates, to the contacts that the worker
/// reads.
void expectForcesThatMoveTheDisks(Engine& engine, const Scene& scene);

}  // namespace crossgrain::test
