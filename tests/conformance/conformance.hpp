#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "tests/conformance/scenes.hpp"
#include "tests/conformance/tolerance.hpp"

namespace crossgrain::test {

/// Starts another worker of an engine.
std::unique_ptr<Engine> startWorker(const EngineEntry& entry);

/// Ends all workers and removes their scratch directories; call it before the program ends.
void endWorkers();

/// The law with each option that the engine lacks set to one that it has.
ContactLaw followed(const Capabilities& can, ContactLaw law);

/// Whether two snapshots hold the same, bit for bit.
testing::AssertionResult sameBits(const Snapshot& a, const Snapshot& b);

/// What every engine of the registry has to do, through its real worker. The parameter is the
/// engine's name. A test that an engine cannot run is skipped with the reason; expected_skips.cpp
/// lists all of these.
class Conformance : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// The law with the engine's own conventions where it lacks the thesis' ones.
  ContactLaw law() const { return followed(can_, fullLaw()); }

  /// Has the engine load a scene. @returns why it cannot
  [[nodiscard]] std::optional<std::string> refused(const Scene& scene,
                                                   const Settings& settings = {});

  /// The scene without effects that the engine does not have, for tests that need something to
  /// happen and do not care what.
  Scene simplified(const Scene& scene) const;

  /// What snapshots can hold of contacts; none if the engine shows none.
  ContactReport contactReport() const;

  Snapshot at(double t);  ///< advances to t and looks, contacts included

  /// Looks after every step from 0 to t; the first snapshot is the start.
  std::vector<Snapshot> watch(double t);

  Tolerance byPrecision(double ifDouble, double ifFloat, const char* why) const {
    const double allowed = can_.precisions.front() == Precision::float32 ? ifFloat : ifDouble;
    return {allowed, allowed, why};
  }

  /// Rigid disks have no duration of contact, and no oracle of the soft law applies to them.
  bool rigid() const { return law().normal == NormalLaw::rigid; }

  Engine& engine() { return *engine_; }

  const EngineEntry* entry_ = nullptr;
  Engine* engine_ = nullptr;
  Capabilities can_;
  Scene scene_;        ///< what was loaded last
  Realised realised_;  ///< what the engine made of it
};

/// The spins of a snapshot; where it has none, those that the scene started with.
std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot);

/// e_n that the law gives in a head-on collision of this reduced mass [kg].
double restitutionOf(const ContactLaw& law, double reducedMass);

}  // namespace crossgrain::test
