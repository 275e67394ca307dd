#include "studies/causes/differences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "adapters/declared_law.hpp"
#include "adapters/registry.hpp"
#include "cases/materials.hpp"
#include "law/law_options.hpp"
#include "studies/causes/changes.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::inline studies {

namespace {

using NameSet = std::set<std::string_view>;

/// An option and what means nothing without it.
struct Group {
  std::string_view option;
  std::vector<std::string_view> options;    ///< further ones
  std::vector<std::string_view> constants;  ///< of lawConstants()
};

/// The most comprehensive first: what one has taken is not taken again.
const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"normal", {"damper", "tangential"}, {"kn", "kn3", "gn", "kt", "gt", "en", "et0"}},
      {"damper", {}, {"gn", "gt"}},
      {"tangential", {}, {"kt", "gt"}},
      {"rolling", {"rolling_stiffness", "rolling_damper"}, {"kr", "gr", "mu_r"}},
      {"rolling_stiffness", {}, {"kr"}},
      {"rolling_damper", {}, {"gr"}},
      {"dashpot", {"spring_reset"}, {}},  // springs are set to what the bound leaves beside it
      {"rolling_dashpot", {"rolling_reset"}, {}},
      {"cohesion", {}, {"kc", "w", "k_unload", "plastic_depth"}},
      {"integrator", {"damping_velocity"}, {}}};  // Euler's is of the positions' own time
  return all;
}

double& constantOf(ContactLaw& law, std::string_view name) {
  return law.*std::ranges::find(lawConstants(), name, &LawConstant::name)->value;
}
double constantOf(const ContactLaw& law, std::string_view name) {
  return law.*std::ranges::find(lawConstants(), name, &LawConstant::name)->value;
}

/// Parts of one difference of laws.
struct Taken {
  std::vector<std::string_view> options, constants;
};

/// "damper+gn": all that moves together; a normal law by itself, whose constants are many.
std::string nameOf(const Group& group, const Taken& taken) {
  if (group.option == "normal") return "normal";
  return fmt::format("{}{}{}", fmt::join(taken.options, "+"), taken.constants.empty() ? "" : "+",
                     fmt::join(taken.constants, "+"));
}

/// Whether two constants differ by more than rounding.
bool differ(double one, double other) {
  return std::abs(one - other) > 1e-12 * std::max(std::abs(one), std::abs(other));
}

/// With as many digits as show that both values differ.
CauseName wordsOf(std::string_view constant, double from, double to) {
  int digits = 4;
  const auto words = [&](double value) { return fmt::format("{:.{}g}", value, digits); };
  while (digits < 12 && words(from) == words(to)) ++digits;
  return {std::string(constant), words(from), words(to)};
}

/// A constant in proportion, so that pairs of materials stay in theirs.
void takeConstant(ContactLaw& law, std::string_view name, double from, double to) {
  double& value = constantOf(law, name);
  value = from == 0.0 || value == from ? to : value * (to / from);
}

template <int D>
DifferenceOf<D> differenceOf(CauseName words, const Taken& taken, const ContactLaw& from,
                             const ContactLaw& to) {
  return {std::move(words), [taken, from, to](SceneOf<D>& scene) {
            changeLaws(scene, [&](ContactLaw& law) {
              for (const std::string_view option : taken.options)
                setLawOption(law, option, lawOptionValue(to, option));
              for (const std::string_view constant : taken.constants)
                takeConstant(law, constant, constantOf(from, constant), constantOf(to, constant));
            });
          }};
}

/// How many times as stiff a law is as the other, if that is all in which their constants differ;
/// 1: it is not.
double stiffnessBetween(const ContactLaw& from, const ContactLaw& to) {
  const double factor = from.kn > 0.0 ? to.kn / from.kn : 1.0;
  if (!differ(factor, 1.0)) return 1.0;
  const ContactLaw stiff = stiffened(from, factor);
  const bool is = std::ranges::all_of(lawConstants(), [&](const LawConstant& constant) {
    return std::abs(stiff.*constant.value - to.*constant.value) <=
           1e-9 * std::abs(to.*constant.value);
  });
  return is ? factor : 1.0;
}

bool bears(const ContactLaw& from, const ContactLaw& to, std::string_view option) {
  return bearsOnMirror(from, option) || bearsOnMirror(to, option);
}

}  // namespace

