#include "studies/cost/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cases/effect_switch.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cases/materials.hpp"
#include "cases/time_step.hpp"
#include "law/law_options.hpp"
#include "oracle/impact.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/effects/effects.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline studies {

double costContactTime(const Case& setup) {
  if (!setup.law.soft())
    throw BadInput(fmt::format("{}: a contact time is of a soft law: rigid bodies have none",
                               setup.file.string()));
  const Cost& cost = setup.cost;
  double fastest = 0.0, shortest = INFINITY;
  for (const PairImpacts& seen : cost.impacts) fastest = std::max(fastest, seen.fast);
  const double speed = cost.speed.value_or(fastest > 0.0 ? fastest : cost.quietSpeed);
  for (const ContactLaw& law : lawsOf(setup))
    shortest = std::min(
        shortest, impactTime(law, {lightestReducedMass(setup), flowDiameter(setup) / 4.0, speed}));
  return shortest;
}

double costStepUnit(const Case& setup) {
  return setup.law.soft() ? costContactTime(setup) : timeStep(setup);
}

std::string stepName(const Case& setup, double steps) {
  if (setup.law.soft()) return fmt::format("t_c/{:g}", steps);
  return steps > 1.0 ? fmt::format("dt/{:g}", steps) : fmt::format("{:g} dt", 1.0 / steps);
}

double engineStep(const Case& setup, const std::string& engine, const Capabilities& can) {
  const auto own = stepOfItsOwn(setup, engine, can);
  return own ? *own : timeStep(setup);
}

std::string stepFragment(const Case& setup, const std::string& engine, const Capabilities& can,
                         double steps) {
  const double dt = costStepUnit(setup) / steps;
  Case unset = setup;  // the fragment's step replaces that of [run]
  unset.run.dt.reset();
  if (stepOfItsOwn(unset, engine, can)) return fmt::format("[engines.{}]\ndt = {}\n", engine, dt);
  // The loader takes so few steps for a slip of the pen, and counts none in a contact time that
  // depends on the speed.
  if (steps < 2.0 || setup.law.stiffens() || !setup.law.soft())
    return fmt::format("[run]\ndt = {}\n", dt);
  return fmt::format("[run]\nsteps_per_contact = {:g}\n", steps);
}

namespace {

/// The case with a fragment merged in, which does not change what a run of the scene has shown.
Case withFragment(const Case& setup, const std::string& fragment) {
  Case changed = caseWith(setup, fragment);
  changed.cost.impacts = setup.cost.impacts;
  changed.cost.quietSpeed = setup.cost.quietSpeed;
  return changed;
}

}  // namespace

Case atSteps(const Case& setup, const std::string& engine, const Capabilities& can, double steps) {
  return withFragment(setup, stepFragment(setup, engine, can, steps));
}

CostPoint pointOf(const std::string& engine, const CostSetting& setting, CostKind kind, double dt) {
  CostPoint point;
  point.engine = engine;
  point.knob = setting.knob;
  point.setting = setting.setting;
  point.fragment = setting.fragment;
  point.kind = kind;
  if (dt > 0.0) point.dt = dt;
  if (setting.setup.law.soft()) point.stepsPerContact = costContactTime(setting.setup) / dt;
  return point;
}

void countWork(CostPoint& point, std::uint64_t steps, std::uint64_t contactEvaluations) {
  if (steps > 0) point.steps = steps;
  if (contactEvaluations > 0) point.contactEvaluations = contactEvaluations;
}

namespace {

/// List of settings that every knob adds to, with the data that it needs.
struct SettingList {
  const Case& setup;
  std::string engine;
  const Capabilities& can;
  const std::vector<double>& steps;  ///< per t_c
  std::vector<CostSetting> settings = {};

