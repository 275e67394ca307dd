#include "studies/lockstep/terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "adapters/suitability.hpp"
#include "cases/materials.hpp"
#include "law/law_options.hpp"
#include "studies/lockstep/rules.hpp"

namespace crossgrain::inline studies {
namespace {

template <int D>
void addConstants(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene) {
  const auto add = [&](std::string name, std::function<void(SceneOf<D>&, double)> apply) {
    changes.push_back({std::move(name), true, std::move(apply)});
  };
  for (const LawConstant& constant : lawConstants())
    if (scene.law.*constant.value != 0.0 && hasPart(scene.law, constant.part))
      add(std::string(constant.name), [value = constant.value](SceneOf<D>& changed, double by) {
        changeLaws(changed, [&](ContactLaw& law) { law.*value *= 1.0 + by; });
      });
  const std::pair<const char*, double BottomPlate::*> plate[] = {
      {"plate mu", &BottomPlate::mu},
      {"plate kb", &BottomPlate::kb},
      {"plate gb", &BottomPlate::gb},
      {"plate tau_m", &BottomPlate::tauM}};
  if (scene.bottom)
    for (const auto& [name, value] : plate)
      if ((*scene.bottom).*value != 0.0)
        add(name, [value = value](SceneOf<D>& changed, double by) {
          (*changed.bottom).*value *= 1.0 + by;
        });
  add("mass", [](SceneOf<D>& changed, double by) {
    for (double& mass : changed.disks.mass) mass *= 1.0 + by;
  });
  if (scene.rotation)
    add("inertia", [](SceneOf<D>& changed, double by) {
      for (double& inertia : changed.disks.inertia) inertia *= 1.0 + by;
    });
  add("velocity of walls", [](SceneOf<D>& changed, double by) {
    for (WallBodyOf<D>& body : changed.bodies) {
      body.motion.angularVelocity *= 1.0 + by;
      body.motion.velocity *= 1.0 + by;
      body.motion.frequency *= 1.0 + by;
    }
  });
}

template <int D>
void addConventions(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene,
                    const Capabilities& can) {
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (!bearsOnMirror(scene.law, name)) continue;
    const auto values = can.lawOptions.find(name);
    if (values == can.lawOptions.end()) continue;
    for (const std::string& value : values->second)
      if (value != lawOptionValue(scene.law, name) && constantsServe(scene.law, name, value))
        changes.push_back({fmt::format("{} = {}", name, value), false,
                           [name, value](SceneOf<D>& changed, double) {
                             changeLaws(changed,
                                        [&](ContactLaw& law) { setLawOption(law, name, value); });
                           }});
  }
}

template <int D>
void addMissingEffects(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene,
                       Capabilities can) {
  for (const Effect effect : effectsOf(scene)) {
    const std::string name = toString(effect);
    can.effects[effect] = Support::never;
    changes.push_back({"without " + name, false, [can, name](SceneOf<D>& changed, double) {
                         changed = adaptScene(can, changed, {name}).scene;
                       }});
    can.effects[effect] = Support::optional;
  }
}

double dot(const std::vector<double>& one, const std::vector<double>& other) {
  return std::inner_product(one.begin(), one.end(), other.begin(), 0.0);
}

}  // namespace

bool bearsOnMirror(const ContactLaw& law, std::string_view option) {
  if (option == "velocity_arm") return mattersTo(law, "lever_arm");
  if (option == "damping_velocity" && law.soft() && (law.friction() || law.rolls())) return true;
  return mattersTo(law, option);
}

bool constantsServe(const ContactLaw& law, std::string_view option, std::string_view value) {
  if (option == "normal" || option == "damper" || option == "rolling_damper") return false;
  const bool perRadian = law.conventions.rollingStiffness == RollingStiffness::constant;
  if (option == "rolling_stiffness") return (value == "constant") == perRadian;
  if (option == "rolling") {
    if (value == "none") return false;
    if (value == "spring" && !(law.kr > 0.0)) return false;
    if (value == "viscous")
      return law.gr > 0.0 && law.conventions.rollingDamper == RollingDamper::constant;
    return law.muR > 0.0 &&
           (value == "viscous_by_load") == (law.rolling == RollingLaw::viscousByLoad);
  }
  if (option == "cohesion")
    return law.w > 0.0 && (value == "dmt" || (value == "jkr" && law.normal == NormalLaw::hertz));
  return true;
}

template <int D>
std::vector<MirrorChangeOf<D>> changesOf(const SceneOf<D>& scene, const Capabilities& can) {
  std::vector<MirrorChangeOf<D>> changes;
  addConstants(changes, scene);
  addConventions(changes, scene, can);
  addMissingEffects(changes, scene, can);
  return changes;
}

