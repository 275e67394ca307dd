#include "adapters/worker/json.hpp"

#include <gtest/gtest.h>

#include "law/law_options.hpp"
#include "tests/support/refusal.hpp"
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

/// Messages between two processes.
struct Travelling {
  std::string text, arrays;
  bool operator==(const Travelling&) const = default;
};

template <typename Value>
Travelling written(const Value& value) {
  ArrayWriter writer;
  nlohmann::json text = toJson(value, writer);
  text["arrays"] = writer.list();
  return {text.dump(),
          {reinterpret_cast<const char*>(writer.bytes().data()), writer.bytes().size()}};
}

template <typename Read>
auto readBack(const Travelling& there, Read&& read) {
  const auto text = nlohmann::json::parse(there.text);
  return read(text, ArrayReader(there.arrays, "arrays", text.at("arrays")));
}

/// Of the text the schema of the protocol says what is there (tests/system/test_engine_files.py).
template <typename Value, typename Read>
Value expectEveryBitComesBack(const Value& value, Read&& read) {
  const Travelling there = written(value);
  Value back = readBack(there, read);
  EXPECT_EQ(written(back), there);
  return back;
}

TEST(WorkerJson, Scene_KeepsEveryBit) {
  const Scene scene = test::toyScene();
  const Scene back = expectEveryBitComesBack(scene, sceneFromJson<2>);
  EXPECT_EQ(back.disks.position, scene.disks.position);
  EXPECT_EQ(back.bodies[0].diskRadius, scene.bodies[0].diskRadius);
  EXPECT_EQ(back.bodies[1].motion.frequency, scene.bodies[1].motion.frequency);
  EXPECT_EQ(back.bottom->tauM, scene.bottom->tauM);
  EXPECT_EQ(back.law, scene.law);
}

TEST(WorkerJson, LawsOfMaterials_KeepEveryBit) {
  Scene scene = test::toyScene();
  scene.law = lawOfAllParts();
  Materials& materials = scene.materials.emplace();
  materials = {{"glass", "steel"}, {}, {}, std::vector<ContactLaw>(4, scene.law)};
  materials.laws[1].mu = materials.laws[2].mu = 0.7;
  materials.ofDisk.assign(scene.disks.size(), 1);
  materials.ofBody.assign(scene.bodies.size(), 0);
  const Scene back = expectEveryBitComesBack(scene, sceneFromJson<2>);
  EXPECT_EQ(back.law, scene.law);
  EXPECT_EQ(back.materials, scene.materials);
  EXPECT_EQ(&back.lawOf(0, 1), &back.materials->law(1, 1));
  EXPECT_EQ(&back.lawOf(0, scene.disks.size()), &back.materials->law(1, 0));

  scene.materials->ofDisk.front() = 2;
  EXPECT_THROW(readBack(written(scene), sceneFromJson<2>), std::runtime_error);
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
  const SpaceScene back = expectEveryBitComesBack(scene, sceneFromJson<3>);
  EXPECT_EQ(back.law, scene.law);
  EXPECT_EQ(back.bodies[0].cylinders.at(0).axis, wall.cylinders[0].axis);
  EXPECT_TRUE(back.bodies[1].cylinders.empty());
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
  const SpaceSnapshot back = expectEveryBitComesBack(
      snapshot,
      [&](const auto& json, const auto& arrays) { return snapshotFromJson(json, arrays, scene); });
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
  const Snapshot back = expectEveryBitComesBack(full, read);
  EXPECT_EQ(back.position, full.position);
  EXPECT_FALSE(back.bodies[0].torque);
  EXPECT_FALSE(back.bodies[1].force);
  EXPECT_EQ(back.contacts->sliding, full.contacts->sliding);
  EXPECT_EQ(back.contacts->dissipation, full.contacts->dissipation);
  EXPECT_EQ(back.energies->elastic, full.energies->elastic);

  Snapshot bare = engine.snapshot(ContactReport::none);
  bare.spin.reset();
  const Snapshot bareBack = expectEveryBitComesBack(bare, read);
  EXPECT_FALSE(bareBack.contacts);
  EXPECT_FALSE(bareBack.spin);
  EXPECT_FALSE(bareBack.energies);
  EXPECT_FALSE(bareBack.ledger);
}

/// Through text.
template <typename Value>
Value expectComesBack(const Value& value) {
  Value back = readAs<Value>(nlohmann::json::parse(jsonOf(value).dump()));
  EXPECT_EQ(jsonOf(back), jsonOf(value));
  return back;
}

TEST(WorkerJson, CapabilitiesSettingsParametersStats_ComeBack) {
  test::ToyEngine engine;
  Capabilities can = engine.capabilities();
  EXPECT_EQ(readAs<Capabilities>(jsonOf(can)).effects.at(Effect::gravity), Support::never)
      << "what is missing";
  for (const Effect effect : allEffects) can.effects.try_emplace(effect, Support::never);
  for (const bool cylinders : {false, true}) {
    can.limits.cylinders = cylinders;
    const Capabilities back = expectComesBack(can);
    EXPECT_EQ(back.limits.cylinders, cylinders);
    EXPECT_EQ(back.lawOptions, can.lawOptions);
    EXPECT_EQ(back.limits.planesAlongAxes, can.limits.planesAlongAxes);
    EXPECT_EQ(back.limits.restitutionPerBody, can.limits.restitutionPerBody);
    EXPECT_EQ(back.settings.at(1).defaultValue, SettingValue(std::string("fast")));
  }
  SettingSpec passes{"passes", 4.0, "-", "", {}, 1.0, 9.0, true, SettingRole::iterations};
  EXPECT_EQ(expectComesBack(passes).role, SettingRole::iterations);
  passes.whole = false;
  EXPECT_THROW(readAs<SettingSpec>(jsonOf(passes)), FieldError);
  const Settings settings = {{"a", true}, {"b", 0.1}, {"c", std::string("x")}};
  EXPECT_EQ(expectComesBack(settings), settings);
  const EffectiveParameters effective = engine.load(test::toyScene(), {});
  const EffectiveParameters again = expectComesBack(effective);
  EXPECT_EQ(again.pairs.at(0).kt, 0.2);
  EXPECT_EQ(again.deviations.at(0).value, 1e-300);
  // Parameters that a contact does not have are absent, not 0: springs have no restitutions, and
  // rebounds no springs.
  const nlohmann::json soft = jsonOf(effective)["pairs"][0];
  EXPECT_TRUE(soft["en"].is_null() && soft["et0"].is_null());
  EffectiveParameters rigid = effective;
  rigid.pairs[0] = {"a – b", 0.0, 0.0, 0.0, 0.0, 0.4, 0.0, 0.6};
  const nlohmann::json rebounding = jsonOf(rigid)["pairs"][0];
  for (const char* key : {"kn", "gn", "kt", "gt"}) EXPECT_TRUE(rebounding[key].is_null()) << key;
  EXPECT_EQ(rebounding["en"], 0.0);
  EXPECT_EQ(readAs<EffectiveParameters>(jsonOf(rigid)).pairs[0].et0, 0.6);

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
  const auto refusal = [](auto read) { return test::refusalOf<std::exception>(read); };
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
