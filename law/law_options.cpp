#include "law/law_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace crossgrain {
namespace {

template <typename Enum>
LawOption option(std::string_view name, Enum ContactLaw::*member,
                 std::vector<std::string_view> values, LawPart part = LawPart::contact) {
  return {name, std::move(values),
          [member](const ContactLaw& law) { return static_cast<std::size_t>(law.*member); },
          [member](ContactLaw& law, std::size_t index) { law.*member = static_cast<Enum>(index); },
          part};
}

template <typename Enum>
LawOption option(std::string_view name, Enum LawConventions::*member,
                 std::vector<std::string_view> values, LawPart part = LawPart::contact) {
  return {
      name, std::move(values),
      [member](const ContactLaw& law) { return static_cast<std::size_t>(law.conventions.*member); },
      [member](ContactLaw& law, std::size_t index) {
        law.conventions.*member = static_cast<Enum>(index);
      },
      part};
}

const LawOption& findOption(std::string_view name) {
  const auto options = lawOptions();
  const auto found = std::ranges::find(options, name, &LawOption::name);
  if (found != options.end()) return *found;
  std::vector<std::string_view> names;
  for (const LawOption& entry : options) names.push_back(entry.name);
  throw std::invalid_argument(
      fmt::format("unknown law option '{}' (there are: {})", name, fmt::join(names, ", ")));
}

}  // namespace

std::span<const LawOption> lawOptions() {
  static const std::vector<LawOption> options = {
      option("normal", &ContactLaw::normal, {"linear", "hertz", "polynomial", "rigid"}),
      option("damper", &ContactLaw::damper, {"constant", "viscoelastic", "critical"}),
      option("tangential", &ContactLaw::tangential,
             {"none", "coulomb", "viscous", "spring", "spring_dashpot"}),
      option("tension", &LawConventions::tension, {"allow", "cut"}),
      option("coulomb_bound", &LawConventions::coulombBound,
             {"compression", "magnitude", "signed"}),
      option("dashpot", &LawConventions::dashpot, {"inside", "outside"}),
      option("spring_reset", &LawConventions::springReset, {"total", "spring_only"}),
      option("spring_update", &LawConventions::springUpdate, {"after", "before", "midpoint"}),
      option("lever_arm", &LawConventions::leverArm, {"radius", "contact_point", "overlap_middle"}),
      option("velocity_arm", &LawConventions::velocityArm,
             {"lever_arm", "radius", "contact_point", "overlap_middle"}),
      option("plane_arm", &LawConventions::planeArm, {"surface", "middle", "radius"}),
      option("history", &LawConventions::history, {"displacement", "force"}),
      option("damping_velocity", &LawConventions::dampingVelocity,
             {"lagged", "predicted", "implicit"}),
      option("integrator", &LawConventions::integrator,
             {"position_verlet", "velocity_verlet", "semi_implicit_euler"}),
      option("rolling", &ContactLaw::rolling,
             {"none", "constant_torque", "viscous", "viscous_by_load", "spring"}, LawPart::rolling),
      option("rolling_length", &LawConventions::rollingLength,
             {"effective", "twice_effective", "smaller_radius", "mean_radius"}, LawPart::rolling),
      option("rolling_stiffness", &LawConventions::rollingStiffness,
             {"length_square", "radii", "constant"}, LawPart::rolling),
      option("rolling_damper", &LawConventions::rollingDamper, {"constant", "critical"},
             LawPart::rolling),
      option("rolling_load", &LawConventions::rollingLoad,
             {"compression", "magnitude", "elastic", "while_compressed"}, LawPart::rolling),
      option("rolling_dashpot", &LawConventions::rollingDashpot, {"inside", "outside"},
             LawPart::rolling),
      option("rolling_reset", &LawConventions::rollingReset, {"total", "spring_only"},
             LawPart::rolling),
      option("cohesion", &ContactLaw::cohesion, {"none", "area", "dmt", "jkr", "elasto_plastic"},
             LawPart::cohesion),
      option("cohesion_area", &LawConventions::cohesionArea,
             {"lens", "first_order", "twice_between_disks"}, LawPart::cohesion),
      option("jkr_end", &LawConventions::jkrEnd, {"largest_pull", "branch"}, LawPart::cohesion),
      option("cohesion_load", &LawConventions::cohesionLoad,
             {"net", "without_pull", "plus_twice_pull_off", "magnitude_plus_pull_off",
              "net_without_dashpot"},
             LawPart::cohesion),
      option("unloading_stiffness", &LawConventions::unloadingStiffness, {"current", "lagged"},
             LawPart::cohesion),
      option("spring_turn", &LawConventions::springTurn,
             {"rotated", "first_order", "rescaled", "projected"}, LawPart::space),
      option("spring_twist", &LawConventions::springTwist, {"mean_spin", "none"}, LawPart::space),
  };
  return options;
}