template <int D>
std::vector<DifferenceOf<D>> lawDifferences(const ContactLaw& from, const ContactLaw& to) {
  NameSet options, constants;
  for (const LawOption& option : lawOptions())
    if (option.get(from) != option.get(to) && bears(from, to, option.name))
      options.insert(option.name);
  for (const LawConstant& constant : lawConstants())
    if (differ(from.*constant.value, to.*constant.value) &&
        (hasPart(from, constant.part) || hasPart(to, constant.part)))
      constants.insert(constant.name);
  // Conventions of forces that a rigid law does not have.
  if (from.soft() != to.soft())
    std::erase_if(options, [](std::string_view name) { return isConvention(name); });

  std::vector<DifferenceOf<D>> found;
  for (const Group& group : groups()) {
    const bool euler = from.conventions.integrator == Integrator::semiImplicitEuler ||
                       to.conventions.integrator == Integrator::semiImplicitEuler;
    if (group.option == "integrator" && !euler) continue;
    if (options.erase(group.option) == 0) continue;
    Taken taken{{group.option}, {}};
    for (const std::string_view option : group.options)
      if (options.erase(option) > 0) taken.options.push_back(option);
    for (const std::string_view constant : group.constants)
      if (constants.erase(constant) > 0) taken.constants.push_back(constant);
    found.push_back(differenceOf<D>({nameOf(group, taken), lawOptionValue(from, group.option),
                                     lawOptionValue(to, group.option)},
                                    taken, from, to));
  }
  if (const double factor = stiffnessBetween(from, to); factor != 1.0 && !constants.empty()) {
    found.push_back(differenceOf<D>({"stiffness", "1", fmt::format("{:.4g}", factor)},
                                    {{}, {constants.begin(), constants.end()}}, from, to));
    constants.clear();
  }
  for (const LawOption& option : lawOptions())
    if (options.contains(option.name))
      found.push_back(
          differenceOf<D>({std::string(option.name), std::string(option.values[option.get(from)]),
                           std::string(option.values[option.get(to)])},
                          {{option.name}, {}}, from, to));
  for (const LawConstant& constant : lawConstants())
    if (constants.contains(constant.name))
      found.push_back(
          differenceOf<D>(wordsOf(constant.name, from.*constant.value, to.*constant.value),
                          {{}, {constant.name}}, from, to));
  return found;
}

template std::vector<DifferenceOf<2>> lawDifferences(const ContactLaw&, const ContactLaw&);
template std::vector<DifferenceOf<3>> lawDifferences(const ContactLaw&, const ContactLaw&);

template <int D>
std::vector<DifferenceOf<D>> differencesOf(const SceneOf<D>& from, const SceneOf<D>& to) {
  std::vector<DifferenceOf<D>> found = lawDifferences<D>(from.law, to.law);
  const auto add = [&](std::string name, std::string was, std::string is,
                       std::function<void(SceneOf<D>&)> take) {
    found.push_back({{std::move(name), std::move(was), std::move(is)}, std::move(take)});
  };
  if (from.rotation != to.rotation)
    add("rotation", to.rotation ? "blocked" : "free", to.rotation ? "free" : "blocked",
        [on = to.rotation](SceneOf<D>& scene) { scene.rotation = on; });
  const auto present = [](bool is) { return is ? "there" : "missing"; };
  if (from.bottom.has_value() != to.bottom.has_value())
    add("bottom_friction", present(from.bottom.has_value()), present(to.bottom.has_value()),
        [plate = to.bottom](SceneOf<D>& scene) { scene.bottom = plate; });
  if (from.bottom && to.bottom) {
    const BottomPlate &was = *from.bottom, &is = *to.bottom;
    if (was.spin != is.spin)
      add("bottom_spin_friction", present(was.spin), present(is.spin),
          [on = is.spin](SceneOf<D>& scene) { scene.bottom->spin = on; });
    const auto addConstant = [&](const char* name, double BottomPlate::*value) {
      if (differ(was.*value, is.*value))
        found.push_back(
            {wordsOf(name, was.*value, is.*value), [value, to = is.*value](SceneOf<D>& scene) {
               (*scene.bottom).*value = to;
             }});
    };
    for (const auto& [name, value] : plateConstants) addConstant(name, value);
    addConstant("plate gravity", &BottomPlate::gravity);
  }
  if (from.gravity.isZero() != to.gravity.isZero())
    add("gravity", present(!from.gravity.isZero()), present(!to.gravity.isZero()),
        [g = to.gravity](SceneOf<D>& scene) { scene.gravity = g; });
  if (from.materials.has_value() && !to.materials)
    add("pair_materials", "there", "missing", [](SceneOf<D>& scene) { scene.materials.reset(); });
  if (differ(from.dt, to.dt)) {
    // No soft contact is resolved in the steps of impulses.
    if (from.law.normal != to.law.normal) {
      found.front().take = [take = found.front().take, dt = to.dt](SceneOf<D>& scene) {
        take(scene);
        scene.dt = dt;
      };
      return found;
    }
    add("time step", fmt::format("{:.4g} s", from.dt), fmt::format("{:.4g} s", to.dt),
        [dt = to.dt](SceneOf<D>& scene) { scene.dt = dt; });
  }
  return found;
}
template std::vector<DifferenceOf<2>> differencesOf(const Scene&, const Scene&);
template std::vector<DifferenceOf<3>> differencesOf(const SpaceScene&, const SpaceScene&);

