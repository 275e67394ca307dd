#include "runs/lockstep/terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adapters/law_options.hpp"
#include "adapters/suitability.hpp"
#include "runs/lockstep/rules.hpp"

namespace crossgrain::inline runs {
namespace {

void addConstants(std::vector<MirrorChange>& changes, const Scene& scene) {
  const auto add = [&](std::string name, std::function<void(Scene&, double)> apply) {
    changes.push_back({std::move(name), true, std::move(apply)});
  };
  for (const LawConstant& constant : lawConstants())
    if (scene.law.*constant.value != 0.0)
      add(std::string(constant.name),
          [value = constant.value](Scene& changed, double by) { changed.law.*value *= 1.0 + by; });
  const std::pair<const char*, double BottomPlate::*> plate[] = {
      {"plate mu", &BottomPlate::mu},
      {"plate kb", &BottomPlate::kb},
      {"plate gb", &BottomPlate::gb},
      {"plate tau_m", &BottomPlate::tauM}};
  if (scene.bottom)
    for (const auto& [name, value] : plate)
      if ((*scene.bottom).*value != 0.0)
        add(name,
            [value = value](Scene& changed, double by) { (*changed.bottom).*value *= 1.0 + by; });
  add("mass", [](Scene& changed, double by) {
    for (double& mass : changed.disks.mass) mass *= 1.0 + by;
  });
  if (scene.rotation)
    add("inertia", [](Scene& changed, double by) {
      for (double& inertia : changed.disks.inertia) inertia *= 1.0 + by;
    });
  add("velocity of walls", [](Scene& changed, double by) {
    for (WallBody& body : changed.bodies) {
      body.motion.angularVelocity *= 1.0 + by;
      body.motion.velocity *= 1.0 + by;
      body.motion.frequency *= 1.0 + by;
    }
  });
}

void addConventions(std::vector<MirrorChange>& changes, const Scene& scene,
                    const Capabilities& can) {
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    // With these the constants would mean something else.
    if (name == "normal" || name == "damper") continue;
    // An arm of v_t that is that of f_t can become another one wherever there are arms.
    if (!mattersTo(scene.law, name == "velocity_arm" ? "lever_arm" : name)) continue;
    const auto values = can.lawOptions.find(name);
    if (values == can.lawOptions.end()) continue;
    for (const std::string& value : values->second)
      if (value != lawOptionValue(scene.law, name))
        changes.push_back(
            {fmt::format("{} = {}", name, value), false,
             [name, value](Scene& changed, double) { setLawOption(changed.law, name, value); }});
  }
}

void addMissingEffects(std::vector<MirrorChange>& changes, const Scene& scene, Capabilities can) {
  for (const Effect effect : effectsOf(scene)) {
    const std::string name = toString(effect);
    can.effects[effect] = Support::never;
    changes.push_back({"without " + name, false, [can, name](Scene& changed, double) {
                         changed = adaptScene(can, changed, {name}).scene;
                       }});
    can.effects[effect] = Support::optional;
  }
}

double dot(const std::vector<double>& one, const std::vector<double>& other) {
  return std::inner_product(one.begin(), one.end(), other.begin(), 0.0);
}

}  // namespace

std::vector<MirrorChange> changesOf(const Scene& scene, const Capabilities& can) {
  std::vector<MirrorChange> changes;
  addConstants(changes, scene);
  addConventions(changes, scene, can);
  addMissingEffects(changes, scene, can);
  return changes;
}

std::string yardstickOf(const ContactLaw& law) {
  return law.soft() ? "kn" : "en";
}

void changeYardstick(ContactLaw& law, double by) {
  (law.soft() ? law.kn : law.en) *= 1.0 + by;
}

std::optional<double> equivalentChange(double separation, std::vector<double> responses) {
  for (std::size_t k = 1; k < responses.size(); ++k)
    responses[k] = std::max(responses[k], responses[k - 1]);
  if (responses.empty() || !(responses.back() > lockstepRounding)) return std::nullopt;
  std::size_t above = 0;
  while (above < responses.size() && responses[above] < separation) ++above;
  if (above == responses.size()) return separation / responses.back() * yardstickChanges.back();
  if (above == 0) return separation / responses.front() * yardstickChanges.front();
  const double low = std::max(responses[above - 1], 1e-300), high = responses[above];
  const double part = std::log(separation / low) / std::log(high / low);
  return yardstickChanges[above - 1] *
         std::pow(yardstickChanges[above] / yardstickChanges[above - 1], part);
}

NamedTerm asTerm(const MirrorChange& change, const std::vector<double>& separation,
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

}  // namespace crossgrain::inline runs
