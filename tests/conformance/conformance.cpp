#include "tests/conformance/conformance.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "oracle/collision_oracle.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::test {
namespace {

constexpr double timeout = 60.0;  // for one answer [s]

std::filesystem::path scratchRoot() {
  return std::filesystem::temp_directory_path() /
         fmt::format("crossgrain-conformance-{}", ::getpid());
}

/// Engines take a second or two to start, so all tests share one worker of each.
std::map<std::string, std::unique_ptr<Engine>>& sharedWorkers() {
  static std::map<std::string, std::unique_ptr<Engine>> workers;
  return workers;
}

bool sameContacts(const Contacts& a, const Contacts& b) {
  return a.i == b.i && a.j == b.j && a.normal == b.normal && a.overlap == b.overlap &&
         a.normalForce == b.normalForce && a.tangentialForce == b.tangentialForce &&
         a.sliding == b.sliding;
}

bool sameBody(const BodySnapshot& a, const BodySnapshot& b) {
  return a.centre == b.centre && a.angle == b.angle && a.velocity == b.velocity &&
         a.angularVelocity == b.angularVelocity && a.force == b.force && a.torque == b.torque;
}

}  // namespace

std::unique_ptr<Engine> startWorker(const EngineEntry& entry) {
  static int count = 0;
  return startEngine(entry, scratchRoot() / fmt::format("{}-{}", entry.name, ++count), timeout);
}

void endWorkers() {
  sharedWorkers().clear();
  std::error_code ignored;
  std::filesystem::remove_all(scratchRoot(), ignored);
}

ContactLaw followed(const Capabilities& can, ContactLaw law) {
  for (const auto& [name, values] : can.lawOptions)
    if (std::ranges::find(values, lawOptionValue(law, name)) == values.end())
      setLawOption(law, name, values.back());
  return law;
}

testing::AssertionResult sameBits(const Snapshot& a, const Snapshot& b) {
  const auto differ = [](const char* what) {
    return testing::AssertionFailure() << what << " differ";
  };
  if (a.positionTime != b.positionTime || a.velocityTime != b.velocityTime ||
      a.contactTime != b.contactTime || a.contactInterval != b.contactInterval)
    return differ("times");
  if (a.position != b.position) return differ("positions");
  if (a.velocity != b.velocity) return differ("velocities");
  if (a.spin != b.spin) return differ("spins");
  if (a.wallPosition != b.wallPosition) return differ("positions of wall disks");
  if (!std::ranges::equal(a.bodies, b.bodies, sameBody)) return differ("wall bodies");
  if (a.contacts.has_value() != b.contacts.has_value() ||
      (a.contacts && !sameContacts(*a.contacts, *b.contacts)))
    return differ("contacts");
  return testing::AssertionSuccess();
}

void Conformance::SetUp() {
  entry_ = findEngine(GetParam());
  if (entry_->missing)
    if (const std::string why = entry_->missing(); !why.empty()) GTEST_SKIP() << why;
  auto& worker = sharedWorkers()[entry_->name];
  if (!worker) worker = startWorker(*entry_);
  engine_ = worker.get();
  can_ = engine_->capabilities();
}

void Conformance::TearDown() {
  // A worker may have died of it; the next test is to have a sound one.
  if (HasFailure()) sharedWorkers().erase(GetParam());
}

std::optional<std::string> Conformance::refused(const Scene& scene, const Settings& settings) {
  try {
    scene_ = adaptScene(can_, scene, {}).scene;
    realised_ = engine_->load(scene_, settings);
    return std::nullopt;
  } catch (const UnsupportedScene& refusal) {
    return refusal.what();
  }
}

Scene Conformance::simplified(const Scene& scene) const {
  std::vector<std::string> effects;
  for (const Effect effect : allEffects) effects.push_back(toString(effect));
  return adaptScene(can_, scene, effects).scene;
}

ContactReport Conformance::contactReport() const {
  return can_.instantContacts       ? ContactReport::instant
         : can_.accumulatedContacts ? ContactReport::accumulated
                                    : ContactReport::none;
}

Snapshot Conformance::at(double t) {
  engine_->advance(t);
  return engine_->snapshot(contactReport());
}

std::vector<Snapshot> Conformance::watch(double t) {
  std::vector<Snapshot> seen;
  const auto steps = std::llround(t / realised_.dt);
  for (long long step = 0; step <= steps; ++step)
    seen.push_back(at(static_cast<double>(step) * realised_.dt));
  return seen;
}

std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot) {
  return snapshot.spin.value_or(scene.disks.spin);
}

double restitutionOf(const ContactLaw& law, double reducedMass) {
  return closedRestitution(law, reducedMass).value();
}

}  // namespace crossgrain::test
