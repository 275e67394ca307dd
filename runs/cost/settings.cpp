#include "runs/cost/settings.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "cases/cost_knobs.hpp"
#include "cases/effect_switch.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/effects/effects.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline runs {

double costContactTime(const Case& setup) {
  if (!setup.law.soft())
    throw BadInput(
        fmt::format("{}: cost counts steps in the contact time of a soft law: rigid disks "
                    "have none",
                    setup.file.string()));
  return impactTime(
      setup.law, {lightestReducedMass(setup), setup.particles.smallRadius / 2.0, setup.cost.speed});
}

int snapshotsPerRotation(const Case& setup, double every) {
  return std::max(1, static_cast<int>(std::lround(setup.averaging.snapshotsPerRotation / every)));
}

double engineStep(const Case& setup, const std::string& engine, const Capabilities& can) {
  const auto own = stepOfItsOwn(setup, engine, can);
  return own ? *own : timeStep(setup);
}

bool CostSetting::isSampling() const {
  const CostKnob* const known = findCostKnob(knob);
  return known && known->sameRun;
}

CostPoint pointOf(const std::string& engine, const CostSetting& setting, CostKind kind, double dt) {
  CostPoint point;
  point.engine = engine;
  point.knob = setting.knob;
  point.setting = setting.setting;
  point.fragment = setting.fragment;
  point.kind = kind;
  if (dt > 0.0) point.dt = dt;
  point.stepsPerContact = costContactTime(setting.setup) / dt;
  return point;
}

void countWork(CostPoint& point, std::uint64_t steps, std::uint64_t contactEvaluations) {
  if (steps > 0) point.steps = steps;
  if (contactEvaluations > 0) point.contactEvaluations = contactEvaluations;
}

namespace {

/// What knobs have in common when they say what their settings are.
struct SettingsSoFar {
  const Case& setup;
  std::string engine;
  const Capabilities& can;
  CostKind kind;
  std::vector<double> steps;  ///< per t_c, those of time_step
  std::vector<CostSetting> list = {};

