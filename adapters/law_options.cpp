#include "adapters/law_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace crossgrain {
namespace {

template <typename Enum>
LawOption option(std::string_view name, Enum ContactLaw::*member,
                 std::vector<std::string_view> values) {
  return {name, std::move(values),
          [member](const ContactLaw& law) { return static_cast<std::size_t>(law.*member); },
          [member](ContactLaw& law, std::size_t index) { law.*member = static_cast<Enum>(index); }};
}

template <typename Enum>
LawOption option(std::string_view name, Enum LawConventions::*member,
                 std::vector<std::string_view> values) {
  return {
      name, std::move(values),
      [member](const ContactLaw& law) { return static_cast<std::size_t>(law.conventions.*member); },
      [member](ContactLaw& law, std::size_t index) {
        law.conventions.*member = static_cast<Enum>(index);
      }};
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
  };
  return options;
}

std::span<const LawConstant> lawConstants() {
  static constexpr std::array constants = {
      LawConstant{"kn", &ContactLaw::kn}, LawConstant{"kn3", &ContactLaw::kn3},
      LawConstant{"gn", &ContactLaw::gn}, LawConstant{"kt", &ContactLaw::kt},
      LawConstant{"gt", &ContactLaw::gt}, LawConstant{"mu", &ContactLaw::mu},
      LawConstant{"en", &ContactLaw::en}, LawConstant{"et0", &ContactLaw::et0}};
  return constants;
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

bool mattersTo(const ContactLaw& law, std::string_view name) {
  const bool soft = law.soft();
  const bool damped = law.gn > 0.0 || law.gt > 0.0;
  if (name == "tension") return soft && law.gn > 0.0;
  if (name == "damper" || name == "damping_velocity") return soft && damped;
  if (name == "coulomb_bound")
    return soft && law.tangential != TangentialLaw::none && law.gn > 0.0 &&
           law.conventions.tension == Tension::allow;
  const bool arms = soft && law.tangential != TangentialLaw::none;
  const LeverArm lever = law.conventions.leverArm, ofVelocity = law.conventions.armOfVelocity();
  if (name == "lever_arm") return arms;
  if (name == "velocity_arm") return arms && ofVelocity != lever;
  if (name == "plane_arm")
    return arms && (lever != LeverArm::radius || ofVelocity != LeverArm::radius);
  if (name == "dashpot" || name == "spring_reset")
    return soft && law.tangential == TangentialLaw::springDashpot;
  if (name == "spring_update") return soft && law.springs();
  if (name == "history") return law.normal == NormalLaw::hertz && law.springs();
  return true;
}

}  // namespace crossgrain
