#include "studies/conformance/check_context.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "adapters/suitability.hpp"
#include "law/law_options.hpp"
#include "studies/conformance/conformance_scenes.hpp"

namespace crossgrain::conformance {
namespace {

bool contains(const auto& values, const auto& value) {
  return std::ranges::find(values, value) != values.end();
}

Comparison within(double distance, double size, const Tolerance& allowed,
                  const std::string& values) {
  const double limit = std::max(allowed.absolute, allowed.relative * size);
  if (distance <= limit) return {};  // false for a NaN
  return {
      fmt::format("{}, off by {:.3g}, allowed {:.3g} ({})", values, distance, limit, allowed.why)};
}

bool sameContacts(const Contacts& a, const Contacts& b) {
  return a.i == b.i && a.j == b.j && a.normal == b.normal && a.overlap == b.overlap &&
         a.normalForce == b.normalForce && a.tangentialForce == b.tangentialForce &&
         a.sliding == b.sliding && a.rollingTorque == b.rollingTorque &&
         a.dissipation == b.dissipation;
}

bool sameBody(const BodySnapshot& a, const BodySnapshot& b) {
  return a.centre == b.centre && a.angle == b.angle && a.velocity == b.velocity &&
         a.angularVelocity == b.angularVelocity && a.force == b.force && a.torque == b.torque;
}

/// Whether the option, at that value, has a bearing on any law that the engine declares.
bool hasBearing(const Capabilities& can, const std::string& option, const std::string& value) {
  const auto candidates = [&](const std::string& name) {
    return name == option ? std::vector{value} : valuesOf(can, ContactLaw{}, name);
  };
  ContactLaw law;
  law.gn = law.gt = law.mu = 1.0;
  if (contains(can.dimensions, 3)) law.dimension = 3;
  // An arm of v_t that is that of f_t could be another one wherever there are arms.
  const std::string asked = option == "velocity_arm" ? "lever_arm" : option;
  const auto known = std::ranges::find(lawOptions(), option, &LawOption::name);
  if (known->part == LawPart::rolling || known->part == LawPart::cohesion)
    return std::ranges::any_of(resistingLaws(can), [&](ContactLaw resisting) {
      if (option == "rolling" || option == "cohesion")
        return lawOptionValue(resisting, option) == value && value != "none";
      resisting.gn = resisting.gr = 1.0;
      setLawOption(resisting, option, value);
      return mattersTo(resisting, option);
    });
  for (const std::string& normal : candidates("normal"))
    for (const std::string& tangential : candidates("tangential"))
      for (const std::string& tension : candidates("tension"))
        for (const std::string& arm : candidates("lever_arm")) {
          setLawOption(law, "normal", normal);
          setLawOption(law, "tangential", tangential);
          setLawOption(law, "tension", tension);
          setLawOption(law, "lever_arm", arm);
          setLawOption(law, option, value);
          if (mattersTo(law, asked)) return true;
        }
  return false;
}

}  // namespace

bool simulates(const Capabilities& can, Effect effect) {
  const auto found = can.effects.find(effect);
  return found != can.effects.end() && found->second != Support::never;
}

std::vector<std::string> effectNames() {
  std::vector<std::string> names;
  for (const Effect effect : allEffects) names.push_back(toString(effect));
  return names;
}

bool single(const Capabilities& can) {
  return !can.precisions.empty() && can.precisions.front() == Precision::float32;
}

double roundedInFlight(const Capabilities& can, double place, double steps) {
  return single(can) ? 0.5 * std::numeric_limits<float>::epsilon() * place * steps : 0.0;
}

double roundedInContact(const Capabilities& can, double place, double steps) {
  return single(can) ? std::numeric_limits<float>::epsilon() * place * std::sqrt(steps) : 0.0;
}

std::string percentOf(double change) {
  const double percent = 100.0 * change;
  return std::abs(percent) < 99.5 ? fmt::format(" {:+.2g} %", percent)
                                  : fmt::format(" {:+.0f} %", percent);
}

bool oneCause(const std::vector<SubjectCause>& causes) {
  return std::ranges::all_of(causes, [&](const SubjectCause& one) {
    const SubjectCause& first = causes.front();
    const double largest = std::max(std::abs(one.change), std::abs(first.change));
    return one.name == first.name &&
           std::abs(one.change - first.change) <= explainedLeaves * largest;
  });
}

Comparison close(double actual, double expected, const Tolerance& allowed) {
  return within(std::abs(actual - expected), std::abs(expected), allowed,
                fmt::format("{:.8g}, not {:.8g}", actual, expected));
}

Comparison close(const Vec2& actual, const Vec2& expected, const Tolerance& allowed) {
  return within((actual - expected).norm(), expected.norm(), allowed,
                fmt::format("({:.8g}, {:.8g}), not ({:.8g}, {:.8g})", actual.x(), actual.y(),
                            expected.x(), expected.y()));
}

Comparison sameBits(const Snapshot& a, const Snapshot& b) {
  const bool contacts = a.contacts.has_value() == b.contacts.has_value() &&
                        (!a.contacts || sameContacts(*a.contacts, *b.contacts));
  for (const auto& [same, what] :
       {std::pair(a.positionTime == b.positionTime && a.velocityTime == b.velocityTime &&
                      a.contactTime == b.contactTime && a.contactInterval == b.contactInterval,
                  "times"),
        {a.position == b.position, "positions"},
        {a.velocity == b.velocity, "velocities"},
        {a.spin == b.spin, "spins"},
        {a.wallPosition == b.wallPosition, "positions of wall disks"},
        {std::ranges::equal(a.bodies, b.bodies, sameBody), "wall bodies"},
        {contacts, "contacts"}})
    if (!same) return {fmt::format("{} are not the same bits", what)};
  return {};
}

std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot) {
  return snapshot.spin.value_or(scene.disks.spin);
}