  CostSetting& add(const std::string& knob, const std::string& setting,
                   const std::string& fragment) {
    CostSetting one{knob, setting, fragment, caseWith(setup, fragment), {}, false, false};
    one.refusal = switchRefusal(can, setup, {knob, "", {}, one.setup});
    return list.emplace_back(std::move(one));
  }
  const std::vector<double>& numbers(const char* knob) const { return setup.cost.numbers.at(knob); }
  const std::vector<std::string>& texts(const char* knob) const {
    return setup.cost.texts.at(knob);
  }
};

void addSteps(SettingsSoFar& to) {
  for (const double n : to.steps)
    to.add("time_step", fmt::format("t_c/{:g}", n), stepFragment(to.setup, to.engine, to.can, n));
}

/// Of what whole runs would take too long with. An engine with another normal law has no bound.
void boundOnly(const SettingsSoFar& to, CostSetting& setting) {
  setting.windowsOnly = true;
  if (setting.refusal.empty() && !hasNormalLaw(to.can, to.setup.law))
    setting.refusal = "has another normal law in place of the case's: nothing bounds its averages";
}

void addBoundSteps(SettingsSoFar& to) {
  for (const double n : to.setup.cost.boundSteps) {
    if (std::ranges::find(to.steps, n) != to.steps.end()) continue;
    boundOnly(to, to.add("time_step", fmt::format("t_c/{:g}", n),
                         stepFragment(to.setup, to.engine, to.can, n)));
    to.steps.push_back(n);
  }
}

/// Every other integrator at every step; one that the engine lacks is refused once, and one that
/// it always takes is what its time steps show. Of averages they are bounded alone, as small steps
/// are: an integrator's part in them is far below what packings scatter.
void addIntegrators(SettingsSoFar& to) {
  const auto option = std::ranges::find(lawOptions(), "integrator", &LawOption::name);
  const auto own = to.can.lawOptions.find("integrator");
  for (const std::string_view value : option->values) {
    if (value == lawOptionValue(to.setup.law, "integrator")) continue;
    if (own != to.can.lawOptions.end() && own->second == std::vector{std::string(value)}) continue;
    const std::string law = fmt::format("[law]\nintegrator = \"{}\"\n", value);
    std::string& refusal = to.add("integrator", std::string(value), law).refusal;
    if (own == to.can.lawOptions.end()) refusal = "has no such option";
    if (!refusal.empty()) continue;
    to.list.pop_back();
    for (const double n : to.steps) {
      CostSetting& one = to.add("integrator", fmt::format("{}, t_c/{:g}", value, n),
                                law + "\n" + stepFragment(to.setup, to.engine, to.can, n));
      if (to.kind == CostKind::averages) boundOnly(to, one);
    }
  }
}

void addPrecision(SettingsSoFar& to) {
  if (to.setup.run.precision == Precision::float64)
    to.add("precision", "float", "[run]\nprecision = \"float\"\n");
}

void addOwnSettings(SettingsSoFar& to) {
  const auto own = to.setup.cost.settings.find(to.engine);
  if (own == to.setup.cost.settings.end()) return;
  for (const auto& [name, values] : own->second)
    for (const double value : values) {
      const CostSetting& one =
          to.add(name, fmt::format("{} = {:g}", name, value),
                 fmt::format("[engines.{}]\n{} = {}\n", to.engine, name, value));
      settingsFor(one.setup, to.engine, to.can);  // throws for one that it does not have
    }
}

void addLaw(SettingsSoFar& to, const std::string& option, const std::vector<std::string>& values) {
  for (const std::string& value : values) {
    if (value == lawOptionValue(to.setup.law, option)) continue;
    const std::string fragment = fmt::format("[law]\n{} = \"{}\"\n", option, value);
    try {
      to.add(option, value, fragment);
    } catch (const BadInput& lacking) {  // a case without a dashpot, asked for a law of dashpots
      to.list.push_back({option, value, fragment, to.setup, lacking.what(), false, false});
    }
  }
}

void addTangential(SettingsSoFar& to) {
  addLaw(to, "tangential", to.texts("tangential"));
}

void addTension(SettingsSoFar& to) {
  addLaw(to, "tension", {"allow", "cut"});
}

void addMethods(SettingsSoFar& to) {
  for (const std::string& method : to.texts("method"))
    if (method != to.setup.averaging.methods.front())
      to.add("method", method, fmt::format("[averaging]\nmethod = \"{}\"\n", method));
}

void addSnapshots(SettingsSoFar& to) {
  for (const double every : to.numbers("snapshots")) {
    const int number = snapshotsPerRotation(to.setup, every);
    to.add("snapshots", fmt::format("{} per rotation", number),
           fmt::format("[averaging]\nsnapshots_per_rotation = {}\n", number));
  }
}

void addOmega(SettingsSoFar& to) {
  for (const double factor : to.numbers("omega"))
    to.add("omega", fmt::format("{:g} Ω", factor),
           fmt::format("[cell]\nomega = {}\n", to.setup.cell.omega * factor));
}

/// The constants of the case's law as its file has them: stiffnesses times a factor, dashpots times
/// another.
std::string lawTimes(const Case& setup, double stiffer, double damped) {
  const toml::table document = toml::parse(setup.resolvedToml);
  const auto times = [](const toml::node& number, double factor) {
    return fmt::format("{}", factor * number.value<double>().value());
  };
  std::string fragment = "[law]\n";
  for (const auto& [key, node] : *document["law"].as_table()) {
    const std::string_view name = key.str();
    const bool stiffness =
        name == "kn" || name == "kt" || name == "young" || name == "k2" || name == "k3";
    if (!stiffness && name != "gn" && name != "gt") continue;
    const double factor = stiffness ? stiffer : damped;
    if (const toml::array* const both = node.as_array())
      fragment += fmt::format("{} = [{}, {}]\n", name, times((*both)[0], factor),
                              times((*both)[1], factor));
    else
      fragment += fmt::format("{} = {}\n", name, times(node, factor));
  }
  return fragment;
}

/// Softer disks of the same restitution: dashpots by the root, and with them the step.
void addStiffness(SettingsSoFar& to) {
  const ContactLaw& law = to.setup.law;
  for (const double factor : to.numbers("stiffness")) {
    const double root = law.damper == Damper::constant       ? std::sqrt(factor)
                        : law.damper == Damper::viscoelastic ? 1.0 / std::sqrt(factor)
                                                             : 1.0;
    to.add("stiffness", fmt::format("{:g} k_n", factor),
           lawTimes(to.setup, factor, root) +
               (stepOfItsOwn(to.setup, to.engine, to.can)
                    ? std::string()
                    : fmt::format("\n[run]\ndt = {}\n", timeStep(to.setup) / std::sqrt(factor))));
  }
}

void addEffects(SettingsSoFar& to) {
  for (const EffectSwitch& off : effectSwitches(to.setup)) {
    if (!off.effect) continue;  // tension and precision are knobs of their own
    to.add("effect:" + off.name, "without " + off.name, off.fragment).refusal =
        switchRefusal(to.can, to.setup, off);
  }
}

/// What the settings of each knob are (cases/cost_knobs.hpp), in the order of the results.
constexpr std::pair<std::string_view, void (*)(SettingsSoFar&)> settingsOfKnobs[] = {
    {"time_step", addSteps},      {"integrator", addIntegrators}, {"precision", addPrecision},
    {"settings", addOwnSettings}, {"tangential", addTangential},  {"tension", addTension},
    {"method", addMethods},       {"snapshots", addSnapshots},    {"omega", addOmega},
    {"stiffness", addStiffness},  {"effects", addEffects}};

}  // namespace

