#include "adapters/worker/json.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "law/law_options.hpp"
#include "tests/worker/toy_engine.hpp"

namespace crossgrain {
namespace {

/// Every option has its last value, and every constant one of its own.
ContactLaw lawOfAllParts(int dimension = 2) {
  ContactLaw law;
  law.dimension = dimension;
  for (const LawOption& option : lawOptions())
    if (option.part != LawPart::space || dimension == 3) option.set(law, option.values.size() - 1);
  double value = 0.1;
  for (const LawConstant& constant : lawConstants()) law.*constant.value = value += 1.0 / 3.0;
  return law;
}

/// A trip through text and a file, as between two processes.
template <typename Value, typename Read>
auto roundTrip(const Value& value, Read&& read) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".bin");
  ArrayWriter writer;
  const std::string text = toJson(value, writer).dump();
  const std::string list = writer.write(file).dump();
  const ArrayReader reader(file, nlohmann::json::parse(list));
  std::filesystem::remove(file);
  return read(nlohmann::json::parse(text), reader);
}

template <typename Value>
void expectSameBits(const std::vector<Value>& a, const std::vector<Value>& b) {
  ASSERT_EQ(a.size(), b.size());
  if (a.empty()) return;  // memcmp wants no null
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)), 0);
}

TEST(WorkerJson, Scene_KeepsEveryBit) {
  const Scene scene = test::toyScene();
  const Scene back = roundTrip(scene, sceneFromJson<2>);
  EXPECT_EQ(back.name, scene.name);
  expectSameBits(back.disks.radius, scene.disks.radius);
  expectSameBits(back.disks.mass, scene.disks.mass);
  expectSameBits(back.disks.inertia, scene.disks.inertia);
  expectSameBits(back.disks.position, scene.disks.position);
  expectSameBits(back.disks.velocity, scene.disks.velocity);
  expectSameBits(back.disks.spin, scene.disks.spin);
  ASSERT_EQ(back.bodies.size(), scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBody &x = back.bodies[b], &y = scene.bodies[b];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.centre, y.centre);
    expectSameBits(x.diskPosition, y.diskPosition);
    expectSameBits(x.diskRadius, y.diskRadius);
    ASSERT_EQ(x.planes.size(), y.planes.size());
    for (std::size_t p = 0; p < y.planes.size(); ++p) {
      EXPECT_EQ(x.planes[p].point, y.planes[p].point);
      EXPECT_EQ(x.planes[p].normal, y.planes[p].normal);
    }
    EXPECT_EQ(x.motion.kind, y.motion.kind);
    EXPECT_EQ(x.motion.angularVelocity, y.motion.angularVelocity);
    EXPECT_EQ(x.motion.velocity, y.motion.velocity);
    EXPECT_EQ(x.motion.amplitude, y.motion.amplitude);
    EXPECT_EQ(x.motion.frequency, y.motion.frequency);
    EXPECT_EQ(x.motion.radialVelocity, y.motion.radialVelocity);
    EXPECT_EQ(x.motion.radialEnd, y.motion.radialEnd);
  }
  EXPECT_EQ(back.law.kn, scene.law.kn);
  EXPECT_EQ(back.law.mu, scene.law.mu);
  for (const LawOption& option : lawOptions())
    EXPECT_EQ(option.get(back.law), option.get(scene.law)) << option.name;
  ASSERT_TRUE(back.bottom);
  EXPECT_EQ(back.bottom->kb, scene.bottom->kb);
  EXPECT_EQ(back.bottom->tauM, scene.bottom->tauM);
  EXPECT_EQ(back.bottom->spin, scene.bottom->spin);
  EXPECT_EQ(back.gravity, scene.gravity);
  EXPECT_EQ(back.dt, scene.dt);
  EXPECT_EQ(back.energyLedger, scene.energyLedger);
}

TEST(WorkerJson, LawsOfMaterials_KeepEveryBit) {
  Scene scene = test::toyScene();
  scene.law = lawOfAllParts();
  Materials& materials = scene.materials.emplace();
  materials = {{"glass", "steel"}, {}, {}, std::vector<ContactLaw>(4, scene.law)};
  materials.laws[1].mu = materials.laws[2].mu = 0.7;
  materials.ofDisk.assign(scene.disks.size(), 1);
  materials.ofBody.assign(scene.bodies.size(), 0);
  const Scene back = roundTrip(scene, sceneFromJson<2>);
  EXPECT_EQ(back.law, scene.law);
  EXPECT_EQ(back.materials, scene.materials);
  EXPECT_EQ(&back.lawOf(0, 1), &back.materials->law(1, 1));
  EXPECT_EQ(&back.lawOf(0, scene.disks.size()), &back.materials->law(1, 0));

  scene.materials->ofDisk.front() = 2;
  EXPECT_THROW(roundTrip(scene, sceneFromJson<2>), std::runtime_error);
}