std::vector<DiskState> statesOf(const Scene& scene, const Snapshot& snapshot) {
  const std::vector<double> spins = spinsOf(scene, snapshot);
  std::vector<DiskState> states;
  for (std::size_t i = 0; i < snapshot.position.size(); ++i)
    states.push_back({snapshot.position[i], snapshot.velocity[i], spins[i]});
  return states;
}

double farthestPlace(const Scene& scene) {
  double place = 0.0;
  for (const Vec2& x : scene.disks.position) place = std::max(place, x.norm());
  return place;
}

double farthest(const std::vector<double>& one, const std::vector<double>& other) {
  double most = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) most = std::max(most, std::abs(one[k] - other[k]));
  return most;
}

Scene sceneOf(const ContactLaw& law, std::vector<WallBody> bodies,
              const std::vector<SmallDisk>& disks, double steps) {
  Scene scene = emptyScene(law, steps);
  scene.bodies = std::move(bodies);
  for (const auto& [position, velocity, spin] : disks)
    addDisk(scene, smallRadius, smallMass, position, velocity, spin);
  return scene;
}

WallBody planeWall(const Vec2& point, const Vec2& normal, const Motion& motion,
                   const std::string& name) {
  WallBody body = planeWall(point, normal);
  body.motion = motion;
  body.name = name;
  return body;
}

WallBody postAt(const Vec2& centre, const Motion& motion, const std::string& name) {
  return wallOf(name, centre, {centre}, motion);
}

std::string planeMotion(Motion::Kind kind) {
  return "planes: " + toString(kind);
}

std::string wallMotion(Motion::Kind kind) {
  return "walls: " + toString(kind);
}

std::string convexBodies(ShapeKind kind) {
  return "convex bodies: " + toString(kind);
}

std::string precisionNamed(Precision precision) {
  return "precision " + toString(precision);
}

