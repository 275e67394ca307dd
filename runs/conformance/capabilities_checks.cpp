// What an engine says of itself, and of what it made of a scene.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "adapters/law_options.hpp"
#include "adapters/pair_table.hpp"
#include "adapters/suitability.hpp"
#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"

namespace crossgrain::conformance::capabilities {
namespace {

bool named(const std::vector<Deviation>& deviations, const std::string& name) {
  return std::ranges::find(deviations, name, &Deviation::name) != deviations.end();
}

void capabilitiesAreComplete(Exam& it) {
  it.expect(!it.can.version.empty(), "it tells no version");
  it.expect(!it.can.precisions.empty(), "it tells no precision");
}

void lawOptionsAreThoseOfTheCaseFiles(Exam& it) {
  it.expect(it.can.lawOptions.contains("normal"), "it does not say which normal laws it has");
  ContactLaw law;
  for (const auto& [name, values] : it.can.lawOptions) {
    it.expect(!values.empty(), said(name, " has no value"));
    for (const std::string& value : values) {
      setLawOption(law, name, value);
      it.equal(std::ranges::count(values, value), 1,
               said("times that ", name, " = ", value, " is listed"));
    }
  }
}

void settingsAreDocumented(Exam& it) {
  std::set<std::string> names;
  for (const SettingSpec& setting : it.can.settings) {
    it.expect(!setting.name.empty(), "a setting has no name");
    it.expect(names.insert(setting.name).second, said(setting.name, " is listed twice"));
    it.expect(!setting.doc.empty(), said(setting.name, " has no doc"));
    if (std::holds_alternative<double>(setting.defaultValue)) {
      it.expect(!setting.unit.empty(), said(setting.name, " has no unit"));
    }
    const auto* text = std::get_if<std::string>(&setting.defaultValue);
    if (text && !setting.choices.empty()) {
      it.equal(std::ranges::count(setting.choices, *text), 1,
               said("times that the default of ", setting.name, " is among its choices"));
    }
  }
}

void defaultsSpokenAloudChangeNothing(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const double dt = it.realised.dt;
  const Snapshot silent = it.at(busyEnd);
  Settings spoken = it.entry.settings;
  for (const SettingSpec& setting : it.can.settings)
    spoken.try_emplace(setting.name, setting.defaultValue);
  it.load(scene, spoken);
  it.equal(it.realised.dt, dt, "the time step with its defaults as settings");
  it.expect(sameBits(it.at(busyEnd), silent), "with its defaults as settings, and without");
}

void realisedSaysWhatTheSceneSays(Exam& it) {
  const Encounter pair = crookedEncounter();
  const Scene scene = encounterScene(pair, it.law(), 50.0);
  it.load(scene);
  it.above(it.realised.dt, 0.0, "the time step");
  it.equal(it.realised.precision, toString(it.can.precisions.front()), "the precision");
  it.expect(!it.realised.integrator.empty(), "it tells no integrator");
  for (const Deviation& deviation : it.realised.deviations)
    it.expect(!deviation.name.empty() || deviation.note.empty(), said(deviation.name));

  // The constants of a pair are the scene's, whatever the engine's mixing rule, unless it says
  // that its contacts are stiffer; then restitutions stay, γ²/k being the same.
  double stiffness = 1.0;
  for (const Deviation& deviation : it.realised.deviations)
    if (deviation.name == "stiffness") stiffness = deviation.value;
  if (it.realised.pairs.empty()) it.skip("tells no pairs: the constants that it uses");
  const Tolerance rounding = {1e-14, 1e-12, "a mixing rule undone: some roundings"};
  const PairCoefficients wanted = coefficientsOf(scene.law);
  const double root = std::sqrt(stiffness);
  for (const PairCoefficients& used : it.realised.pairs)
    for (const auto& [name, found, expected] : {std::tuple("kn", used.kn, wanted.kn * stiffness),
                                                {"gn", used.gn, wanted.gn * root},
                                                {"kt", used.kt, wanted.kt * stiffness},
                                                {"gt", used.gt, wanted.gt * root},
                                                {"mu", used.mu, wanted.mu},
                                                {"en", used.en, wanted.en},
                                                {"et0", used.et0, wanted.et0}})
      it.expect(close(found, expected, rounding), said(used.pair, ", ", name));
}

/// What is simulated is what the scene calls for, or a deviation says otherwise.
void simulatesWhatTheSceneCallsFor(Exam& it) {
  ContactLaw undamped = it.law();
  undamped.gn = 0.0;
  undamped.en = 1.0;
  ContactLaw dashpotless = it.law();
  dashpotless.gt = 0.0;
  Scene busy = busyScene(it.law());
  busy.bottom = thesisBottom<BottomPlate>();
  Scene coarse = busy;
  coarse.bottom->spin = false;
  const Encounter pair;
  for (const Scene& wanted :
       {encounterScene(pair, frictionless(undamped), 50.0),
        encounterScene(pair, frictionless(it.law()), 50.0), encounterScene(pair, dashpotless, 50.0),
        encounterScene(pair, it.law(), 50.0), busy, coarse}) {
    const Scene scene = it.simplified(wanted);
    const Effects called = effectsOf(scene);
    it.load(scene);
    for (const Effect effect : allEffects)
      if (it.realised.effects.contains(effect) != called.contains(effect)) {
        it.expect(named(it.realised.deviations, toString(effect)),
                  said(toString(effect), " is called for: ", called.contains(effect),
                       ", simulated: ", it.realised.effects.contains(effect)));
      }
  }
}

/// Capabilities, the harness' own account of a scene and Realised tell one story, of a scene that
/// calls for everything: what an engine never simulates it does not list as simulated, a soft law's
/// springs in a rigid engine included.
void effectsAreThoseThatItsCapabilitiesSay(Exam& it) {
  Scene busy = busyScene(fullLaw());
  busy.bottom = thesisBottom<BottomPlate>();
  it.requireEqual(effectsOf(busy).size(), allEffects.size(),
                  "effects of a scene that calls for all");
  std::vector<std::string> all;
  for (const Effect effect : allEffects) all.push_back(toString(effect));
  for (const LawOption& option : lawOptions()) all.emplace_back(option.name);
  Scene scene = adaptScene(it.can, busy, all).scene;
  try {
    it.realised = it.engine().load(scene, it.entry.settings);
  } catch (const UnsupportedScene&) {  // nor can it put another law in this one's place
    busy.law = it.law();
    scene = adaptScene(it.can, busy, all).scene;
    it.realised = it.engine().load(scene, it.entry.settings);
  }
  for (const Effect effect : effectsOf(busy))
    it.equal(it.realised.effects.contains(effect), it.can.effects.at(effect) != Support::never,
             said(toString(effect)));
  it.expect(it.realised.effects == simulatedEffects(it.can, scene),
            "its effects are not those of the scene that it has");
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"CapabilitiesAreComplete", "it says what it can do", capabilitiesAreComplete},
      Check{"LawOptionsAreThoseOfTheCaseFiles",
            "its law options have names and values that case files know",
            lawOptionsAreThoseOfTheCaseFiles},
      Check{"SettingsAreDocumented", "its settings have names, units and words",
            settingsAreDocumented},
      Check{"DefaultsSpokenAloudChangeNothing", "its defaults as settings change nothing",
            defaultsSpokenAloudChangeNothing},
      Check{"RealisedSaysWhatTheSceneSays", "the constants that it uses are the scene's",
            realisedSaysWhatTheSceneSays},
      Check{"SimulatesWhatTheSceneCallsFor",
            "it simulates what the scene calls for, or says otherwise",
            simulatesWhatTheSceneCallsFor},
      Check{"EffectsAreThoseThatItsCapabilitiesSay", "effects are those that its capabilities say",
            effectsAreThoseThatItsCapabilitiesSay},
  };
  return list;
}

}  // namespace crossgrain::conformance::capabilities