TEST(WorkerJson, SceneInSpace_KeepsEveryBitAndItsDimension) {
  SpaceScene scene;
  scene.name = "spheres";
  scene.law = lawOfAllParts(3);
  scene.gravity = {0.1, 1.0 / 3.0, -9.81};
  scene.dt = 1e-6;
  for (const double k : {1.0, 2.0}) {
    scene.disks.radius.push_back(k / 7.0);
    scene.disks.mass.push_back(k / 11.0);
    scene.disks.inertia.push_back(k / 13.0);
    scene.disks.position.emplace_back(k, 2.0 * k, 3.0 / k);
    scene.disks.velocity.emplace_back(-k, 1.0 / k, 0.3);
    scene.disks.spin.emplace_back(5.0 * k, 1.0 / (3.0 * k), -7.0);
  }
  WallBodyOf<3> wall;
  wall.name = "wall";
  wall.planes.push_back({{1.0, 2.0, 1.0 / 3.0}, {0.0, 0.0, -1.0}});
  wall.cylinders.push_back({{1.0 / 3.0, 0.1, 7.0}, {0.0, 0.6, 0.8}, 1.0 / 7.0});
  wall.motion.kind = MotionKind::translating;
  wall.motion.velocity = {0.1, -0.2, 1.0 / 9.0};
  scene.bodies = {wall, wall};
  scene.bodies[1].cylinders.clear();
  ArrayWriter arrays;
  EXPECT_EQ(dimensionOf(toJson(scene, arrays)), 3);
  EXPECT_EQ(dimensionOf(toJson(test::toyScene(), arrays)), 2);
  EXPECT_THROW(dimensionOf({{"dimension", 4}}), std::runtime_error);
  const SpaceScene back = roundTrip(scene, sceneFromJson<3>);
  EXPECT_EQ(back.law, scene.law);
  EXPECT_EQ(back.gravity, scene.gravity);
  expectSameBits(back.disks.position, scene.disks.position);
  expectSameBits(back.disks.velocity, scene.disks.velocity);
  expectSameBits(back.disks.spin, scene.disks.spin);
  ASSERT_EQ(back.bodies.size(), 2u);
  ASSERT_EQ(back.bodies[0].cylinders.size(), 1u);
  EXPECT_EQ(back.bodies[0].cylinders[0].point, wall.cylinders[0].point);
  EXPECT_EQ(back.bodies[0].cylinders[0].axis, wall.cylinders[0].axis);
  EXPECT_EQ(back.bodies[0].cylinders[0].radius, 1.0 / 7.0);
  EXPECT_TRUE(back.bodies[1].cylinders.empty());
  EXPECT_EQ(back.bodies[0].planes[0].point, wall.planes[0].point);
  EXPECT_EQ(back.bodies[0].planes[0].normal, wall.planes[0].normal);
  EXPECT_EQ(back.bodies[0].motion.velocity, wall.motion.velocity);
}

TEST(WorkerJson, SnapshotInSpace_KeepsEveryBit) {
  SpaceScene scene;
  scene.disks.radius = {0.1, 0.2};
  SpaceSnapshot snapshot;
  snapshot.positionTime = 1.0 / 3.0;
  snapshot.position = {{1.0, 2.0, 1.0 / 3.0}, {4.0, 5.0, 6.0}};
  snapshot.velocity = {{1.0 / 7.0, 0.0, 1.0}, {0.0, -1.0, 0.0}};
  snapshot.spin = {{0.0, 0.0, 3.0}, {1.0 / 9.0, 2.0, 0.0}};
  ContactsOf<3>& contacts = snapshot.contacts.emplace();
  contacts.i = {0};
  contacts.j = {1};
  contacts.normal = {{0.6, 0.0, 0.8}};
  contacts.overlap = {1e-5};
  contacts.normalForce = {2.0};
  contacts.tangentialForce = {{0.8, 1.0 / 3.0, -0.6}};
  contacts.rollingTorque = {{1.0 / 13.0, 0.0, 0.0}};
  const SpaceSnapshot back = roundTrip(snapshot, [&](const auto& json, const auto& arrays) {
    return snapshotFromJson(json, arrays, scene);
  });
  EXPECT_EQ(back.positionTime, snapshot.positionTime);
  expectSameBits(back.position, snapshot.position);
  expectSameBits(back.velocity, snapshot.velocity);
  expectSameBits(*back.spin, *snapshot.spin);
  expectSameBits(back.contacts->normal, contacts.normal);
  expectSameBits(back.contacts->tangentialForce, contacts.tangentialForce);
  expectSameBits(back.contacts->rollingTorque, contacts.rollingTorque);
  EXPECT_EQ(back.contacts->force(0), Vec3(2.0 * 0.6 + 0.8, 1.0 / 3.0, 2.0 * 0.8 - 0.6));
}

