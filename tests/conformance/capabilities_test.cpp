// What an engine says of itself, and of what it made of a scene.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "adapters/law_options.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/suitability.hpp"
#include "tests/conformance/conformance.hpp"

namespace crossgrain::test {
namespace {

bool named(const std::vector<Deviation>& deviations, const std::string& name) {
  return std::ranges::find(deviations, name, &Deviation::name) != deviations.end();
}

TEST_P(Conformance, CapabilitiesAreComplete) {
  EXPECT_FALSE(can_.version.empty());
  EXPECT_FALSE(can_.precisions.empty());
  for (const Effect effect : allEffects)
    EXPECT_TRUE(can_.effects.contains(effect)) << toString(effect) << " is not mentioned";
}

TEST_P(Conformance, LawOptionsAreThoseOfTheCaseFiles) {
  EXPECT_TRUE(can_.lawOptions.contains("normal")) << "which normal laws it has";
  ContactLaw law;
  for (const auto& [name, values] : can_.lawOptions) {
    EXPECT_FALSE(values.empty()) << name;
    for (const std::string& value : values) {
      EXPECT_NO_THROW(setLawOption(law, name, value));
      EXPECT_EQ(std::ranges::count(values, value), 1) << name << " = " << value;
    }
  }
}

TEST_P(Conformance, SettingsAreDocumented) {
  std::set<std::string> names;
  for (const SettingSpec& setting : can_.settings) {
    EXPECT_FALSE(setting.name.empty());
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name << " is listed twice";
    EXPECT_FALSE(setting.doc.empty()) << setting.name;
    if (std::holds_alternative<double>(setting.defaultValue)) {
      EXPECT_FALSE(setting.unit.empty()) << setting.name;
    }
    const auto* text = std::get_if<std::string>(&setting.defaultValue);
    if (text && !setting.choices.empty()) {
      EXPECT_EQ(std::ranges::count(setting.choices, *text), 1) << setting.name;
    }
  }
}

TEST_P(Conformance, DefaultsSpokenAloudChangeNothing) {
  const Scene scene = simplified(busyScene(law()));
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  const double dt = realised_.dt;
  const Snapshot silent = at(busyEnd);
  Settings defaults;
  for (const SettingSpec& setting : can_.settings) defaults[setting.name] = setting.defaultValue;
  ASSERT_FALSE(refused(scene, defaults));
  EXPECT_EQ(realised_.dt, dt);
  EXPECT_TRUE(sameBits(at(busyEnd), silent));
}

TEST_P(Conformance, RealisedSaysWhatTheSceneSays) {
  const Encounter pair = crookedEncounter();
  const Scene scene = encounterScene(pair, law(), 50.0);
  if (const auto why = refused(scene)) GTEST_SKIP() << *why;
  EXPECT_GT(realised_.dt, 0.0);
  EXPECT_EQ(realised_.precision, toString(can_.precisions.front()));
  EXPECT_FALSE(realised_.integrator.empty());
  for (const Deviation& deviation : realised_.deviations)
    EXPECT_FALSE(deviation.name.empty() || deviation.note.empty()) << deviation.name;

  // The constants of a pair are the scene's, whatever the engine's mixing rule, unless it says
  // that its contacts are stiffer; then restitutions stay, γ²/k being the same.
  double stiffness = 1.0;
  for (const Deviation& deviation : realised_.deviations)
    if (deviation.name == "stiffness") stiffness = deviation.value;
  ASSERT_FALSE(realised_.pairs.empty());
  const Tolerance rounding = {1e-14, 1e-12, "a mixing rule undone: some roundings"};
  const PairCoefficients wanted = coefficientsOf(scene.law);
  const double root = std::sqrt(stiffness);
  for (const PairCoefficients& used : realised_.pairs)
    for (const auto& [name, found, expected] : {std::tuple("kn", used.kn, wanted.kn * stiffness),
                                                {"gn", used.gn, wanted.gn * root},
                                                {"kt", used.kt, wanted.kt * stiffness},
                                                {"gt", used.gt, wanted.gt * root},
                                                {"mu", used.mu, wanted.mu},
                                                {"en", used.en, wanted.en},
                                                {"et0", used.et0, wanted.et0}})
      EXPECT_TRUE(close(found, expected, rounding)) << used.pair << ", " << name;
}

/// What is simulated is what the scene calls for, or a deviation says otherwise.
TEST_P(Conformance, SimulatesWhatTheSceneCallsFor) {
  ContactLaw undamped = law();
  undamped.gn = 0.0;
  undamped.en = 1.0;
  ContactLaw dashpotless = law();
  dashpotless.gt = 0.0;
  Scene busy = busyScene(law());
  busy.bottom = thesisBottom<BottomPlate>();
  Scene coarse = busy;
  coarse.bottom->spin = false;
  const Encounter pair;
  for (const Scene& wanted :
       {encounterScene(pair, frictionless(undamped), 50.0),
        encounterScene(pair, frictionless(law()), 50.0), encounterScene(pair, dashpotless, 50.0),
        encounterScene(pair, law(), 50.0), busy, coarse}) {
    const Scene scene = simplified(wanted);
    const Effects called = effectsOf(scene);
    if (const auto why = refused(scene)) GTEST_SKIP() << *why;
    for (const Effect effect : allEffects)
      if (realised_.effects.contains(effect) != called.contains(effect)) {
        EXPECT_TRUE(named(realised_.deviations, toString(effect)))
            << toString(effect) << " is called for: " << called.contains(effect)
            << ", simulated: " << realised_.effects.contains(effect);
      }
  }
}

/// Capabilities, the harness' own account of a scene and Realised tell one story, of a scene that
/// calls for everything: what an engine never simulates it does not list as simulated, a soft law's
/// springs in a rigid engine included.
TEST_P(Conformance, EffectsAreThoseThatItsCapabilitiesSay) {
  Scene busy = busyScene(fullLaw());
  busy.bottom = thesisBottom<BottomPlate>();
  ASSERT_EQ(effectsOf(busy).size(), allEffects.size());
  std::vector<std::string> all;
  for (const Effect effect : allEffects) all.push_back(toString(effect));
  for (const LawOption& option : lawOptions()) all.emplace_back(option.name);
  Scene scene = adaptScene(can_, busy, all).scene;
  try {
    realised_ = engine().load(scene, {});
  } catch (const UnsupportedScene&) {  // nor can it put another law in this one's place
    busy.law = law();
    scene = adaptScene(can_, busy, all).scene;
    realised_ = engine().load(scene, {});
  }
  for (const Effect effect : effectsOf(busy))
    EXPECT_EQ(realised_.effects.contains(effect), can_.effects.at(effect) != Support::never)
        << toString(effect);
  EXPECT_EQ(realised_.effects, simulatedEffects(can_, scene));
}

}  // namespace
}  // namespace crossgrain::test
