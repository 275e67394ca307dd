// Scenes and settings that must be refused, by the harness or the engine, and life after it.
#include <algorithm>

#include "adapters/suitability.hpp"
#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/core/engine_access.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::conformance {
namespace {

/// The message of the refusal; empty without one.
template <typename Refusal>
std::string refusalOf(const auto& act) {
  try {
    act();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return {};
}

bool oneLine(const std::string& message) {
  return !message.empty() && message.find('\n') == std::string::npos;
}

/// Effects that the scene calls for and the engine does not have.
std::vector<Effect> lacking(const Capabilities& can, const Scene& scene) {
  std::vector<Effect> effects;
  for (const Effect effect : effectsOf(scene))
    if (can.effects.at(effect) == Support::never) effects.push_back(effect);
  return effects;
}

void harnessRefusesWhatTheEngineLacks(CheckContext& context) {
  const auto expectRefusal = [&](const Scene& scene, const std::string& what,
                                 const std::vector<std::string>& mayDiffer) {
    Case setup;
    setup.file = "conformance.toml";
    setup.run.mayDiffer = mayDiffer;
    const std::string why = refusalOf<UnsupportedScene>(
        [&] { loadScene(context.engine, context.entry, setup, scene); });
    context.expect(
        oneLine(why) && why.find(context.entry.name) != std::string::npos &&
            why.find(what) != std::string::npos,
        text("a scene with ", what, " is not refused in a line that names both: '", why, "'"));
  };
  for (const LawOption& option : lawOptions()) {
    const auto has = context.can.lawOptions.find(std::string(option.name));
    if (has == context.can.lawOptions.end()) continue;
    for (const std::string_view value : option.values) {
      if (std::ranges::find(has->second, value) != has->second.end()) continue;
      Scene scene = encounterScene({}, context.law(), coarseSteps);
      setLawOption(scene.law, option.name, value);
      if (mattersTo(scene.law, option.name)) expectRefusal(scene, has->first, {});
    }
  }
  const Scene full = fullScene(context.can, context.law());
  std::vector<Effect> lacked = lacking(context.can, full);
  if (context.rigid())  // parts of a soft law that rigid contacts stand for
    std::erase_if(lacked, [](Effect effect) {
      return effect == Effect::tangentialSpring || effect == Effect::tangentialDamping;
    });
  for (const Effect effect : lacked) {
    std::vector<std::string> others;
    for (const Effect other : lacked)
      if (other != effect) others.push_back(toString(other));
    for (const LawOption& option : lawOptions())
      if (option.name != toString(effect)) others.emplace_back(option.name);
    expectRefusal(full, toString(effect), others);
  }
}

/// Past the harness, an engine refuses a scene or reports its deviation.
void engineRefusesOrSaysHowItDeviates(CheckContext& context) {
  const auto expectHonest = [&](const Scene& scene, const std::string& what) {
    EffectiveParameters effective;
    const std::string why = refusalOf<UnsupportedScene>([&] {
      effective = context.engine.load(context.withItsInertia(scene), context.entry.settings);
    });
    if (why.empty()) {
      context.expect(std::ranges::count(effective.deviations, what, &Deviation::name) > 0,
                     text("runs ", what, " without a deviation"));
    } else {
      context.expect(oneLine(why), text("its refusal is not one line: ", why));
    }
  };
  const std::vector<std::string>& has = context.can.lawOptions.at("normal");
  for (const char* normal : {"linear", "rigid"}) {
    Scene scene = encounterScene({}, context.law(), coarseSteps);
    setLawOption(scene.law, "normal", normal);
    if (std::ranges::find(has, normal) == has.end()) expectHonest(scene, "normal");
  }
  // Keys of rolling resistance, cohesion and materials are unknown, and ignored, to engines that
  // were written before there were any: of these it is for the harness to refuse them.
  const Scene full = plateScene(context.law());
  for (const Effect effect : lacking(context.can, full)) expectHonest(full, toString(effect));
}

void livesOnAfterARefusal(CheckContext& context) {
  const Scene scene = encounterScene(crookedEncounter(), context.law(), coarseSteps);
  const Snapshot before = context.run(scene, Encounter::end);
  Scene other = context.scene;
  other.law.normal = context.rigid() ? NormalLaw::linear : NormalLaw::rigid;
  refusalOf<UnsupportedScene>([&] { context.engine.load(other, context.entry.settings); });
  context.expect(sameBits(context.run(scene, Encounter::end), before),
                 "after a refusal, and before");
}

void unknownSettingsAreRefused(CheckContext& context) {
  const auto expectRefusal = [&](const std::string& name, const SettingValue& value) {
    Case setup;
    setup.file = "conformance.toml";
    setup.engines[context.entry.name][name] = value;
    const std::string why =
        refusalOf<BadInput>([&] { settingsFor(setup, context.entry.name, context.can); });
    context.expect(
        oneLine(why) && why.find(name) != std::string::npos,
        text("the setting ", name, " is not refused in a line that names it: '", why, "'"));
  };
  expectRefusal("no_such_setting", 1.0);
  for (const SettingSpec& setting : context.can.settings) {
    SettingValue wrong = true;
    if (wrong.index() == setting.defaultValue.index()) wrong = 1.0;
    expectRefusal(setting.name, wrong);
    if (!setting.choices.empty()) expectRefusal(setting.name, std::string("no such choice"));
  }
}

}  // namespace

Checks refusalChecks() {
  return {
      {"HarnessRefusesWhatTheEngineLacks", "what it lacks is refused before it is asked",
       harnessRefusesWhatTheEngineLacks},
      {"EngineRefusesOrSaysHowItDeviates", "it refuses, or says how it deviates",
       engineRefusesOrSaysHowItDeviates},
      {"LivesOnAfterARefusal", "it lives on after a refusal", livesOnAfterARefusal},
      {"UnknownSettingsAreRefused", "settings that it does not have are refused",
       unknownSettingsAreRefused},
  };
}

}  // namespace crossgrain::conformance