/// An older worker knows nothing of them, and finds nothing of them.
TEST(WorkerJson, LawWithoutRollingAndCohesion_DoesNotTellTheirConventions) {
  ArrayWriter arrays;
  const nlohmann::json law = toJson(test::toyScene(), arrays).at("law");
  for (const LawOption& option : lawOptions())
    EXPECT_EQ(law.contains(std::string(option.name)), option.part == LawPart::contact);
  for (const LawConstant& constant : lawConstants())
    EXPECT_EQ(law.contains(std::string(constant.name)), constant.part == LawPart::contact);
}

TEST(WorkerJson, Snapshot_KeepsEveryBitAndWhatIsAbsent) {
  const Scene scene = test::toyScene();
  test::ToyEngine engine;
  engine.load(scene, {});
  engine.advance(1.0 / 3.0);
  const auto read = [&](const nlohmann::json& json, const ArrayReader& arrays) {
    return snapshotFromJson(json, arrays, scene);
  };
  Snapshot full = engine.snapshot(ContactReport::instant);
  full.contacts->rollingTorque = {1.0 / 13.0};
  full.contacts->dissipation = {1.0 / 17.0};
  const Snapshot back = roundTrip(full, read);
  EXPECT_EQ(back.positionTime, full.positionTime);
  EXPECT_EQ(back.velocityTime, full.velocityTime);
  EXPECT_EQ(back.contactTime, full.contactTime);
  expectSameBits(back.position, full.position);
  expectSameBits(back.velocity, full.velocity);
  expectSameBits(*back.spin, *full.spin);
  expectSameBits(back.wallPosition, full.wallPosition);
  EXPECT_EQ(back.bodies[0].force, full.bodies[0].force);
  EXPECT_FALSE(back.bodies[0].torque);
  EXPECT_FALSE(back.bodies[1].force);
  EXPECT_EQ(back.bodies[1].torque, full.bodies[1].torque);
  EXPECT_EQ(back.bodies[0].angle, full.bodies[0].angle);
  EXPECT_EQ(back.contacts->i, full.contacts->i);
  EXPECT_EQ(back.contacts->j, full.contacts->j);
  expectSameBits(back.contacts->normal, full.contacts->normal);
  expectSameBits(back.contacts->overlap, full.contacts->overlap);
  expectSameBits(back.contacts->normalForce, full.contacts->normalForce);
  expectSameBits(back.contacts->tangentialForce, full.contacts->tangentialForce);
  EXPECT_EQ(back.contacts->sliding, full.contacts->sliding);
  expectSameBits(back.contacts->rollingTorque, full.contacts->rollingTorque);
  expectSameBits(back.contacts->dissipation, full.contacts->dissipation);
  EXPECT_EQ(back.energies->elastic, full.energies->elastic);
  for (const LedgerTerm& term : ledgerTerms)
    EXPECT_EQ(*back.ledger.*term.value, *full.ledger.*term.value) << term.name;

  Snapshot bare = engine.snapshot(ContactReport::none);
  bare.spin.reset();
  const Snapshot bareBack = roundTrip(bare, read);
  EXPECT_FALSE(bareBack.contacts);
  EXPECT_FALSE(bareBack.spin);
  EXPECT_FALSE(bareBack.energies);
  EXPECT_FALSE(bareBack.ledger);
}

