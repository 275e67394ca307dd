#include "runs/cost/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "adapters/law_options.hpp"
#include "cases/effect_switch.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/engine_step.hpp"
#include "runs/effects/effects.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline runs {

std::string toString(CostKind kind) {
  constexpr const char* names[] = {"collision", "trajectory", "averages"};
  return names[static_cast<int>(kind)];
}

double costContactTime(const Case& setup) {
  if (setup.law.normal != NormalLaw::linear)
    throw BadInput(fmt::format("{}: cost counts steps in the contact time of a linear law",
                               setup.file.string()));
  return contactTime(setup.law, lightestReducedMass(setup));
}

int snapshotsPerRotation(const Case& setup, double every) {
  return std::max(1, static_cast<int>(std::lround(setup.averaging.snapshotsPerRotation / every)));
}

double engineStep(const Case& setup, const std::string& engine, const Capabilities& can) {
  const auto own = stepOfItsOwn(setup, engine, can);
  return own ? *own : timeStep(setup);
}

std::string integratorOf(const CostSetting& setting) {
  return setting.knob == "integrator" ? setting.setting.substr(0, setting.setting.find(',')) : "";
}

CostPoint pointOf(const std::string& engine, const CostSetting& setting, CostKind kind, double dt) {
  CostPoint point;
  point.engine = engine;
  point.knob = setting.knob;
  point.setting = setting.setting;
  point.fragment = setting.fragment;
  point.errorKind = toString(kind);
  point.dt = dt;
  point.stepsPerContact = costContactTime(setting.setup) / dt;
  return point;
}

namespace {

class SettingList {
 public:
  SettingList(const Case& setup, std::string engine, const Capabilities& can,
              const CaseWith& caseWith)
      : setup_(setup), engine_(std::move(engine)), can_(can), caseWith_(caseWith) {}

  void add(const std::string& knob, const std::string& setting, const std::string& fragment) {
    CostSetting one{knob, setting, fragment, caseWith_(fragment), {}};
    one.refusal = switchRefusal(can_, setup_, {knob, "", {}, one.setup});
    settings.push_back(std::move(one));
  }

  void addSteps(const std::vector<double>& steps) {
    for (const double n : steps)
      add("time_step", fmt::format("t_c/{:g}", n), stepFragment(setup_, engine_, can_, n));
  }

  /// Every other integrator at every step; one that the engine lacks is refused once, and one that
  /// it always takes is what its time steps show.
  void addIntegrators(const std::vector<double>& steps) {
    const auto option = std::ranges::find(lawOptions(), "integrator", &LawOption::name);
    const auto own = can_.lawOptions.find("integrator");
    for (const std::string_view value : option->values) {
      if (value == lawOptionValue(setup_.law, "integrator")) continue;
      if (own != can_.lawOptions.end() && own->second == std::vector{std::string(value)}) continue;
      const std::string law = fmt::format("[law]\nintegrator = \"{}\"\n", value);
      add("integrator", std::string(value), law);
      std::string& refusal = settings.back().refusal;
      if (own == can_.lawOptions.end()) refusal = "has no such option";
      if (!refusal.empty()) continue;
      settings.pop_back();
      for (const double n : steps)
        add("integrator", fmt::format("{}, t_c/{:g}", value, n),
            law + "\n" + stepFragment(setup_, engine_, can_, n));
    }
  }

  void addPrecision() {
    if (setup_.run.precision == Precision::float64)
      add("precision", "float", "[run]\nprecision = \"float\"\n");
  }

  void addLaw(const std::string& option, const std::vector<std::string>& values) {
    for (const std::string& value : values)
      if (value != lawOptionValue(setup_.law, option))
        add(option, value, fmt::format("[law]\n{} = \"{}\"\n", option, value));
  }

  void addOwnSettings() {
    const auto own = setup_.cost.settings.find(engine_);
    if (own == setup_.cost.settings.end()) return;
    for (const auto& [name, values] : own->second)
      for (const double value : values) {
        add(name, fmt::format("{} = {:g}", name, value),
            fmt::format("[engines.{}]\n{} = {}\n", engine_, name, value));
        settingsFor(settings.back().setup, engine_, can_);  // throws for one that it does not have
      }
  }

