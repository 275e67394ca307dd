// What an engine cannot do is refused in one clear line, and the engine lives on.
#include <algorithm>
#include <functional>

#include "adapters/law_options.hpp"
#include "runs/common/engine_access.hpp"
#include "support/bad_input.hpp"
#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

template <typename Refusal>
std::string refusalOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return {};
}

bool oneLine(const std::string& text) {
  return !text.empty() && text.find('\n') == std::string::npos;
}

bool named(const std::vector<Deviation>& deviations, const std::string& name) {
  return std::ranges::find(deviations, name, &Deviation::name) != deviations.end();
}

/// A scene that calls for all that the law has.
Scene fullScene(const ContactLaw& law) {
  Scene scene = busyScene(law);
  scene.bottom = thesisBottom<BottomPlate>();
  return scene;
}

/// What the scene calls for and the engine does not have.
std::vector<Effect> lacking(const Capabilities& can, const Scene& scene) {
  std::vector<Effect> effects;
  for (const Effect effect : effectsOf(scene))
    if (can.effects.at(effect) == Support::never) effects.push_back(effect);
  return effects;
}

TEST_P(Conformance, HarnessRefusesWhatTheEngineLacks) {
  const auto expectRefusal = [&](const Scene& scene, const std::string& what,
                                 const std::vector<std::string>& mayDiffer) {
    Case setup;
    setup.file = "conformance.toml";
    setup.run.mayDiffer = mayDiffer;
    const std::string why =
        refusalOf<UnsupportedScene>([&] { loadScene(engine(), *entry_, setup, scene); });
    EXPECT_TRUE(oneLine(why)) << what << ": '" << why << "'";
    EXPECT_NE(why.find(entry_->name), std::string::npos) << what << ": '" << why << "'";
    EXPECT_NE(why.find(what), std::string::npos) << what << ": '" << why << "'";
  };
  for (const LawOption& option : lawOptions()) {
    const auto has = can_.lawOptions.find(std::string(option.name));
    if (has == can_.lawOptions.end()) continue;
    for (const std::string_view value : option.values) {
      if (std::ranges::find(has->second, value) != has->second.end()) continue;
      Scene scene = encounterScene(Encounter{}, law(), 50.0);
      setLawOption(scene.law, option.name, value);
      if (mattersTo(scene.law, option.name)) expectRefusal(scene, has->first, {});
    }
  }
  const Scene full = fullScene(law());
  for (const Effect effect : lacking(can_, full)) {
    std::vector<std::string> others;
    for (const Effect other : lacking(can_, full))
      if (other != effect) others.push_back(toString(other));
    expectRefusal(full, toString(effect), others);
  }
}

/// Past the harness, an engine refuses a scene or says in what it deviates.
TEST_P(Conformance, EngineRefusesOrSaysHowItDeviates) {
  const auto expectHonest = [&](const Scene& scene, const std::string& what) {
    Realised realised;
    const std::string why =
        refusalOf<UnsupportedScene>([&] { realised = engine().load(scene, {}); });
    if (why.empty()) {
      EXPECT_TRUE(named(realised.deviations, what)) << "runs " << what << " without a word";
    } else {
      EXPECT_TRUE(oneLine(why)) << why;
    }
  };
  for (const NormalLaw normal : {NormalLaw::linear, NormalLaw::rigid}) {
    Scene scene = encounterScene(Encounter{}, law(), 50.0);
    if (scene.law.normal == normal) continue;
    scene.law.normal = normal;
    const auto& has = can_.lawOptions.at("normal");
    if (std::ranges::find(has, lawOptionValue(scene.law, "normal")) != has.end()) continue;
    expectHonest(scene, "normal");
  }
  const Scene full = fullScene(law());
  for (const Effect effect : lacking(can_, full)) expectHonest(full, toString(effect));
}

TEST_P(Conformance, LivesOnAfterARefusal) {
  const Scene scene = encounterScene(crookedEncounter(), law(), 50.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const Snapshot before = at(Encounter::end);
  Scene other = scene;
  other.law.normal = rigid() ? NormalLaw::linear : NormalLaw::rigid;
  refusalOf<UnsupportedScene>([&] { engine().load(other, {}); });
  ASSERT_FALSE(refused(scene));
  EXPECT_TRUE(sameBits(at(Encounter::end), before));
}

TEST_P(Conformance, UnknownSettingsAreRefused) {
  Case setup;
  setup.file = "conformance.toml";
  const auto expectRefusal = [&](const std::string& name, const SettingValue& value) {
    setup.engines[entry_->name].clear();
    setup.engines[entry_->name][name] = value;
    const std::string why = refusalOf<BadInput>([&] { settingsFor(setup, entry_->name, can_); });
    EXPECT_TRUE(oneLine(why)) << name;
    EXPECT_NE(why.find(name), std::string::npos) << why;
  };
  expectRefusal("no_such_setting", 1.0);
  for (const SettingSpec& setting : can_.settings) {
    SettingValue wrong = true;
    if (wrong.index() == setting.defaultValue.index()) wrong = 1.0;
    expectRefusal(setting.name, wrong);
    if (!setting.choices.empty()) expectRefusal(setting.name, std::string("no such choice"));
  }
}

}  // namespace
}  // namespace crossgrain::test
