#include "runs/common/mirrors.hpp"

#include <gtest/gtest.h>

#include "adapters/law_options.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "runs/common/engine_access.hpp"

namespace {

using namespace crossgrain;

Case quickCell(const std::vector<std::string>& changes = {}) {
  return loadCase(CROSSGRAIN_CASES "/couette/quick.toml", changes).front();
}

Scene sceneOf(const Case& setup) {
  Packing packing;
  packing.disks = spreadDisks(setup);
  return couetteScene(setup, packing, 4e-5);
}

std::vector<EngineEntry> mirrors() {
  std::vector<EngineEntry> found;
  for (const EngineEntry& entry : engineRegistry()) {
    const EngineEntry* peer = findEngine(entry.mirrors);
    if (peer && (!peer->missing || peer->missing().empty())) found.push_back(entry);
  }
  return found;
}

/// Whatever the peer, and from nothing but its capabilities: what it lacks is gone.
TEST(MirrorScene, HasTheEffectsOfThePeer) {
  const Case setup = quickCell();
  const Scene scene = sceneOf(setup);
  ASSERT_TRUE(effectsOf(scene).contains(Effect::bottomFriction));
  for (const EngineEntry& mirror : mirrors()) {
    const Capabilities peer = *capabilitiesOf(*findEngine(mirror.mirrors), 60.0);
    const Scene seen = sceneOfPeer(mirror, setup, scene).scene;
    const Effects theirs =
        simulatedEffects(peer, adaptScene(peer, scene, setup.run.mayDiffer).scene);
    Effects ours = effectsOf(seen);
    if (!hasNormalLaw(peer, scene.law)) {  // springs that stand for a rigid law
      ours.erase(Effect::tangentialSpring);
      ours.erase(Effect::tangentialDamping);
    }
    EXPECT_EQ(ours, theirs) << mirror.name;
  }
}

/// The registry's conventions of a mirror are those that its peer declares.
TEST(MirrorScene, HasTheConventionsOfThePeer) {
  const Case setup = quickCell();
  const Scene scene = sceneOf(setup);
  for (const EngineEntry& mirror : mirrors()) {
    const Capabilities peer = *capabilitiesOf(*findEngine(mirror.mirrors), 60.0);
    const Scene seen = sceneOfPeer(mirror, setup, scene).scene;
    if (!hasNormalLaw(peer, scene.law)) {
      for (const LawOption& option : lawOptions())
        EXPECT_EQ(lawOptionValue(seen.law, option.name), lawOptionValue(scene.law, option.name));
      continue;
    }
    const Capabilities own = mirror.make()->capabilities();
    for (const auto& [option, values] : peer.lawOptions) {
      if (option == "tangential" || option == "damper" || option == "normal") continue;
      EXPECT_EQ(own.lawOptions.at(option), values) << mirror.name << ", " << option;
      EXPECT_EQ(std::ranges::count(values, lawOptionValue(seen.law, option)), 1)
          << mirror.name << ", " << option;
    }
  }
}

TEST(MirrorScene, SaysWhatItTookFromThePeer) {
  const Case setup = quickCell();
  const Adapted seen = sceneOfPeer(*findEngine("grain-as-box2d-penalty"), setup, sceneOf(setup));
  ASSERT_FALSE(seen.deviations.empty());
  for (const Deviation& deviation : seen.deviations)
    EXPECT_TRUE(deviation.note.starts_with("as its peer box2d-penalty: has ")) << deviation.note;
}

TEST(MirrorScene, IsRefusedWhereThePeerIs) {
  const Case setup = quickCell({"run.may_differ=[\"integrator\"]"});
  const EngineEntry& mirror = *findEngine("grain-stiff");
  try {
    sceneOfPeer(mirror, setup, sceneOf(setup));
    FAIL() << "no refusal";
  } catch (const UnsupportedScene& refusal) {
    EXPECT_TRUE(std::string(refusal.what()).starts_with("its peer box2d-impulse has no bottom_"))
        << refusal.what();
  }
}

TEST(MirrorScene, OfAnEngineThatIsNotHereSaysSo) {
  EngineEntry mirror = *findEngine("grain-as-yade");
  mirror.mirrors = "nobody";
  const Case setup = quickCell();
  const Scene scene = sceneOf(setup);
  const Adapted seen = sceneOfPeer(mirror, setup, scene);
  ASSERT_EQ(seen.deviations.size(), 1u);
  EXPECT_EQ(seen.deviations[0].name, "peer");
  EXPECT_EQ(effectsOf(seen.scene), effectsOf(scene));
}

}  // namespace