std::string stepFragment(const Case& setup, const std::string& engine, const Capabilities& can,
                         double steps) {
  const double dt = costContactTime(setup) / steps;
  Case unsaid = setup;  // the fragment's step replaces that of [run]
  unsaid.run.dt.reset();
  if (stepOfItsOwn(unsaid, engine, can)) return fmt::format("[engines.{}]\ndt = {}\n", engine, dt);
  // The loader takes so few steps for a slip of the pen, and counts none in a contact time that
  // depends on the speed.
  if (steps < 2.0 || setup.law.stiffens()) return fmt::format("[run]\ndt = {}\n", dt);
  return fmt::format("[run]\nsteps_per_contact = {:g}\n", steps);
}

std::vector<CostSetting> costSettings(const Case& setup, CostKind kind, const std::string& engine,
                                      const Capabilities& can) {
  const Cost& cost = setup.cost;
  const auto& steps = kind == CostKind::collision    ? cost.collisionSteps
                      : kind == CostKind::trajectory ? cost.trajectorySteps
                                                     : cost.averageSteps;
  SettingsSoFar settings{setup, engine, can, kind, steps};
  settings.add("time_step", "the case's own", "").sameLaw = true;
  for (const auto& [name, add] : settingsOfKnobs) {
    const CostKnob& knob = *findCostKnob(name);
    if (std::ranges::find(cost.knobs, name) == cost.knobs.end() ||
        std::ranges::find(knob.kinds, kind) == knob.kinds.end())
      continue;
    const std::size_t before = settings.list.size();
    add(settings);
    if (name == "time_step" && kind == CostKind::averages) addBoundSteps(settings);
    for (std::size_t k = before; k < settings.list.size(); ++k)
      settings.list[k].sameLaw = knob.sameLaw;
  }
  return std::move(settings.list);
}

}  // namespace crossgrain::inline runs