  void addSampling() {
    const Averaging& averaging = setup_.averaging;
    if (wants("method"))
      for (const std::string& method : setup_.cost.methods)
        if (method != averaging.methods.front())
          add("method", method, fmt::format("[averaging]\nmethod = \"{}\"\n", method));
    if (wants("snapshots"))
      for (const double every : setup_.cost.snapshots) {
        const int number = snapshotsPerRotation(setup_, every);
        add("snapshots", fmt::format("{} per rotation", number),
            fmt::format("[averaging]\nsnapshots_per_rotation = {}\n", number));
      }
  }

  void addScales() {
    if (wants("omega"))
      for (const double factor : setup_.cost.omega)
        add("omega", fmt::format("{:g} Ω", factor),
            fmt::format("[cell]\nomega = {}\n", setup_.cell.omega * factor));
    if (wants("stiffness"))
      for (const double factor : setup_.cost.stiffness) addStiffness(factor);
  }

  /// Softer disks of the same restitution: dashpots by the root, and with them the step.
  void addStiffness(double factor) {
    const ContactLaw& law = setup_.law;
    const double root = law.damper == Damper::constant       ? std::sqrt(factor)
                        : law.damper == Damper::viscoelastic ? 1.0 / std::sqrt(factor)
                                                             : 1.0;
    add("stiffness", fmt::format("{:g} k_n", factor),
        fmt::format("[law]\nkn = {}\nkt = {}\ngn = {}\ngt = {}\n\n{}", law.kn * factor,
                    law.kt * factor, law.gn * root, law.gt * root,
                    stepOfItsOwn(setup_, engine_, can_)
                        ? std::string()
                        : fmt::format("[run]\ndt = {}\n", timeStep(setup_) / std::sqrt(factor))));
  }

  void addEffects() {
    for (const EffectSwitch& off : effectSwitches(setup_)) {
      if (!off.effect) continue;  // tension and precision are knobs of their own
      add("effect:" + off.name, "without " + off.name, off.fragment);
      settings.back().refusal = switchRefusal(can_, setup_, off);
    }
  }

  bool wants(const char* knob) const {
    return std::ranges::find(setup_.cost.knobs, knob) != setup_.cost.knobs.end();
  }

  std::vector<CostSetting> settings;

 private:
  const Case& setup_;
  std::string engine_;
  const Capabilities& can_;
  const CaseWith& caseWith_;
};

}  // namespace

std::string stepFragment(const Case& setup, const std::string& engine, const Capabilities& can,
                         double steps) {
  const double dt = costContactTime(setup) / steps;
  Case unsaid = setup;  // the fragment's step replaces that of [run]
  unsaid.run.dt.reset();
  if (stepOfItsOwn(unsaid, engine, can)) return fmt::format("[engines.{}]\ndt = {}\n", engine, dt);
  // The loader takes so few steps for a slip of the pen.
  if (steps < 2.0) return fmt::format("[run]\ndt = {}\n", dt);
  return fmt::format("[run]\nsteps_per_contact = {:g}\n", steps);
}

std::vector<CostSetting> costSettings(const Case& setup, CostKind kind, const std::string& engine,
                                      const Capabilities& can, const CaseWith& caseWith) {
  const Cost& cost = setup.cost;
  const auto& steps = kind == CostKind::collision    ? cost.collisionSteps
                      : kind == CostKind::trajectory ? cost.trajectorySteps
                                                     : cost.averageSteps;
  SettingList list(setup, engine, can, caseWith);
  list.add("time_step", "the case's own", "");
  if (list.wants("time_step")) list.addSteps(steps);
  if (list.wants("integrator") && kind != CostKind::averages) list.addIntegrators(steps);
  if (list.wants("precision")) list.addPrecision();
  if (list.wants("settings")) list.addOwnSettings();
  if (kind == CostKind::trajectory) return std::move(list.settings);
  if (list.wants("tangential")) list.addLaw("tangential", cost.tangential);
  if (list.wants("tension")) list.addLaw("tension", {"allow", "cut"});
  if (kind == CostKind::collision) return std::move(list.settings);
  list.addSampling();
  list.addScales();
  if (list.wants("effects")) list.addEffects();
  return std::move(list.settings);
}

}  // namespace crossgrain::inline runs