template <int D>
std::string fingerprintOf(SceneOf<D> scene) {
  std::string text = fmt::format("{} {} {}", scene.rotation, !scene.gravity.isZero(), scene.dt);
  changeLaws(scene, [&](const ContactLaw& law) {
    for (const LawOption& option : lawOptions()) text += fmt::format(" {}", option.get(law));
    for (const LawConstant& constant : lawConstants())
      text += fmt::format(" {}", law.*constant.value);
  });
  if (const auto& plate = scene.bottom)
    text += fmt::format(" {} {} {} {} {} {}", plate->mu, plate->kb, plate->gb, plate->tauM,
                        plate->gravity, plate->spin);
  return fmt::format("{:016x}", fnv1a(text));
}
template std::string fingerprintOf<2>(Scene);
template std::string fingerprintOf<3>(SpaceScene);

template <int D>
std::vector<AppliedChangeOf<D>> changesNamed(const NamedTerm* term, const SceneOf<D>& scene,
                                             const Capabilities& can) {
  std::vector<AppliedChangeOf<D>> found;
  if (term)
    for (MirrorChangeOf<D>& change : changesOf(scene, can))
      if (change.name == term->name)
        found.push_back({std::move(change), term->amount.value_or(0.0)});
  return found;
}
template std::vector<AppliedChange> changesNamed(const NamedTerm*, const Scene&,
                                                 const Capabilities&);
template std::vector<AppliedChangeOf<3>> changesNamed(const NamedTerm*, const SpaceScene&,
                                                      const Capabilities&);

namespace {

template <int D>
std::vector<CauseName> wordsOf(const std::vector<DifferenceOf<D>>& differences) {
  std::vector<CauseName> words;
  for (const DifferenceOf<D>& one : differences) words.push_back(one.words);
  return words;
}

/// In what the declared peer with those changes differs from a scene.
template <int D>
std::vector<DifferenceOf<D>> differencesWith(const SceneOf<D>& from, const SceneOf<D>& declared,
                                             const std::vector<AppliedChangeOf<D>>& changes) {
  std::vector<DifferenceOf<D>> all = differencesOf<D>(from, withChanges<D>(declared, changes));
  for (const AppliedChangeOf<D>& one : changes)
    if (differencesOf<D>(declared, withChanges<D>(declared, {one})).empty())  // of bodies
      all.push_back({wordsOf(one.change.name, 1.0, 1.0 + one.by),
                     [one](SceneOf<D>& scene) { one.change.apply(scene, one.by); }});
  return all;
}

}  // namespace

template <int D>
BehaviourOf<D> behaviourOf(const SceneOf<D>& from, const SceneOf<D>& declared,
                           const std::vector<AppliedChangeOf<D>>& changes) {
  BehaviourOf<D> found{
      withChanges(declared, changes), differencesWith(from, declared, changes), {}};
  found.causes.differences = wordsOf(found.differences);
  found.causes.undeclared = wordsOf(differencesWith(declared, declared, changes));
  const auto known = wordsOf(differencesOf<D>(from, declared));
  for (CauseName& one : found.causes.differences)
    one.declared = std::ranges::find(known, one) != known.end();
  for (CauseName& one : found.causes.undeclared) one.declared = false;
  return found;
}
template BehaviourOf<2> behaviourOf(const Scene&, const Scene&, const std::vector<AppliedChange>&);
template BehaviourOf<3> behaviourOf(const SpaceScene&, const SpaceScene&,
                                    const std::vector<AppliedChangeOf<3>>&);

}  // namespace crossgrain::inline studies
