#include <cmath>
#include <utility>

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

/// Keys of earlier versions, which would otherwise be taken for misspelt ones.
void refuseRemoved(const Reader& in) {
  for (const char* const key : {"omega", "stiffness", "methods", "snapshots", "bound_steps",
                                "bound_reference", "perturbation", "separation", "growth_time"})
    if (in.has(key))
      in.fail(key,
              "is a key no more: cost no longer varies the wheel's speed, stiffness or averaging, "
              "bounds averages or measures chaos");
}

std::vector<Key<Cost>> costTable() {
  const Range steps = above(0.5);
  constexpr auto kinds = namesOf(CostKind{});
  return {
      key("kinds", &Cost::kinds, Names(kinds.begin(), kinds.end()), "of error").listed("all three"),
      key("knobs", &Cost::knobs, Names(costKnobs.begin(), costKnobs.end()), "what is varied")
          .listed("all"),
      key("disks", &Cost::disks, between(1, 20'000'000),
          "for timing a step, where the scene can grow")
          .listed("its own, and four times it", "–"),
      key("threads", &Cost::threads, between(1, 1024),
          "or ranks, that share a step; one is always timed")
          .listed("1, 2, 4, … up to the cores", "–"),
      key("timed", &Cost::timed, positive("s"), "shorter times do not count as measured"),
      key("repeats", &Cost::repeats, between(2, 1000),
          "rounds over all settings, for intervals of times"),
      key("collision_steps", &Cost::collisionSteps, steps, "of two bodies that collide"),
      key("speed", &Cost::speed, positive("m/s"),
          "their v_n; default from a run of the scene: median and, if the law depends on speed, "
          "95th percentile per kind of pair"),
      key("psi_max", &Cost::psiMax, positive(), "Ψ_i from 0 to this"),
      key("psi_count", &Cost::psiCount, between(2, 10'000), ""),
      key("collision_reference", &Cost::collisionReference, steps,
          "of an engine's own reference, where its law has no oracle"),
      key("trajectory_steps", &Cost::trajectorySteps, steps, "of a packing's path"),
      key("trajectory_reference", &Cost::trajectoryReference, steps, "of its reference"),
      key("window_most", &Cost::windowMost, positive("t_c"), "longest window"),
      key("trajectory_packings", &Cost::trajectoryPackings, between(2, 10'000),
          "of the case's, from the first"),
      key("average_steps", &Cost::averageSteps, steps, "of averages over whole runs"),
      key("average_reference", &Cost::averageReference, steps, "of their reference"),
      key("rigid_steps", &Cost::rigidSteps, between(1e-3, 1000),
          "rigid bodies: steps per step of the case"),
      key("iterations", &Cost::iterations, between(1e-3, 1000),
          "rigid bodies: factors on the engine's iterations, at steps where the product of both "
          "factors is at most the largest of both lists"),
      key("tangential", &Cost::tangential,
          Names{"none", "coulomb", "viscous", "spring", "spring_dashpot"},
          "in place of the case's")};
}

const Section<Cost>& costKeys() {
  static const Section<Cost> section(
      {.name = "cost",
       .kinds = "couette, assembly",
       .commands = "cost",
       .note =
           "Steps are per contact time t_c of the lightest pair; for a law that stiffens, of the "
           "fastest impact without its dashpot. Rigid bodies: steps are relative to the case's, "
           "and endpoints with `expected` are judged in their margins. Lists may be empty."},
      costTable());
  return section;
}

}  // namespace

std::vector<SectionInfo> costSections() {
  SectionInfo info = costKeys().info();
  info.keys.push_back({"settings.NAME.SETTING", "the setting's", "–", "",
                       "of one engine, e.g. `skin = [1e-4, 1e-3]`"});
  return {info};
}

void readCost(Reader& in, Cost& target) {
  refuseRemoved(in);
  readSettings(in.section("settings"), target);
  costKeys().read(in, target);
  for (const auto& [name, numbers] :
       {std::pair("disks", &target.disks), {"threads", &target.threads}})
    for (const double number : *numbers)
      if (number != std::floor(number)) in.fail(name, "has {:g}, which is no whole number", number);
}

}  // namespace crossgrain::inline cases
