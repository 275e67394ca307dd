#include "cli/calibrate_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "cases/keys.hpp"
#include "law/cohesion.hpp"
#include "law/law_options.hpp"
#include "oracle/calibration.hpp"

namespace crossgrain::inline cli {
namespace {

constexpr double stepsPerContact = 50.0;
constexpr double softOverlap = 0.01;  // of the smaller radius

/// A line of a [law] table.
std::string constant(const char* key, double value, const char* unit) {
  return fmt::format("{:<46} # {}\n", fmt::format("{} = {}", key, value), unit);
}

std::string optionLine(const ContactLaw& law, std::string_view name) {
  return fmt::format("{} = \"{}\"\n", name, lawOptionValue(law, std::string(name)));
}

std::string note(const std::string& label, const std::string& value) {
  return fmt::format("#   {:<50} {}\n", label, value);
}

std::string number(std::optional<double> value, const char* unit = "") {
  return value ? fmt::format("{:.6g}{}{}", *value, *unit ? " " : "", unit) : "-";
}

double smallerRadius(const CollidingPair& pair) {
  return std::min(pair.radius[0], pair.radius[1]);
}

std::string softWarning(double overlap) {
  if (overlap <= softOverlap) return {};
  return fmt::format(
      "# warning: soft: δ_max is {:.2g} of the radius; closed forms freeze the normal, and "
      "contacts of disks are meant to be < {}\n",
      overlap, softOverlap);
}

std::string stiffnessText(const ContactLaw& law) {
  if (law.normal == NormalLaw::hertz) {
    const HertzMaterial material = hertzMaterial(law);
    return constant("young", material.young, "Pa, of each of two equal bodies") +
           constant("poisson", material.poisson, "-");
  }
  if (law.normal == NormalLaw::polynomial)
    return constant("k2", law.kn, "N/m^2") + constant("k3", law.kn3, "N/m^3");
  return constant("kn", law.kn, "N/m");
}

/// Where e_t0 is not known, or not all there is to know.
std::string remarks(const ContactLaw& law, const ImpliedImpact& is) {
  std::string text;
  if (law.tangential != TangentialLaw::none && !is.et0)
    text = "# e_t0 and what follows from it are known for coulomb_bound = \"compression\" only\n";
  if (is.firstTouchSticksToPsi)
    text += fmt::format(
        "# e_t0 holds up to |Ψ_i| = µ γ_n/γ_t = {:.6g} only (spring_reset = \"total\")\n",
        *is.firstTouchSticksToPsi);
  return text;
}

/// Constants that go with rolling resistance and cohesion, as far as the law has them.
std::string resistanceText(const ContactLaw& law) {
  const bool torque = law.conventions.rollingStiffness == RollingStiffness::constant;
  const bool ratio =
      law.rolling == RollingLaw::spring && law.conventions.rollingDamper == RollingDamper::critical;
  const std::tuple<const char*, double, const char*> constants[] = {
      {"mu_r", law.muR, law.rolling == RollingLaw::viscousByLoad ? "s/m" : "-"},
      {"kr", law.kr, torque ? "N m" : "N/m"},
      {"gr", law.gr, ratio ? "-, the damping ratio" : "kg/s"},
      {"kc", law.kc, law.cohesion == CohesionLaw::area ? "Pa" : "N/m"},
      {"w", law.w, "J/m^2"},
      {"k_unload", law.kUnload, "N/m"},
      {"plastic_depth", law.plasticDepth, "-"}};
  std::string text;
  for (const auto& [key, value, unit] : constants)
    if (value != 0.0) text += constant(key, value, unit);
  return text;
}

std::string constantsText(const ContactLaw& law, bool ofMaterials = false) {
  const char* const damping = law.damper == Damper::constant       ? "kg/s"
                              : law.damper == Damper::viscoelastic ? "s"
                                                                   : "-";
  std::string text = stiffnessText(law) + constant("gn", law.gn, damping);
  if (law.tangential != TangentialLaw::none) {
    text += law.mu > 0.0 || ofMaterials ? constant("mu", law.mu, "-")
                                        : "# mu = …   a case needs it; not given\n";
    if (law.kt > 0.0 && law.normal != NormalLaw::hertz) text += constant("kt", law.kt, "N/m");
    if (law.gt > 0.0 || law.tangential == TangentialLaw::springDashpot)
      text += constant("gt", law.gt, damping);
  }
  return text + resistanceText(law);
}

/// As comments: the first column to the left, the others to the right.
/// @param rows  the names of the columns first; further cells than there are widths are left out
std::string table(const std::vector<int>& widths,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("# {:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < widths.size(); ++k)
      text += fmt::format(" {:>{}}", row[k], widths[k]);
    text += '\n';
  }
  return text;
}

std::string digits4(double value) {
  return fmt::format("{:.4g}", value);
}

std::string decimals4(std::optional<double> value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

}  // namespace

std::string lawText(const ContactLaw& law, const std::string& asked) {
  constexpr std::array<std::string_view, 6> alwaysPrinted = {
      "normal", "tension", "tangential", "coulomb_bound", "spring_reset", "spring_update"};
  ContactLaw before;
  before.conventions = usualConventions();
  std::string text = fmt::format("# {}\n[law]\n", asked);
  for (const LawOption& option : lawOptions()) {
    const bool asLoaded = option.get(law) == option.get(before);
    const bool always = std::ranges::find(alwaysPrinted, option.name) != alwaysPrinted.end();
    if (mattersTo(law, option.name) && (always || !asLoaded)) text += optionLine(law, option.name);
  }
  return text + constantsText(law);
}

std::string rollingText(const ContactLaw& law, const std::optional<CollidingPair>& pair) {
  std::string text, meaning;
  if (pair) {
    const bool constantK = law.conventions.rollingStiffness == RollingStiffness::constant;
    const bool critical = law.conventions.rollingDamper == RollingDamper::critical;
    text = optionLine(law, "rolling") + optionLine(law, "rolling_stiffness") +
           optionLine(law, "rolling_damper") + constant("kr", law.kr, constantK ? "N m" : "N/m") +
           constant("gr", law.gr, critical ? "-, the damping ratio" : "kg/s");
    const ImpliedRolling is = impliedRolling(law, *pair);
    meaning = note(pair->plane ? "frequency on a plane, without slip"
                               : "frequency of the pair, centres held",
                   number(is.frequency, "Hz")) +
              note("decay of its amplitude", number(is.decay, "1/s"));
  }
  text += optionLine(law, "rolling_length");
  if (!(law.muR > 0.0)) return text + "# mu_r = …   a case needs it; not given\n" + meaning;
  return text + constant("mu_r", law.muR, "-") + meaning +
         note("a disk rests on inclines up to",
              number(restAngle(law) * 180.0 / std::numbers::pi, "degrees"));
}

std::string cohesionText(const ContactLaw& law, double reducedRadius) {
  return optionLine(law, "cohesion") + constant("w", law.w, "J/m^2") +
         fmt::format("# gamma = {}   in place of w, with gamma_is = \"half_of_w\"\n", 0.5 * law.w) +
         note("reduced radius R12", number(reducedRadius, "m")) +
         note("largest pull", number(pullOff(law, reducedRadius), "N"));
}

std::string materialsText(const Case& setup) {
  if (!setup.materials) return {};
  const std::vector<std::string>& names = setup.materials->names;
  std::string text;
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a; b < names.size(); ++b) {
      const ContactLaw& law = setup.materials->laws[a * names.size() + b];
      if (law == setup.law) continue;
      text += fmt::format("[[law.pairs]]\nbetween = [\"{}\", \"{}\"]\n", names[a], names[b]) +
              constantsText(law, true);
    }
  return text;
}

std::string impactText(const ContactLaw& law, const CollidingPair& pair, std::optional<double> vn) {
  const ImpliedImpact is = impliedImpact(law, pair);
  const ReducedPair two = reduced(pair);
  const bool cut = law.conventions.tension == Tension::cut;
  std::string text = "\n# implied (normal frozen: slow impacts)\n";
  const auto add = [&](const std::string& label, const std::string& value) {
    text += note(label, value);
  };
  add("reduced mass m12, K = 1 + m12 Σ a²/J", number(two.mass, "kg") + ", " + number(two.K));
  add("e_n", fmt::format("{:.6g}, with tension {}: {:.6g}", cut ? is.enCut : is.enAllowed,
                         cut ? "allowed" : "cut", cut ? is.enAllowed : is.enCut));
  add("contact time t_c", number(is.contactTime, "s"));
  add("suggested dt = t_c/50", number(is.contactTime / stepsPerContact, "s"));
  if (cut) add("π/ω, which steps_per_contact counts from", number(is.halfPeriod, "s"));
  add("ω, γ_n over critical", number(is.omega, "rad/s") + ", " + number(is.dampingRatio));
  if (law.tangential != TangentialLaw::none) {
    add("e_t0 without slip", number(is.et0));
    if (law.kt > 0.0) {
      add("ω_t, γ_t over critical", number(is.omegaT, "rad/s") + ", " + number(is.dampingRatioT));
      add("kt/kn", number(law.kt / law.kn));
    }
    add("sliding: Ψ_i − Ψ_f = K (1 + e_cut) µ", number(is.slidingConstant));
    add("sticking ends at Ψ* = K (1 + e_cut) µ/(1 + e_t0)", number(is.stickingEndsAtPsi));
  }
  const double radius = smallerRadius(pair);
  add("δ_max reaches 1 % of the smaller radius at v_n",
      number(softOverlap * radius / is.overlapPerSpeed, "m/s"));
  text += remarks(law, is);
  if (!vn) return text;
  const double overlap = *vn * is.overlapPerSpeed;
  add(fmt::format("δ_max, δ_max/a at v_n = {} m/s", *vn),
      number(overlap, "m") + ", " + number(overlap / radius));
  return text + softWarning(overlap / radius);
}

std::string stiffeningPairsText(const std::vector<NamedPair>& pairs, double speed) {
  double largest = 0.0;
  std::vector<std::vector<std::string>> rows = {
      {"pair", "m12 [kg]", "K", "e_n", "t_c [s]", "t_c/50 [s]", "δ_max/a"}};
  for (const auto& [name, bodies, law] : pairs) {
    ContactLaw normal = law;
    normal.tangential = TangentialLaw::none;
    const CollisionEnd end = oracleOutcome(normal, bodies, {0.0, speed});
    const ReducedPair two = reduced(bodies);
    const double overlap = *end.maxOverlap / smallerRadius(bodies);
    largest = std::max(largest, overlap);
    rows.push_back({name, digits4(two.mass), digits4(two.K), decimals4(end.en),
                    digits4(*end.duration), digits4(*end.duration / stepsPerContact),
                    fmt::format("{:.2g}", overlap)});
  }
  return fmt::format("\n# implied, at v_n = {:.6g} m/s\n", speed) +
         table({12, 11, 8, 9, 11, 11, 9}, rows) + softWarning(largest);
}

std::string pairsText(const std::vector<NamedPair>& pairs, std::optional<double> vn) {
  const ContactLaw& first = pairs.front().law;
  const bool alike = std::ranges::all_of(
      pairs, [&](const ContactLaw& law) { return law == first; }, &NamedPair::law);
  double largest = 0.0;
  std::vector<std::vector<std::string>> rows = {{"pair", "m12 [kg]", "K", "e_n allow", "e_n cut",
                                                 "t_c [s]", "e_t0", "sliding", "Ψ*", "t_c/50 [s]",
                                                 "δ_max/a"}};
  for (const auto& [name, bodies, law] : pairs) {
    const ImpliedImpact is = impliedImpact(law, bodies);
    const ReducedPair two = reduced(bodies);
    const double overlap = vn.value_or(0.0) * is.overlapPerSpeed / smallerRadius(bodies);
    largest = std::max(largest, overlap);
    rows.push_back({name, digits4(two.mass), digits4(two.K), decimals4(is.enAllowed),
                    decimals4(is.enCut), digits4(is.contactTime), decimals4(is.et0),
                    decimals4(is.slidingConstant), decimals4(is.stickingEndsAtPsi),
                    digits4(is.contactTime / stepsPerContact), fmt::format("{:.2g}", overlap)});
  }
  std::vector<int> widths = {12, 11, 8, 9, 9, 11, 9, 9, 9, 11};
  if (vn) widths.push_back(9);
  return fmt::format("\n# implied (normal frozen: slow impacts){}\n",
                     pairs.size() > 1 && alike && first.gn > 0.0 && first.damper != Damper::critical
                         ? "; the constants are the same for all pairs, so restitutions are not"
                         : "") +
         table(widths, rows) + remarks(first, impliedImpact(first, pairs.front().bodies)) +
         softWarning(largest);
}

}  // namespace crossgrain::inline cli