  CostSetting& add(const std::string& knob, const std::string& setting,
                   const std::string& fragment) {
    CostSetting one{knob, setting, fragment, setup};
    try {
      one.setup = withFragment(setup, fragment);
      one.refusal = switchRefusal(can, setup, {knob, "", {}, one.setup});
    } catch (const BadInput& refused) {  // a step beyond the time between snapshots, a law of
                                         // dashpots for a case without one
      one.refusal = refused.what();
    }
    return settings.emplace_back(std::move(one));
  }
};

/// Whether that is the step of rigid bodies' case as it is, which is first of all settings.
bool isOwnStep(const SettingList& to, double steps) {
  return !to.setup.law.soft() &&
         costStepUnit(to.setup) / steps == engineStep(to.setup, to.engine, to.can);
}

void addSteps(SettingList& to) {
  for (const double n : to.steps)
    if (!isOwnStep(to, n))
      to.add("time_step", stepName(to.setup, n), stepFragment(to.setup, to.engine, to.can, n));
}

/// Every other integrator at every step; one that the engine lacks is refused once, and one that
/// it always takes is what its time steps show.
void addIntegrators(SettingList& to) {
  const auto option = std::ranges::find(lawOptions(), "integrator", &LawOption::name);
  const auto own = to.can.lawOptions.find("integrator");
  for (const std::string_view value : option->values) {
    if (value == lawOptionValue(to.setup.law, "integrator")) continue;
    if (own != to.can.lawOptions.end() && own->second == std::vector{std::string(value)}) continue;
    const std::string law = fmt::format("[law]\nintegrator = \"{}\"\n", value);
    std::string& refusal = to.add("integrator", std::string(value), law).refusal;
    if (own == to.can.lawOptions.end()) refusal = "has no such option";
    if (!refusal.empty()) continue;
    to.settings.pop_back();
    for (const double n : to.steps)
      to.add("integrator", fmt::format("{}, t_c/{:g}", value, n),
             law + "\n" + stepFragment(to.setup, to.engine, to.can, n));
  }
}

void addPrecision(SettingList& to) {
  if (to.setup.run.precision == Precision::float64)
    to.add("precision", "float", "[run]\nprecision = \"float\"\n");
}

/// An engine's numbers of iterations, by name, with what it runs with; the first stands for how
/// well a step is solved.
std::vector<std::pair<const SettingSpec*, double>> iterationsOf(const SettingList& to) {
  std::vector<std::pair<const SettingSpec*, double>> found;
  const Settings said = settingsFor(to.setup, to.engine, to.can);
  for (const SettingSpec& spec : to.can.settings) {
    if (spec.role != SettingRole::iterations) continue;
    const auto own = said.find(spec.name);
    found.emplace_back(&spec,
                       std::get<double>(own == said.end() ? spec.defaultValue : own->second));
  }
  return found;
}

/// Whole multiples of a number of iterations, without itself.
std::vector<double> multiplesOf(double usual, const SettingSpec& spec,
                                const std::vector<double>& factors) {
  std::vector<double> values;
  for (const double factor : factors) {
    const double value = std::clamp(std::round(factor * usual), spec.least, spec.most);
    if (value != usual && std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

/// Values of the case; of rigid bodies also of what is declared as iterations, and these at other
/// steps, too: whether small steps or many iterations are worth their time is the question.
void addOwnSettings(SettingList& to) {
  const Cost& cost = to.setup.cost;
  std::map<std::string, std::vector<double>> own;
  if (const auto given = cost.settings.find(to.engine); given != cost.settings.end())
    own = given->second;
  const auto add = [&](const std::string& name, double value, const std::string& step = "",
                       const std::string& fragment = "") {
    const std::string section = fmt::format("[engines.{}]\n", to.engine);
    const bool inSection = fragment.starts_with(section);
    const CostSetting& one =
        to.add(name, fmt::format("{} = {:g}{}{}", name, value, step.empty() ? "" : ", ", step),
               fmt::format("{}{}{} = {}\n", fragment,
                           inSection          ? ""
                           : fragment.empty() ? section
                                              : "\n" + section,
                           name, value));
    settingsFor(one.setup, to.engine, to.can);  // throws for one that it does not have
  };
  const auto iterations =
      to.setup.law.soft() ? std::vector<std::pair<const SettingSpec*, double>>{} : iterationsOf(to);
  for (const auto& [spec, usual] : iterations)
    if (!own.contains(spec->name)) own[spec->name] = multiplesOf(usual, *spec, cost.iterations);
  for (const auto& [name, values] : own)
    for (const double value : values) {
      add(name, value);
      if (iterations.empty() || iterations.front().first->name != name) continue;
      double most = 1.0;
      for (const auto& list : {to.steps, cost.iterations})
        for (const double factor : list) most = std::max(most, factor);
      for (const double n : to.steps)
        if (!isOwnStep(to, n) && n * value <= most * iterations.front().second)
          add(name, value, stepName(to.setup, n), stepFragment(to.setup, to.engine, to.can, n));
    }
}

void addLaw(SettingList& to, const std::string& option, const std::vector<std::string>& values) {
  for (const std::string& value : values)
    if (value != lawOptionValue(to.setup.law, option))
      to.add(option, value, fmt::format("[law]\n{} = \"{}\"\n", option, value));
}

void addEffects(SettingList& to) {
  for (const EffectSwitch& off : effectSwitches(to.setup)) {
    if (!off.effect) continue;  // tension and precision are knobs of their own
    to.add("effect:" + off.name, "without " + off.name, off.fragment).refusal =
        switchRefusal(to.can, to.setup, off);
  }
}

using enum CostKind;

/// In the order of the results. What an integrator does to averages is far below what packings
/// scatter, and two disks that collide head on once show no effect.
const struct Knob {
  std::string_view name;
  std::vector<CostKind> kinds;  ///< of error that it may change
  void (*add)(SettingList&);
  bool ofSoftLaws = false;
} knobs[] = {
    {"time_step", {collision, trajectory, averages}, addSteps},
    {"integrator", {collision, trajectory}, addIntegrators, true},
    {"precision", {collision, trajectory, averages}, addPrecision},
    {"settings", {collision, trajectory, averages}, addOwnSettings},
    {"tangential",
     {collision, averages},
     [](SettingList& to) { addLaw(to, "tangential", to.setup.cost.tangential); },
     true},
    {"tension",
     {collision, averages},
     [](SettingList& to) {
       addLaw(to, "tension", {"allow", "cut"});
     },
     true},
    // Without an effect of its rigid scene a closed form is of another one.
    {"effects", {averages}, addEffects, true},
};

}  // namespace

std::vector<CostSetting> costSettings(const Case& setup, CostKind kind, const std::string& engine,
                                      const Capabilities& can) {
  const Cost& cost = setup.cost;
  SettingList list{setup, engine, can,
                   kind == collision    ? cost.collisionSteps
                   : kind == trajectory ? cost.trajectorySteps
                   : setup.law.soft()   ? cost.averageSteps
                                        : cost.rigidSteps};
  list.add("time_step", "the case's own", "");
  for (const Knob& knob : knobs)
    if (cost.has(knob.name) && (setup.law.soft() || !knob.ofSoftLaws) &&
        std::ranges::find(knob.kinds, kind) != knob.kinds.end())
      knob.add(list);
  return std::move(list.settings);
}

}  // namespace crossgrain::inline studies
