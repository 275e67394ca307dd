#include "runs/conformance/exam.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain::conformance {
namespace {

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

ContactLaw followed(const Capabilities& can, ContactLaw law) {
  for (const auto& [name, values] : can.lawOptions)
    if (std::ranges::find(values, lawOptionValue(law, name)) == values.end())
      setLawOption(law, name, values.back());
  if (!can.tangentialRestitution) law.et0 = 0.0;
  return law;
}

Comparison sameBits(const Snapshot& a, const Snapshot& b) {
  const auto differ = [](const char* what) {
    return Comparison{fmt::format("{} are not the same bits", what)};
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
  return {};
}

std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot) {
  return snapshot.spin.value_or(scene.disks.spin);
}

double restitutionOf(const ContactLaw& law, double reducedMass) {
  return closedRestitution(law, reducedMass).value();
}

ContactLaw Exam::law() const {
  return followed(can, fullLaw());
}

Scene Exam::simplified(const Scene& whole) const {
  std::vector<std::string> effects;
  for (const Effect effect : allEffects) effects.push_back(toString(effect));
  effects.emplace_back(tangentialRestitutionName);
  return adaptScene(can, whole, effects).scene;
}

ContactReport Exam::contactReport() const {
  return can.instantContacts       ? ContactReport::instant
         : can.accumulatedContacts ? ContactReport::accumulated
                                   : ContactReport::none;
}

Tolerance Exam::byPrecision(double ifDouble, double ifFloat, const char* why) const {
  const bool single = !can.precisions.empty() && can.precisions.front() == Precision::float32;
  const double allowed = single ? ifFloat : ifDouble;
  return {allowed, allowed, why};
}

std::optional<std::string> Exam::refused(const Scene& wanted, const Settings& changed) {
  Settings settings = changed;
  settings.insert(entry.settings.begin(), entry.settings.end());
  try {
    scene = adaptScene(can, wanted, {}).scene;
    realised = engine_.load(scene, settings);
    return std::nullopt;
  } catch (const UnsupportedScene& refusal) {
    return refusal.what();
  }
}

void Exam::load(const Scene& wanted, const Settings& settings) {
  if (auto why = refused(wanted, settings)) skip(std::move(*why));
}

void Exam::loadWithinLimits(const Scene& wanted) {
  const auto why = refused(wanted);
  if (!why) return;
  const bool declared =
      !mismatches(can, wanted).empty() || !beyondLimits(can.limits, wanted, false).empty();
  require(declared, said("refuses what none of its capabilities excludes: ", *why));
  skip(*why);
}

void Exam::needs(const std::string& capability) const {
  const std::vector<std::string> declared = declaredBy(can);
  if (std::ranges::find(declared, capability) == declared.end()) skip(undeclared(capability));
}

Snapshot Exam::at(double t) {
  engine_.advance(t);
  return engine_.snapshot(contactReport());
}

std::vector<Snapshot> Exam::watch(double t) {
  std::vector<Snapshot> seen;
  const auto steps = std::llround(t / realised.dt);
  for (long long step = 0; step <= steps; ++step)
    seen.push_back(at(static_cast<double>(step) * realised.dt));
  return seen;
}

void Exam::expect(bool holds, const std::string& otherwise) {
  if (!holds) fault(otherwise);
}

void Exam::expect(const Comparison& comparison, const std::string& what) {
  if (!comparison.difference.empty()) fault(what + ": " + comparison.difference);
}

void Exam::require(bool holds, const std::string& otherwise) {
  expect(holds, otherwise);
  if (!holds) throw GivenUp{};
}

}  // namespace crossgrain::conformance