std::vector<std::string> declaredBy(const Capabilities& can) {
  using Kind = Motion::Kind;
  std::vector<std::string> all;
  const bool plate = contains(can.dimensions, 2);  // there is none in space
  for (const auto& [effect, support] : can.effects)
    if (support != Support::never &&
        (plate || (effect != Effect::bottomFriction && effect != Effect::bottomSpinFriction)))
      all.push_back(toString(effect));
  for (const auto& [option, values] : can.lawOptions)
    for (const std::string& value : values)
      if (hasBearing(can, option, value)) all.push_back(option + " = " + value);
  const auto allows = [&](const std::optional<std::vector<Kind>>& motions, Kind kind) {
    return (simulates(can, Effect::movingWalls) || kind == Kind::fixed) &&
           (!motions || contains(*motions, kind));
  };
  constexpr std::array kinds = {Kind::fixed, Kind::rotating, Kind::translating, Kind::oscillating,
                                Kind::radial};
  const SceneLimits& limits = can.limits;
  if (!limits.planeMotions || !limits.planeMotions->empty()) {
    all.push_back(planes);
    if (!limits.planesAlongAxes) all.push_back(slantingPlanes);
    for (const Kind kind : kinds) {
      if (kind == Kind::radial) continue;  // planes of radial bodies stay
      if (kind == Kind::rotating && limits.planesAlongAxes) continue;
      if (allows(limits.planeMotions, kind)) all.push_back(planeMotion(kind));
    }
    if (allows(limits.planeMotions, Kind::translating)) all.push_back(planesAlongThemselves);
  }
  for (const Kind kind : kinds)
    if (allows(limits.wallMotions, kind)) all.push_back(wallMotion(kind));
  const auto normal = can.lawOptions.find("normal");
  const bool impulses =
      normal != can.lawOptions.end() && contains(normal->second, std::string("rigid"));
  for (const auto& [declared, name] :
       {std::pair(can.checkpoints, checkpoints),
        {can.slidingFlags, slidingFlags},
        {can.instantContacts, instantContacts},
        {can.accumulatedContacts, accumulatedContacts},
        {can.warmHandover, "warm hand-over"},
        {can.energyLedger, energyLedger},
        {contains(can.dimensions, 3), spheresInSpace},
        {can.periodic, periodicDirections},
        {limits.cylinders, cylinders},
        {true, severalSizes},
        {true, manyDisks},
        {true, farPlaces},
        {true, lateTimes},
        {can.tangentialRestitution && impulses, tangentialRestitution}})
    if (declared) all.push_back(name);
  for (const ShapeKind kind : limits.shapes) all.push_back(convexBodies(kind));
  for (const Precision precision : can.precisions) all.push_back(precisionNamed(precision));
  if (const auto known = std::ranges::find(can.settings, "dt", &SettingSpec::name);
      known != can.settings.end())
    all.push_back(settingDt);
  return all;
}

std::vector<std::string> valuesOf(const Capabilities& can, const ContactLaw& law,
                                  const std::string& option) {
  const auto listed = can.lawOptions.find(option);
  return listed == can.lawOptions.end() ? std::vector{lawOptionValue(law, option)} : listed->second;
}

ContactLaw followed(const Capabilities& can, ContactLaw law) {
  for (const auto& [name, values] : can.lawOptions) {
    // The kind of rolling resistance or cohesion matters only to laws that have it.
    if ((name == "rolling" && !law.rolls()) || (name == "cohesion" && !law.coheres())) continue;
    if (!contains(values, lawOptionValue(law, name))) setLawOption(law, name, values.back());
  }
  if (!can.tangentialRestitution) law.et0 = 0.0;
  return law;
}

double CheckContext::inertiaFactor() const {
  constexpr double solidSphere = 0.4;
  if (inSpace && hasInertia(can.limits, solidSphere)) return solidSphere;
  const auto& has = can.limits.inertia;
  if (!has || has->empty() || hasInertia(can.limits, solidDisk)) return solidDisk;
  return has->front();
}

Scene CheckContext::withItsInertia(Scene wanted) const {
  const double factor = inertiaFactor();
  Disks& disks = wanted.disks;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const double square = disks.mass[k] * disks.radius[k] * disks.radius[k];
    if (std::abs(disks.inertia[k] - solidDisk * square) < 1e-12 * square)
      disks.inertia[k] = factor * square;
  }
  return wanted;
}

bool CheckContext::inHouse() const {
  return entry.name == engineRegistry().front().name || !entry.mirrors.empty();
}

Scene CheckContext::mirrored(const ContactLaw& law) const {
  Scene mirror = scene;
  mirror.law = law;
  mirror.dt = effective.dt;
  mirror.precision = Precision::float64;
  return mirror;
}

