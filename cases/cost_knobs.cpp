#include "cases/cost_knobs.hpp"

#include <algorithm>

#include "averaging/weights.hpp"
#include "cases/cost.hpp"

namespace crossgrain::inline cases {

const std::vector<CostKnob>& costKnobs() {
  using enum CostKind;
  static const std::vector<CostKind> everywhere(costKinds.begin(), costKinds.end());
  static const std::vector<CostKnob> knobs = {
      {.name = "time_step", .kinds = everywhere, .speaksForItself = true, .sameLaw = true},
      {.name = "integrator", .kinds = everywhere, .speaksForItself = true, .sameLaw = true},
      {.name = "precision", .kinds = everywhere, .sameLaw = true},
      {.name = "tangential",  // laws in place of the case's
       .key = "tangential",
       .texts = {"viscous", "coulomb", "spring"},
       .choices = {"none", "coulomb", "viscous", "spring", "spring_dashpot"},
       .kinds = {collision, averages}},
      {.name = "tension", .kinds = {collision, averages}},
      {.name = "settings", .kinds = everywhere, .sameLaw = true},  // [cost.settings.NAME]
      {.name = "method",                                           // of averaging
       .key = "methods",
       .texts = {"slicing", "centre"},
       .choices = {weightNames.begin(), weightNames.end()},
       .kinds = {averages},
       .sameRun = true},
      {.name = "snapshots",  // every so many-th
       .key = "snapshots",
       .numbers = {4, 16, 64},
       .least = 1.0,
       .kinds = {averages},
       .sameRun = true},
      {.name = "omega", .key = "omega", .numbers = {0.5, 2.0}, .kinds = {averages}},  // times Ω
      {.name = "stiffness",  // times k_n and k_t, same e_n
       .key = "stiffness",
       .numbers = {0.25, 0.0625},
       .kinds = {averages}},
      {.name = "effects", .kinds = {averages}},
  };
  return knobs;
}

const CostKnob* findCostKnob(std::string_view name) {
  const auto found = std::ranges::find(costKnobs(), name, &CostKnob::name);
  return found == costKnobs().end() ? nullptr : &*found;
}

Cost::Cost() {
  for (const CostKnob& knob : costKnobs()) {
    const std::string name(knob.name);
    knobs.push_back(name);
    if (!knob.texts.empty()) texts[name] = knob.texts;
    if (!knob.numbers.empty()) numbers[name] = knob.numbers;
  }
}

bool speaksForItself(std::string_view name) {
  const CostKnob* const knob = findCostKnob(name);
  return knob && knob->speaksForItself;
}

}  // namespace crossgrain::inline cases