TEST(WorkerJson, CapabilitiesSettingsParametersStats_ComeBack) {
  test::ToyEngine engine;
  Capabilities can = engine.capabilities();
  can.limits.cylinders = false;
  const Capabilities without = readAs<Capabilities>(nlohmann::json::parse(jsonOf(can).dump()));
  EXPECT_FALSE(without.limits.cylinders);
  can.limits.cylinders = true;
  const Capabilities back = readAs<Capabilities>(nlohmann::json::parse(jsonOf(can).dump()));
  EXPECT_TRUE(back.limits.cylinders);
  EXPECT_EQ(back.version, can.version);
  std::map<Effect, Support> told;
  for (const Effect effect : allEffects) told[effect] = Support::never;  // what is missing
  for (const auto& [effect, support] : can.effects) told[effect] = support;
  EXPECT_EQ(back.effects, told);
  EXPECT_EQ(back.lawOptions, can.lawOptions);
  EXPECT_EQ(back.limits.inertia, can.limits.inertia);
  EXPECT_EQ(back.limits.wallMotions, can.limits.wallMotions);
  EXPECT_EQ(back.limits.planeMotions, can.limits.planeMotions);
  EXPECT_EQ(back.limits.planesAlongAxes, can.limits.planesAlongAxes);
  EXPECT_EQ(back.limits.restitutionPerBody, can.limits.restitutionPerBody);
  EXPECT_EQ(back.slidingFlags, true);
  EXPECT_EQ(back.warmHandover, false);
  EXPECT_EQ(back.energyLedger, true);
  ASSERT_EQ(back.settings.size(), 2u);
  EXPECT_EQ(back.settings[0].defaultValue, SettingValue(1.0));
  EXPECT_EQ(back.settings[1].defaultValue, SettingValue(std::string("fast")));
  EXPECT_EQ(back.settings[1].choices, can.settings[1].choices);

  const Settings settings = {{"a", true}, {"b", 0.1}, {"c", std::string("x")}};
  EXPECT_EQ(readAs<Settings>(nlohmann::json::parse(jsonOf(settings).dump())), settings);

  const EffectiveParameters effective = engine.load(test::toyScene(), {});
  const EffectiveParameters again =
      readAs<EffectiveParameters>(nlohmann::json::parse(jsonOf(effective).dump()));
  EXPECT_EQ(again.effects, effective.effects);
  EXPECT_EQ(again.dt, effective.dt);
  ASSERT_EQ(again.pairs.size(), 1u);
  EXPECT_EQ(again.pairs[0].pair, "a – b");
  EXPECT_EQ(again.pairs[0].kt, 0.2);
  // What a contact does not have is absent, not 0: springs have no restitutions, and rebounds no
  // springs.
  const nlohmann::json soft = jsonOf(effective)["pairs"][0];
  EXPECT_TRUE(soft["en"].is_null() && soft["et0"].is_null());
  EffectiveParameters rigid = effective;
  rigid.pairs[0] = {"a – b", 0.0, 0.0, 0.0, 0.0, 0.4, 0.0, 0.6};
  const nlohmann::json rebounding = jsonOf(rigid)["pairs"][0];
  for (const char* key : {"kn", "gn", "kt", "gt"}) EXPECT_TRUE(rebounding[key].is_null()) << key;
  EXPECT_EQ(rebounding["en"], 0.0);
  EXPECT_EQ(readAs<EffectiveParameters>(jsonOf(rigid)).pairs[0].et0, 0.6);
  ASSERT_EQ(again.deviations.size(), 1u);
  EXPECT_EQ(again.deviations[0].value, 1e-300);

  const Stats stats = statsFromJson(nlohmann::json::parse(toJson(engine.stats()).dump()));
  EXPECT_EQ(stats.wallSeconds, 1.0 / 3.0);
  EXPECT_EQ(stats.counters.at("rebuilds"), 5.0);

  for (const auto report :
       {ContactReport::none, ContactReport::instant, ContactReport::accumulated})
    EXPECT_EQ(readAs<ContactReport>(jsonOf(report)), report);
  EXPECT_THROW(readAs<ContactReport>("always"), std::runtime_error);
}

/// A key that is missing or null is named, whatever its type.
TEST(WorkerJson, RequiredKey_MissingOrNull_IsRefusedByName) {
  test::ToyEngine engine;
  const Json can = jsonOf(engine.capabilities());
  const Json effective = jsonOf(engine.load(test::toyScene(), {}));
  const auto refusal = [](auto read) -> std::string {
    try {
      read();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "none";
  };
  for (const char* key : {"dt", "precision", "effects", "pairs"})
    for (const bool missing : {true, false}) {
      Json broken = effective;
      if (missing)
        broken.erase(key);
      else
        broken[key] = nullptr;
      EXPECT_EQ(refusal([&] { readAs<EffectiveParameters>(broken); }).find(key), 0u) << key;
    }
  Json broken = can;
  broken["law_options"]["dashpot"] = {"sideways"};
  EXPECT_NE(refusal([&] { readAs<Capabilities>(broken); }).find("sideways"), std::string::npos);
  broken = can;
  broken["effects"]["levitation"] = "always";
  EXPECT_NE(refusal([&] { readAs<Capabilities>(broken); }).find("levitation"), std::string::npos);
}

}  // namespace
}  // namespace crossgrain
