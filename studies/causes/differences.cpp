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

template <class Setup>
Difference<Setup> differenceOf(CauseName words, const Taken& taken, const ContactLaw& from,
                               const ContactLaw& to) {
  return {std::move(words), [taken, from, to](Setup& setup) {
            changeLaws(setup, [&](ContactLaw& law) {
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

template <class Setup>
std::vector<Difference<Setup>> lawDifferences(const ContactLaw& from, const ContactLaw& to) {
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

  std::vector<Difference<Setup>> found;
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
    found.push_back(differenceOf<Setup>({nameOf(group, taken), lawOptionValue(from, group.option),
                                         lawOptionValue(to, group.option)},
                                        taken, from, to));
  }
  if (const double factor = stiffnessBetween(from, to); factor != 1.0 && !constants.empty()) {
    found.push_back(differenceOf<Setup>({"stiffness", "1", fmt::format("{:.4g}", factor)},
                                        {{}, {constants.begin(), constants.end()}}, from, to));
    constants.clear();
  }
  for (const LawOption& option : lawOptions())
    if (options.contains(option.name))
      found.push_back(differenceOf<Setup>(
          {std::string(option.name), std::string(option.values[option.get(from)]),
           std::string(option.values[option.get(to)])},
          {{option.name}, {}}, from, to));
  for (const LawConstant& constant : lawConstants())
    if (constants.contains(constant.name))
      found.push_back(
          differenceOf<Setup>(wordsOf(constant.name, from.*constant.value, to.*constant.value),
                              {{}, {constant.name}}, from, to));
  return found;
}

template std::vector<Difference<Case>> lawDifferences(const ContactLaw&, const ContactLaw&);

namespace {

auto& rotationOf(auto& setup) {
  if constexpr (requires { setup.rotation; })
    return setup.rotation;
  else if (isAssembly(setup))
    return withAssembly(
        setup, [](auto& assembly) -> auto& { return assembly.rotation; });
  else
    return couetteIn(setup).particles.rotation;
}

/// Calls work(gravity) where there can be any in the plane or the space of the bodies.
void withGravity(auto& setup, auto&& work) {
  if constexpr (requires { setup.gravity; })
    work(setup.gravity);
  else if (isAssembly(setup))
    withAssembly(setup, [&](auto& assembly) { work(assembly.gravity); });
}

bool falls(const auto& setup) {
  bool any = false;
  withGravity(setup, [&](const auto& gravity) { any = !gravity.isZero(); });
  return any;
}

/// Settings of the in-house engine have a case's step.
auto& timeStepIn(auto& setup) {
  if constexpr (requires { setup.dt; })
    return setup.dt;
  else
    return std::get<double>(setup.engines.at(engineRegistry().front().name).at("dt"));
}

}  // namespace

template <class Setup>
std::vector<Difference<Setup>> differencesOf(const Setup& from, const Setup& to) {
  std::vector<Difference<Setup>> found = lawDifferences<Setup>(from.law, to.law);
  const auto add = [&](std::string name, std::string was, std::string is,
                       std::function<void(Setup&)> take) {
    found.push_back({{std::move(name), std::move(was), std::move(is)}, std::move(take)});
  };
  if (const bool on = rotationOf(to); on != rotationOf(from))
    add("rotation", on ? "blocked" : "free", on ? "free" : "blocked",
        [on](Setup& setup) { rotationOf(setup) = on; });
  if (from.bottom != to.bottom)
    add(to.bottom ? "bottom_spin_friction" : "bottom_friction", "there", "missing",
        [plate = to.bottom](Setup& setup) { setup.bottom = plate; });
  if (falls(from) != falls(to))
    add("gravity", "there", "missing",
        [](Setup& setup) { withGravity(setup, [](auto& gravity) { gravity.setZero(); }); });
  if (from.materials.has_value() && !to.materials)
    add("pair_materials", "there", "missing", [](Setup& setup) { setup.materials.reset(); });
  if (const double dt = timeStepIn(to); differ(timeStepIn(from), dt)) {
    // No soft contact is resolved in the steps of impulses.
    if (from.law.normal != to.law.normal) {
      found.front().take = [take = found.front().take, dt](Setup& setup) {
        take(setup);
        timeStepIn(setup) = dt;
      };
      return found;
    }
    add("time step", fmt::format("{:.4g} s", timeStepIn(from)), fmt::format("{:.4g} s", dt),
        [dt](Setup& setup) { timeStepIn(setup) = dt; });
  }
  return found;
}
template std::vector<Difference<Scene>> differencesOf(const Scene&, const Scene&);
template std::vector<Difference<SpaceScene>> differencesOf(const SpaceScene&, const SpaceScene&);
template std::vector<Difference<Case>> differencesOf(const Case&, const Case&);

std::string fingerprintOf(const Case& setup) {
  std::string text = fmt::format("{} {} {}", rotationOf(setup), falls(setup), timeStepIn(setup));
  Case own = setup;
  changeLaws(own, [&](const ContactLaw& law) {
    for (const LawOption& option : lawOptions()) text += fmt::format(" {}", option.get(law));
    for (const LawConstant& constant : lawConstants())
      text += fmt::format(" {}", law.*constant.value);
  });
  if (const auto& plate = setup.bottom)
    text += fmt::format(" {} {} {} {} {} {}", plate->mu, plate->kb, plate->gb, plate->tauM,
                        plate->gravity, plate->spin);
  return fmt::format("{:016x}", fnv1a(text));
}

namespace {

/// In what the declared peer with those changes differs from a scene.
template <int D>
std::vector<Difference<SceneOf<D>>> differencesWith(
    const SceneOf<D>& from, const SceneOf<D>& declared,
    const std::vector<AppliedChangeOf<D>>& changes) {
  std::vector<Difference<SceneOf<D>>> all = differencesOf(from, withChanges(declared, changes));
  for (const AppliedChangeOf<D>& one : changes)
    if (differencesOf(declared, withChanges<D>(declared, {one})).empty())  // of bodies
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
  found.causes = causesOf(found.differences);
  found.causes.undeclared = causesOf(differencesWith(declared, declared, changes)).differences;
  const auto known = causesOf(differencesOf(from, declared)).differences;
  for (CauseName& one : found.causes.differences)
    one.declared = std::ranges::find(known, one) != known.end();
  for (CauseName& one : found.causes.undeclared) one.declared = false;
  return found;
}
template BehaviourOf<2> behaviourOf(const Scene&, const Scene&, const std::vector<AppliedChange>&);
template BehaviourOf<3> behaviourOf(const SpaceScene&, const SpaceScene&,
                                    const std::vector<AppliedChangeOf<3>>&);

void addFindings(Causes& causes, const Attribution& found) {
  causes.mixtures = found.mixtures;
  for (const Attribution::Pair& pair : found.pairs)
    causes.interactions.push_back(
        {causes.differences[pair.one].name, causes.differences[pair.other].name, pair.share});
  for (const Attribution::Step& step : found.path)
    causes.path.push_back({causes.differences[step.taken].name, step.left});
  causes.runs += found.runs;
}

}  // namespace crossgrain::inline studies
