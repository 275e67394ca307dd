// What an engine cannot do is refused in one clear line, and the engine lives on.
#include <algorithm>
#include <functional>

#include "adapters/law_options.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::conformance::refusal {
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

void harnessRefusesWhatTheEngineLacks(Exam& it) {
  const auto expectRefusal = [&](const Scene& scene, const std::string& what,
                                 const std::vector<std::string>& mayDiffer) {
    Case setup;
    setup.file = "conformance.toml";
    setup.run.mayDiffer = mayDiffer;
    const std::string why =
        refusalOf<UnsupportedScene>([&] { loadScene(it.engine(), it.entry, setup, scene); });
    const bool tells = oneLine(why) && why.find(it.entry.name) != std::string::npos &&
                       why.find(what) != std::string::npos;
    it.expect(tells, said("a scene with ", what, " is not refused in a line that names both: '",
                          why, "'"));
  };
  for (const LawOption& option : lawOptions()) {
    const auto has = it.can.lawOptions.find(std::string(option.name));
    if (has == it.can.lawOptions.end()) continue;
    for (const std::string_view value : option.values) {
      if (std::ranges::find(has->second, value) != has->second.end()) continue;
      Scene scene = encounterScene(Encounter{}, it.law(), 50.0);
      setLawOption(scene.law, option.name, value);
      if (mattersTo(scene.law, option.name)) expectRefusal(scene, has->first, {});
    }
  }
  const Scene full = fullScene(it.law());
  for (const Effect effect : lacking(it.can, full)) {
    std::vector<std::string> others;
    for (const Effect other : lacking(it.can, full))
      if (other != effect) others.push_back(toString(other));
    expectRefusal(full, toString(effect), others);
  }
}

/// Past the harness, an engine refuses a scene or says in what it deviates.
void engineRefusesOrSaysHowItDeviates(Exam& it) {
  const auto expectHonest = [&](const Scene& scene, const std::string& what) {
    Realised realised;
    const std::string why =
        refusalOf<UnsupportedScene>([&] { realised = it.engine().load(scene, it.entry.settings); });
    if (why.empty()) {
      it.expect(named(realised.deviations, what), said("runs ", what, " without a word"));
    } else {
      it.expect(oneLine(why), said("its refusal is not one line: ", why));
    }
  };
  for (const NormalLaw normal : {NormalLaw::linear, NormalLaw::rigid}) {
    Scene scene = encounterScene(Encounter{}, it.law(), 50.0);
    if (scene.law.normal == normal) continue;
    scene.law.normal = normal;
    const auto& has = it.can.lawOptions.at("normal");
    if (std::ranges::find(has, lawOptionValue(scene.law, "normal")) != has.end()) continue;
    expectHonest(scene, "normal");
  }
  const Scene full = fullScene(it.law());
  for (const Effect effect : lacking(it.can, full)) expectHonest(full, toString(effect));
}

void livesOnAfterARefusal(Exam& it) {
  const Scene scene = encounterScene(crookedEncounter(), it.law(), 50.0);
  it.load(scene);
  const Snapshot before = it.at(Encounter::end);
  Scene other = scene;
  other.law.normal = it.rigid() ? NormalLaw::linear : NormalLaw::rigid;
  refusalOf<UnsupportedScene>([&] { it.engine().load(other, it.entry.settings); });
  it.load(scene);
  it.expect(sameBits(it.at(Encounter::end), before), "after a refusal, and before");
}

void unknownSettingsAreRefused(Exam& it) {
  Case setup;
  setup.file = "conformance.toml";
  const auto expectRefusal = [&](const std::string& name, const SettingValue& value) {
    setup.engines[it.entry.name].clear();
    setup.engines[it.entry.name][name] = value;
    const std::string why = refusalOf<BadInput>([&] { settingsFor(setup, it.entry.name, it.can); });
    it.expect(oneLine(why) && why.find(name) != std::string::npos,
              said("the setting ", name, " is not refused in a line that names it: '", why, "'"));
  };
  expectRefusal("no_such_setting", 1.0);
  for (const SettingSpec& setting : it.can.settings) {
    SettingValue wrong = true;
    if (wrong.index() == setting.defaultValue.index()) wrong = 1.0;
    expectRefusal(setting.name, wrong);
    if (!setting.choices.empty()) expectRefusal(setting.name, std::string("no such choice"));
  }
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"HarnessRefusesWhatTheEngineLacks", "what it lacks is refused before it is asked",
            harnessRefusesWhatTheEngineLacks},
      Check{"EngineRefusesOrSaysHowItDeviates", "it refuses, or says how it deviates",
            engineRefusesOrSaysHowItDeviates},
      Check{"LivesOnAfterARefusal", "it lives on after a refusal", livesOnAfterARefusal},
      Check{"UnknownSettingsAreRefused", "settings that it does not have are refused",
            unknownSettingsAreRefused},
  };
  return list;
}

}  // namespace crossgrain::conformance::refusal
