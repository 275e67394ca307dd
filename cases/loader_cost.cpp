#include <algorithm>

#include "cases/cost_knobs.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

void readSettings(Reader in, Cost& cost) {
  for (const std::string& engine : in.keys()) {
    Reader settings = in.section(engine);
    for (const std::string& name : settings.keys())
      settings.read(name, cost.settings[engine][name], anyNumber());
    settings.finish();
  }
  in.finish();
}

Names kindNames() {
  Names names;
  for (const CostKind kind : costKinds) names.push_back(toString(kind));
  return names;
}

/// What each knob's values do.
constexpr std::pair<const char*, const char*> knobMeanings[] = {
    {"tangential", "laws in place of the case's"},
    {"methods", "of averaging: other averages of the same run"},
    {"snapshots", "every so many-th snapshot: other averages of the same run"},
    {"omega", "times Ω"},
    {"stiffness", "times k_n and k_t; same e_n and steps per contact"}};

std::vector<Key<Cost>> costTable() {
  const Range steps = above(0.5);
  std::vector<Key<Cost>> keys = {
      special<Cost>(
          {"kinds", "", "all three", valuesOf(kindNames()), "of error"},
          [](Reader& in, const std::string& key, Cost& cost) {
            const Names all = kindNames();
            Names names = all;
            in.read(key, names, all);
            if (!in.has(key)) return;
            cost.kinds.clear();
            for (const std::string& name : names)
              cost.kinds.push_back(
                  costKinds[static_cast<std::size_t>(std::ranges::find(all, name) - all.begin())]);
          }),
      key("knobs", &Cost::knobs, Cost{}.knobs, "what is varied").listed("all"),
      key("timed", &Cost::timed, positive("s"), "what is shorter is not called measured"),
      key("repeats", &Cost::repeats, between(1, 1000), "the shortest of so many repeats counts"),
      key("collision_steps", &Cost::collisionSteps, steps, "steps of two small disks that collide"),
      key("speed", &Cost::speed, positive("m/s"), "their v_n"),
      key("psi_max", &Cost::psiMax, positive(), "their Ψ_i go from 0 to this"),
      key("psi_count", &Cost::psiCount, between(2, 10'000), "number of their Ψ_i"),
      key("collision_reference", &Cost::collisionReference, steps,
          "steps of an engine's own limit of small steps, where its law has no oracle"),
      key("trajectory_steps", &Cost::trajectorySteps, steps, "steps of a packing's path"),
      key("trajectory_reference", &Cost::trajectoryReference, steps, "steps of its reference"),
      key("perturbation", &Cost::perturbation, positive("d"), "of positions, to see it grow"),
      key("separation", &Cost::separation, positive("d"),
          "how far the reference may have erred when the window ends"),
      key("window_most", &Cost::windowMost, positive("t_c"), "longest window"),
      key("growth_time", &Cost::growthTime, positive("s"), "how long the perturbation is followed"),
      key("average_steps", &Cost::averageSteps, steps,
          "steps of averages over `[averaging] rotations` of all packings"),
      key("average_reference", &Cost::averageReference, steps,
          "steps of the ensemble that they are compared with"),
      key("bound_steps", &Cost::boundSteps, steps,
          "smaller steps, at which averages are only bounded, over short windows"),
      key("bound_reference", &Cost::boundReference, steps, "steps of those windows' reference")};
  for (const CostKnob& knob : costKnobs()) {
    const std::string name(knob.name), key(knob.key);
    const auto* const meaning = std::ranges::find(
        knobMeanings, key, [](const auto& each) { return std::string(each.first); });
    if (!knob.texts.empty())
      keys.push_back(keyOf<Cost>(
          key, [name](Cost& cost) -> Names& { return cost.texts[name]; }, Names(knob.choices),
          meaning->second));
    if (!knob.numbers.empty())
      keys.push_back(keyOf<Cost>(
          key, [name](Cost& cost) -> std::vector<double>& { return cost.numbers[name]; },
          knob.least > 0.0 ? atLeast(knob.least) : positive(), meaning->second));
  }
  return keys;
}

const Section<Cost>& costKeys() {
  static const Section<Cost> section(
      {.name = "cost",
       .kinds = "couette",
       .commands = "cost",
       .note = "Steps are numbers of steps in the contact time t_c of two small disks; of a law "
               "that stiffens, of an impact at `speed` (without its dashpot). Lists may be empty."},
      costTable());
  return section;
}

}  // namespace

std::vector<SectionInfo> costSections() {
  SectionInfo info = costKeys().info();
  info.keys.push_back({"settings.NAME.SETTING", "the setting's", "–", "",
                       "values of one engine's own number, e.g. `skin = [1e-4, 1e-3]`"});
  return {info};
}

void readCost(Reader& in, Cost& target) {
  readSettings(in.section("settings"), target);
  costKeys().read(in, target);
}

}  // namespace crossgrain::inline cases