std::string referencePerturbationOf(const ContactLaw& law) {
  return law.soft() ? "kn" : "en";
}

LockstepRules lockstepRules(const ContactLaw& law) {
  return {lockstepRounding, lockstepSameLaw, std::ranges::max(referencePerturbations),
          referencePerturbationOf(law), strayShare};
}

void changeReference(ContactLaw& law, double by) {
  (law.soft() ? law.kn : law.en) *= 1.0 + by;
}

std::vector<double> proportionalRates(const std::vector<double>& responses) {
  const std::size_t disks = responses.size() / referencePerturbations.size();
  std::vector<double> rates(disks, 0.0);
  std::size_t moved = 0, alike = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < disks; ++i) {
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0, sum = 0.0, most = 0.0;
    for (std::size_t c = 0; c < referencePerturbations.size(); ++c) {
      const double response = responses[c * disks + i];
      const double rate = response / std::abs(referencePerturbations[c]);
      slowest = std::min(slowest, rate);
      fastest = std::max(fastest, rate);
      most = std::max(most, response);
      sum += rate;
    }
    if (!(most > lockstepRounding)) continue;
    ++moved;
    if (!(fastest <= responsesAlike * slowest)) continue;
    ++alike;
    largest = std::max(largest, most);
    rates[i] = sum / static_cast<double>(referencePerturbations.size());
  }
  if (moved == 0 || 2 * alike < moved || !(largest < largestResponse)) return {};
  return rates;
}

std::optional<double> equivalentChange(const std::vector<double>& apart,
                                       const std::vector<double>& responses) {
  const std::vector<double> rates = proportionalRates(responses);
  if (rates.empty() || rates.size() != apart.size()) return std::nullopt;
  const std::size_t disks = rates.size();
  double own = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < disks; ++i) {
    double distance = apart[i];
    if (rates[i] == 0.0) {
      double event = 0.0;
      for (std::size_t c = 0; c < referencePerturbations.size(); ++c)
        event = std::max(event, responses[c * disks + i]);
      distance = std::max(0.0, distance - event);
    }
    own += distance * distance;
    moved += rates[i] * rates[i];
  }
  return std::sqrt(own / moved);
}

template <int D>
NamedTerm asTerm(const MirrorChangeOf<D>& change, const std::vector<double>& separation,
                 const std::vector<double>& response) {
  NamedTerm term{change.name, std::nullopt, 1.0};
  const double whole = dot(separation, separation), ofResponse = dot(response, response);
  if (!(whole > 0.0) || !(ofResponse > 0.0)) return term;
  const double times = change.isConstant ? dot(separation, response) / ofResponse : 1.0;
  double left = 0.0;
  for (std::size_t k = 0; k < separation.size(); ++k) {
    const double rest = separation[k] - times * response[k];
    left += rest * rest;
  }
  term.unexplained = std::sqrt(left / whole);
  if (change.isConstant) term.amount = times * termChange;
  return term;
}

std::optional<NamedTerm> bestTerm(const std::vector<NamedTerm>& terms) {
  const auto best = std::ranges::min_element(terms, {}, &NamedTerm::unexplained);
  if (best == terms.end() || !(best->unexplained < termUnexplained)) return std::nullopt;
  return *best;
}

void changeConstant(ContactLaw& law, const std::string& constant, double by) {
  if (constant == "mu")
    law.mu *= 1.0 + by;
  else
    changeReference(law, by);
}

std::vector<ChangedCase> changedCases(const Case& setup) {
  std::vector<std::string> constants = {referencePerturbationOf(setup.law)};
  if (setup.law.mu > 0.0) constants.emplace_back("mu");
  std::vector<ChangedCase> cases;
  for (const std::string& constant : constants) {
    cases.push_back({constant, fmt::format("{}+{:g}%", constant, 100.0 * responseChange), setup});
    changeLaws(cases.back().setup,
               [&](ContactLaw& law) { changeConstant(law, constant, responseChange); });
  }
  return cases;
}

template std::vector<MirrorChangeOf<2>> changesOf(const SceneOf<2>&, const Capabilities&);
template NamedTerm asTerm(const MirrorChangeOf<2>&, const std::vector<double>&,
                          const std::vector<double>&);
template std::vector<MirrorChangeOf<3>> changesOf(const SceneOf<3>&, const Capabilities&);
template NamedTerm asTerm(const MirrorChangeOf<3>&, const std::vector<double>&,
                          const std::vector<double>&);

}  // namespace crossgrain::inline studies