std::span<const LawConstant> lawConstants() {
  static constexpr std::array constants = {
      LawConstant{"kn", &ContactLaw::kn},
      LawConstant{"kn3", &ContactLaw::kn3},
      LawConstant{"gn", &ContactLaw::gn},
      LawConstant{"kt", &ContactLaw::kt},
      LawConstant{"gt", &ContactLaw::gt},
      LawConstant{"mu", &ContactLaw::mu},
      LawConstant{"en", &ContactLaw::en},
      LawConstant{"et0", &ContactLaw::et0},
      LawConstant{"kr", &ContactLaw::kr, LawPart::rolling},
      LawConstant{"gr", &ContactLaw::gr, LawPart::rolling},
      LawConstant{"mu_r", &ContactLaw::muR, LawPart::rolling},
      LawConstant{"kc", &ContactLaw::kc, LawPart::cohesion},
      LawConstant{"w", &ContactLaw::w, LawPart::cohesion},
      LawConstant{"k_unload", &ContactLaw::kUnload, LawPart::cohesion},
      LawConstant{"plastic_depth", &ContactLaw::plasticDepth, LawPart::cohesion}};
  return constants;
}

bool hasPart(const ContactLaw& law, LawPart part) {
  switch (part) {
    case LawPart::contact:
      break;
    case LawPart::rolling:
      return law.rolls();
    case LawPart::cohesion:
      return law.coheres();
    case LawPart::space:
      return law.inSpace();
  }
  return true;
}

std::string lawOptionValue(const ContactLaw& law, std::string_view name) {
  const LawOption& entry = findOption(name);
  return std::string(entry.values[entry.get(law)]);
}

void setLawOption(ContactLaw& law, std::string_view name, std::string_view value) {
  const LawOption& entry = findOption(name);
  const auto found = std::ranges::find(entry.values, value);
  if (found == entry.values.end())
    throw std::invalid_argument(fmt::format("{} cannot be '{}' (it is one of: {})", name, value,
                                            fmt::join(entry.values, ", ")));
  entry.set(law, static_cast<std::size_t>(found - entry.values.begin()));
}

bool isConvention(std::string_view name) {
  static constexpr std::array laws = {
      "normal",         "damper",  "tangential", "rolling", "rolling_stiffness",
      "rolling_damper", "cohesion"};
  return std::ranges::find(laws, findOption(name).name) == laws.end();
}

namespace {

bool rollingMatters(const ContactLaw& law, std::string_view name) {
  const bool spring = law.rolling == RollingLaw::spring;
  const bool bounded = law.rolls() && law.rolling != RollingLaw::viscous;
  if (name == "rolling") return law.rolls();
  if (name == "rolling_length") return law.rolls();
  if (name == "rolling_stiffness") return spring;
  if (name == "rolling_load") return bounded && (law.gn > 0.0 || law.coheres());
  return spring && law.gr > 0.0;  // rolling_damper, rolling_dashpot, rolling_reset
}

bool cohesionMatters(const ContactLaw& law, std::string_view name) {
  if (name == "cohesion_area") return law.cohesion == CohesionLaw::area;
  if (name == "jkr_end") return law.cohesion == CohesionLaw::jkr;
  if (name == "unloading_stiffness")
    return law.cohesion == CohesionLaw::elastoPlastic && law.plasticDepth > 0.0;
  if (name == "cohesion_load") return law.coheres() && (law.friction() || law.rolls());
  return law.coheres();
}

}  // namespace

bool mattersTo(const ContactLaw& law, std::string_view name) {
  const bool soft = law.soft();
  const bool damped = law.gn > 0.0 || law.gt > 0.0;
  if (name == "tension") return soft && law.gn > 0.0;
  if (name == "damper" || name == "damping_velocity") return soft && damped;
  if (name == "coulomb_bound") {
    const bool pulls = law.gn > 0.0 && law.conventions.tension == Tension::allow;
    return soft && law.tangential != TangentialLaw::none && (pulls || law.coheres());
  }
  const bool arms = soft && law.tangential != TangentialLaw::none;
  const LeverArm lever = law.conventions.leverArm, ofVelocity = law.conventions.armOfVelocity();
  if (name == "lever_arm") return arms;
  if (name == "velocity_arm") return arms && ofVelocity != lever;
  if (name == "plane_arm")
    return arms && (lever != LeverArm::radius || ofVelocity != LeverArm::radius);
  if (name == "dashpot" || name == "spring_reset")
    return soft && law.tangential == TangentialLaw::springDashpot;
  if (name == "spring_update") return soft && (law.springs() || law.rolling == RollingLaw::spring);
  if (name == "history") return law.normal == NormalLaw::hertz && law.springs();
  if (findOption(name).part == LawPart::rolling) return rollingMatters(law, name);
  if (findOption(name).part == LawPart::cohesion) return cohesionMatters(law, name);
  if (findOption(name).part == LawPart::space)
    return law.inSpace() && law.friction() && law.springs();
  return true;
}

}  // namespace crossgrain
