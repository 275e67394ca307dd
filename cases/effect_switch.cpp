#include "cases/effect_switch.hpp"

#include "cases/couette.hpp"

namespace crossgrain::inline cases {
namespace {

/// What was done, and as TOML.
struct Switched {
  std::string what, fragment;
};

/// Switches it off in `setup`. @returns empty if it cannot be
Switched switchOff(Case& setup, Effect effect) {
  ContactLaw& law = setup.law;
  switch (effect) {
    case Effect::normalDamping: {
      const bool rigid = !law.soft();
      law.gn = 0.0;
      law.en = 1.0;
      return {"Normal contacts lose no energy: no dashpot, restitution 1.",
              rigid ? "[law]\ne_n = 1.0\n" : "[law]\ngn = 0.0\n"};
    }
    case Effect::friction:
      law.tangential = TangentialLaw::none;
      law.mu = law.kt = law.gt = 0.0;
      return {"No tangential force; with it go rotation, tangential springs and dashpots.",
              "[law]\ntangential = \"none\"\nmu = 0.0\nkt = 0.0\ngt = 0.0\n"};
    case Effect::tangentialSpring:
      law.tangential = law.gt > 0.0 ? TangentialLaw::viscous : TangentialLaw::coulomb;
      law.kt = 0.0;
      return law.gt > 0.0 ? Switched{"The viscous law: contacts have no history.",
                                     "[law]\ntangential = \"viscous\"\n"}
                          : Switched{"Coulomb's law: contacts have no history.",
                                     "[law]\ntangential = \"coulomb\"\n"};
    case Effect::tangentialDamping:
      law.gt = 0.0;
      if (law.tangential == TangentialLaw::springDashpot) {
        law.tangential = TangentialLaw::spring;
        return {"The spring alone holds a contact: no tangential dashpot.",
                "[law]\ntangential = \"spring\"\n"};
      }
      law.tangential = TangentialLaw::coulomb;
      return {"Coulomb's law, the viscous one's limit of a dashpot without bound.",
              "[law]\ntangential = \"coulomb\"\n"};
    case Effect::rotation:
      setup.particles.rotation = false;
      return {"Friction acts, but no disk turns about itself: every spin is zero, and stays so.",
              "[particles]\nrotation = false\n"};
    case Effect::bottomFriction:
      setup.bottom.reset();
      return {"No plate under the disks.", "[bottom]\nmu = 0.0\n"};
    case Effect::bottomSpinFriction:
      setup.bottom->spin = false;
      return {"The plate brakes velocities and leaves spins alone.", "[bottom]\nspin = false\n"};
    case Effect::gravity:  // no case has it yet
    case Effect::movingWalls:
      break;
  }
  return {};
}

std::optional<EffectSwitch> tensionCut(const Case& setup) {
  const ContactLaw& law = setup.law;
  if (!law.soft() || law.conventions.tension == Tension::cut || law.gn == 0.0) return std::nullopt;
  EffectSwitch cut{"tension_cut",
                   "Normal forces below zero, near the end of a contact, are cut off: another law, "
                   "with a larger restitution.",
                   {},
                   setup};
  cut.without.law.conventions.tension = Tension::cut;
  cut.fragment = "[law]\ntension = \"cut\"\n";
  return cut;
}

std::optional<EffectSwitch> singlePrecision(const Case& setup) {
  if (setup.run.precision != Precision::float64) return std::nullopt;
  EffectSwitch single{"double_precision", "Stepped in single precision (float32).", {}, setup};
  single.without.run.precision = Precision::float32;
  single.fragment = "[run]\nprecision = \"float\"\n";
  return single;
}

}  // namespace

Effects effectsOf(const Case& setup) {
  return effectsOf(couetteScene(setup, {}, 0.0));
}

std::optional<EffectSwitch> without(const Case& setup, Effect effect) {
  if (!effectsOf(setup).contains(effect)) return std::nullopt;
  EffectSwitch off{toString(effect), "", effect, setup};
  const Switched done = switchOff(off.without, effect);
  off.what = done.what;
  off.fragment = done.fragment;
  if (off.what.empty()) return std::nullopt;
  return off;
}

std::vector<EffectSwitch> effectSwitches(const Case& setup) {
  std::vector<EffectSwitch> switches;
  const auto add = [&](std::optional<EffectSwitch> one) {
    if (one) switches.push_back(std::move(*one));
  };
  for (const Effect effect : allEffects) add(without(setup, effect));
  add(tensionCut(setup));
  add(singlePrecision(setup));
  return switches;
}

}  // namespace crossgrain::inline cases