Scene CheckContext::simplified(const Scene& whole) const {
  std::vector<std::string> effects = effectNames();
  effects.emplace_back(tangentialRestitutionName);
  return adaptScene(can, withItsInertia(whole), effects).scene;
}

ContactReport CheckContext::contactReport() const {
  return can.instantContacts       ? ContactReport::instant
         : can.accumulatedContacts ? ContactReport::accumulated
                                   : ContactReport::none;
}

Tolerance CheckContext::byPrecision(double ifDouble, double ifFloat, const char* why,
                                    double unit) const {
  // There and back three products and their sums each, some 10⁻¹⁵ together.
  const double allowed = single() ? ifFloat : turned ? std::max(ifDouble, 4e-15) : ifDouble;
  return {allowed * unit, unit == 1.0 ? allowed : 0.0, why};
}

std::optional<std::string> CheckContext::refusal(const Scene& wanted, const Settings& changed) {
  Settings settings = changed;
  settings.insert(entry.settings.begin(), entry.settings.end());
  try {
    scene = adaptScene(can, withItsInertia(wanted), {}).scene;
    effective = engine.load(scene, settings);
    return std::nullopt;
  } catch (const UnsupportedScene& unsupported) {
    return unsupported.what();
  }
}

void CheckContext::load(const Scene& wanted, const Settings& settings) {
  if (auto why = refusal(wanted, settings)) skip(std::move(*why));
}

bool CheckContext::loads(const Scene& wanted, bool required) {
  auto why = refusal(wanted);
  if (why && required) skip(std::move(*why));
  return !why;
}

void CheckContext::loadWithinLimits(const Scene& wanted) {
  const auto why = refusal(wanted);
  if (!why) return;
  const Scene asked = withItsInertia(wanted);
  const bool declared =
      !mismatches(can, asked).empty() || !beyondLimits(can.limits, asked, false).empty();
  require(declared, text("refuses what none of its capabilities excludes: ", *why));
  skip(*why);
}

Snapshot CheckContext::at(double t) {
  engine.advance(t);
  return engine.snapshot(contactReport());
}

Snapshot CheckContext::run(const Scene& wanted, double t) {
  load(wanted);
  return at(t);
}

std::vector<Snapshot> CheckContext::watch(
    double t, const std::function<bool(const std::vector<Snapshot>&)>& enough) {
  std::vector<Snapshot> seen;
  const auto steps = std::llround(t / effective.dt);
  for (long long step = 0; step <= steps; ++step) {
    seen.push_back(at(static_cast<double>(step) * effective.dt));
    if (enough && enough(seen)) break;
  }
  return seen;
}

void CheckContext::needs(const std::string& capability) const {
  if (!contains(declaredBy(can), capability)) skip("declares no " + capability);
}

void CheckContext::needsContacts() const {
  if (contactReport() == ContactReport::none) skip("shows no contacts");
}

void CheckContext::expect(bool holds, const std::string& otherwise) {
  if (!holds) fault(otherwise);
}

void CheckContext::expect(const Comparison& comparison, const std::string& what) {
  if (!comparison.difference.empty()) fault(what + ": " + comparison.difference);
}

void CheckContext::require(bool holds, const std::string& otherwise) {
  expect(holds, otherwise);
  if (!holds) throw GivenUp{};
}

void CheckContext::sameMotion(const DiskState& found, const DiskState& wanted,
                              const Tolerance& part, const std::string& which) {
  const double unit = part.absolute * Encounter::speed;
  expect(close(found.velocity, wanted.velocity, {unit, 0.0, part.why}),
         "the velocity [m/s]" + which);
  expect(close(found.spin, wanted.spin, {unit / smallRadius, 0.0, part.why}),
         "the spin [rad/s]" + which);
}

void CheckContext::sameState(const DiskState& found, const DiskState& wanted, const Tolerance& part,
                             const std::string& which) {
  expect(close(found.position, wanted.position, {part.absolute * smallRadius, 0.0, part.why}),
         "the position [m]" + which);
  sameMotion(found, wanted, part, which);
}

}  // namespace crossgrain::conformance
