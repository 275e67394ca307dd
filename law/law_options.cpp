#include "law/law_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace crossgrain {
namespace {

template <typename Enum>
LawOption option(std::string_view name, std::string_view meaning, Enum ContactLaw::*member,
                 std::vector<std::string_view> values, LawPart part = LawPart::contact) {
  return {name,
          meaning,
          std::move(values),
          [member](const ContactLaw& law) { return static_cast<std::size_t>(law.*member); },
          [member](ContactLaw& law, std::size_t index) { law.*member = static_cast<Enum>(index); },
          part};
}

template <typename Enum>
LawOption option(std::string_view name, std::string_view meaning, Enum LawConventions::*member,
                 std::vector<std::string_view> values, LawPart part = LawPart::contact) {
  return {
      name,
      meaning,
      std::move(values),
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
      option("normal",
             "elastic part of f_n: k_n δ; 4/3 E₁₂ √R₁₂ δ^(3/2); k₂ δ² + k₃ δ³; or restitutions",
             &ContactLaw::normal, {"linear", "hertz", "polynomial", "rigid"}),
      option(
          "damper",
          "what γ_n and γ_t multiply besides the velocity: 1, the stiffness, or √(m₁₂ · stiffness)",
          &ContactLaw::damper, {"constant", "viscoelastic", "critical"}),
      option("tangential", "tangential law; rigid: `coulomb` if `mu` > 0, else `none`",
             &ContactLaw::tangential, {"none", "coulomb", "viscous", "spring", "spring_dashpot"}),
      option("tension", "f_n as it is, or max(f_n, 0)", &LawConventions::tension, {"allow", "cut"}),
      option("coulomb_bound", "µ max(f_n, 0), µ|f_n|, µ f_n", &LawConventions::coulombBound,
             {"compression", "magnitude", "signed"}),
      option("dashpot", "whether γ_t v_t is part of the trial force that the bound limits",
             &LawConventions::dashpot, {"inside", "outside"}),
      option("spring_reset", "on slip ξ = −f_t/k_t, or −(f_t + γ_t v_t)/k_t",
             &LawConventions::springReset, {"total", "spring_only"}),
      option("spring_update",
             "ξ grows by v_t dt after or before the force, or by half of it on each side",
             &LawConventions::springUpdate, {"after", "before", "midpoint"}),
      option("lever_arm",
             "a_i (does not conserve angular momentum), a_i − δ a_j/(a_i + a_j), or a_i − δ/2",
             &LawConventions::leverArm, {"radius", "contact_point", "overlap_middle"}),
      option("velocity_arm", "the arm of the spins in v_t; `lever_arm`: that of f_t",
             &LawConventions::velocityArm,
             {"lever_arm", "radius", "contact_point", "overlap_middle"}),
      option("plane_arm", "what an arm other than `radius` is at a plane: a_i − δ, a_i − δ/2, a_i",
             &LawConventions::planeArm, {"surface", "middle", "radius"}),
      option("history",
             "what a Hertz contact remembers: ξ, or the force, which grows by −k_t v_t dt",
             &LawConventions::history, {"displacement", "force"}),
      option("damping_velocity",
             "that dashpots see, and by which springs stretch and friction turns: v(t − dt/2), v(t − "
             "dt/2) + a dt/2, or the one that the force makes",
             &LawConventions::dampingVelocity, {"lagged", "predicted", "implicit"}),
      option("integrator", "the scheme of the in-house engine", &LawConventions::integrator,
             {"position_verlet", "velocity_verlet", "semi_implicit_euler"}),
      option("rolling",
             "torque M on i, −M on j: −µ_r L N sign(ω_r); −γ_r L² ω_r; −µ_r L² N ω_r; or −k_r θ − "
             "γ_r L² ω_r, θ = ∫ω_r dt, limited to µ_r L N. ω_r = ω_i − ω_j",
             &ContactLaw::rolling,
             {"none", "constant_torque", "viscous", "viscous_by_load", "spring"}, LawPart::rolling),
      option("rolling_length",
             "L: R₁₂, 2 R₁₂, the smaller radius or their mean; at a plane a_i, 2 a_i, a_i, a_i",
             &LawConventions::rollingLength,
             {"effective", "twice_effective", "smaller_radius", "mean_radius"}, LawPart::rolling),
      option("rolling_stiffness", "what `kr` is times: L², a_i a_j, or 1 (then N m)",
             &LawConventions::rollingStiffness, {"length_square", "radii", "constant"},
             LawPart::rolling),
      option("rolling_damper",
             "what `gr` is: γ_r [kg/s] of γ_r L² ω_r, or the damping ratio of 2 γ_r √(I k_r) ω_r, "
             "1/I = Σ 1/(J + m a²)",
             &LawConventions::rollingDamper, {"constant", "critical"}, LawPart::rolling),
      option("rolling_load",
             "N: max(f_n, 0), |f_n|, f_el without dashpot and cohesion, or max(f_n, 0) with no "
             "limit of a spring where it is 0",
             &LawConventions::rollingLoad,
             {"compression", "magnitude", "elastic", "while_compressed"}, LawPart::rolling),
      option("rolling_dashpot",
             "whether the bound limits spring and dashpot, or the spring, which is alone while it "
             "slips",
             &LawConventions::rollingDashpot, {"inside", "outside"}, LawPart::rolling),
      option("rolling_reset",
             "at the bound the spring alone carries it, or spring and dashpot together",
             &LawConventions::rollingReset, {"total", "spring_only"}, LawPart::rolling),
      option(
          "cohesion",
          "none; −k_c A(δ); −F_po = −2π w R₁₂; JKR in place of Hertz' force, until beyond δ = 0; "
          "or elasto-plastic: k_n δ on loading, up to `k_unload` on unloading, pull up to k_c δ",
          &ContactLaw::cohesion, {"none", "area", "dmt", "jkr", "elasto_plastic"},
          LawPart::cohesion),
      option("cohesion_area", "A: the lens of two spheres; 2π R₁₂ δ; 4π R₁₂ δ, at a plane 2π R₁₂ δ",
             &LawConventions::cohesionArea, {"lens", "first_order", "twice_between_disks"},
             LawPart::cohesion),
      option("jkr_end",
             "where parting surfaces let go: at the largest pull, or at the end of the branch",
             &LawConventions::jkrEnd, {"largest_pull", "branch"}, LawPart::cohesion),
      option("cohesion_load",
             "what µ and µ_r multiply: f_n, f_n without the pull, f_n without its dashpot + 2 "
             "F_po, |f_n| + F_po, or f_n without its dashpot",
             &LawConventions::cohesionLoad,
             {"net", "without_pull", "plus_twice_pull_off", "magnitude_plus_pull_off",
              "net_without_dashpot"},
             LawPart::cohesion),
      option("unloading_stiffness",
             "k₂ of an elasto-plastic contact: of δ_max in this step, or in the step before",
             &LawConventions::unloadingStiffness, {"current", "lagged"}, LawPart::cohesion),
      option("spring_turn",
             "in space, how ξ follows n: by the smallest rotation, that to first order, or less "
             "its part along n, to the old length or not (docs/dimensions.md)",
             &LawConventions::springTurn, {"rotated", "first_order", "rescaled", "projected"},
             LawPart::space),
      option("spring_twist", "in space, whether ξ turns with a pair about n, by ½(ω_i + ω_j)·n dt",
             &LawConventions::springTwist, {"mean_spin", "none"}, LawPart::space),
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
