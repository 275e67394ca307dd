#include "cases/effect_switch.hpp"

#include <array>
#include <string_view>

#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/loader_document.hpp"

namespace crossgrain::inline cases {
namespace {

/// A switch, as a sentence and as TOML.
struct Change {
  std::string what, fragment;
};

/// One thing that can be switched off.
struct Switchable {
  std::string_view name;
  std::optional<Effect> effect;  ///< that the case has or not; else has() decides
  bool (*has)(const Case&);
  Change (*change)(const Case&);
};

/// The pairs of materials without some constants, which are then those of [law]; to follow its
/// keys.
std::string pairsWithout(const Case& setup, std::initializer_list<std::string_view> constants) {
  const toml::table root = toml::parse(setup.resolvedToml);
  const toml::array* const pairs = root.at_path("law.pairs").as_array();
  std::string text;
  for (std::size_t k = 0; pairs && k < pairs->size(); ++k) {
    text += "[[law.pairs]]\n";
    for (const auto& [key, value] : *pairs->get(k)->as_table())
      if (std::ranges::find(constants, key.str()) == constants.end())
        text += fmt::format("{} = {}\n", key.str(), printValue(value));
  }
  return text;
}

/// The option of that name is "none", and the constants of its part are 0.
Change withoutPart(const Case& setup, const char* what, std::string_view option,
                   std::initializer_list<std::string_view> constants) {
  std::string law = fmt::format("[law]\n{} = \"none\"\n", option);
  for (const std::string_view constant : constants) law += fmt::format("{} = 0.0\n", constant);
  return {what, law + pairsWithout(setup, constants)};
}

Change noTangentialSpring(const Case& setup) {
  if (setup.law.gt > 0.0)
    return {"The viscous law: contacts have no history.", "[law]\ntangential = \"viscous\"\n"};
  return {"Coulomb's law: contacts have no history.", "[law]\ntangential = \"coulomb\"\n"};
}

Change noTangentialDamping(const Case& setup) {
  if (setup.law.tangential == TangentialLaw::springDashpot)
    return {"The spring alone holds a contact: no tangential dashpot.",
            "[law]\ntangential = \"spring\"\ngt = 0.0\n"};
  return {"Coulomb's law, the viscous one's limit of a dashpot without bound.",
          "[law]\ntangential = \"coulomb\"\ngt = 0.0\n"};
}

bool keepsTension(const Case& setup) {
  const ContactLaw& law = setup.law;
  return law.soft() && law.conventions.tension != Tension::cut && law.gn > 0.0;
}

/// In the order of reports. Gravity and moving walls, which drive the flow, are not switched.
const std::array switchables = {
    Switchable{"normal_damping", Effect::normalDamping, nullptr,
               [](const Case& setup) {
                 return Change{"Normal contacts lose no energy: no dashpot, restitution 1.",
                               (setup.law.soft() ? "[law]\ngn = 0.0\n" : "[law]\ne_n = 1.0\n") +
                                   pairsWithout(setup, {"gn", "e_n"})};
               }},
    Switchable{"friction", Effect::friction, nullptr,
               [](const Case& setup) {
                 std::string law = "[law]\ntangential = \"none\"\nmu = 0.0\ngt = 0.0\n";
                 if (setup.law.normal != NormalLaw::hertz) law += "kt = 0.0\n";  // else of young
                 return Change{
                     "No tangential force; with it go rotation, tangential springs and dashpots.",
                     law + pairsWithout(setup, {"mu", "kt", "gt"})};
               }},
    Switchable{"tangential_spring", Effect::tangentialSpring, nullptr, noTangentialSpring},
    Switchable{"tangential_damping", Effect::tangentialDamping, nullptr, noTangentialDamping},
    Switchable{"rotation", Effect::rotation, nullptr,
               [](const Case& setup) {
                 const char* const section = isAssembly(setup) ? "assembly" : "particles";
                 return Change{
                     fmt::format("Friction acts, but no {} turns about itself: every spin is zero, "
                                 "and stays so.",
                                 setup.dimension == 3 ? "sphere" : "disk"),
                     fmt::format("[{}]\nrotation = false\n", section)};
               }},
    Switchable{"bottom_friction", Effect::bottomFriction, nullptr,
               [](const Case&) {
                 return Change{"No plate under the disks.", "[bottom]\nmu = 0.0\n"};
               }},
    Switchable{"bottom_spin_friction", Effect::bottomSpinFriction, nullptr,
               [](const Case&) {
                 return Change{"The plate brakes velocities and leaves spins alone.",
                               "[bottom]\nspin = false\n"};
               }},
    Switchable{"rolling_resistance", Effect::rollingResistance, nullptr,
               [](const Case& setup) {
                 return withoutPart(setup, "No torque against rolling.", "rolling",
                                    {"mu_r", "kr", "kr_per_kt", "kr_factor", "gr"});
               }},
    Switchable{"cohesion", Effect::cohesion, nullptr,
               [](const Case& setup) {
                 return withoutPart(setup, "No attraction.", "cohesion",
                                    {"kc", "w", "gamma", "k_unload", "plastic_depth"});
               }},
    Switchable{"pair_materials", Effect::pairMaterials, nullptr,
               [](const Case&) {
                 return Change{"All pairs have the law of those that are not named.",
                               "[law]\npairs = []\n"};
               }},
    Switchable{"tension_cut", std::nullopt, keepsTension,
               [](const Case&) {
                 return Change{
                     "Normal forces below zero, near the end of a contact, are cut off: another "
                     "law, with a larger restitution.",
                     "[law]\ntension = \"cut\"\n"};
               }},
    Switchable{
        "double_precision", std::nullopt,
        [](const Case& setup) { return setup.run.precision == Precision::float64; },
        [](const Case&) {
          return Change{"Stepped in single precision (float32).", "[run]\nprecision = \"float\"\n"};
        }}};

}  // namespace

Effects effectsOf(const Case& setup) {
  return inDimensionOf(setup, [&]<int D>() { return effectsOf(unplacedScene<D>(setup, 0.0)); });
}

std::vector<EffectSwitch> effectSwitches(const Case& setup) {
  const Effects called = effectsOf(setup);
  std::vector<EffectSwitch> switches;
  for (const Switchable& one : switchables) {
    if (one.effect ? !called.contains(*one.effect) : !one.has(setup)) continue;
    Change change = one.change(setup);
    Case without = caseWith(setup, change.fragment);
    switches.push_back({std::string(one.name), std::move(change.what), one.effect,
                        std::move(without), std::move(change.fragment)});
  }
  return switches;
}

}  // namespace crossgrain::inline cases
