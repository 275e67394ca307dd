#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "adapters/law_options.hpp"
#include "cli/calibrate.hpp"

namespace crossgrain::inline cli {
namespace {

constexpr double stepsPerContact = 50.0;
constexpr double softOverlap = 0.01;  // of the smaller radius

void printConstant(const char* key, double value, const char* unit) {
  fmt::print("{:<46} # {}\n", fmt::format("{} = {}", key, value), unit);
}

void note(const std::string& label, const std::string& value) {
  fmt::print("#   {:<50} {}\n", label, value);
}

std::string number(std::optional<double> value, const char* unit = "") {
  return value ? fmt::format("{:.6g}{}{}", *value, *unit ? " " : "", unit) : "-";
}

double smallerRadius(const CollidingPair& pair) {
  return std::min(pair.radius[0], pair.radius[1]);
}

void warnIfSoft(double overlap) {
  if (overlap > softOverlap)
    fmt::print(
        "# warning: soft: δ_max is {:.2g} of the radius; closed forms freeze the normal, and "
        "contacts of disks are meant to be < {}\n",
        overlap, softOverlap);
}

constexpr std::array<std::string_view, 6> alwaysPrinted = {
    "normal", "tension", "tangential", "coulomb_bound", "spring_reset", "spring_update"};

/// Of Hertz' law E and ν of two equal bodies with these k_n and k_t, as the loader's setHertz() has
/// them: k_t/k_n = 3 (1 − ν)/(2 − ν), k_n = 2/3 E/(1 − ν²). Any ν serves without a spring.
void printStiffness(const ContactLaw& law) {
  if (law.normal == NormalLaw::hertz) {
    const double ratio = law.kt / law.kn;
    const double poisson =
        law.kt > 0.0 ? std::clamp((3.0 - 2.0 * ratio) / (3.0 - ratio), 0.0, 0.5) : 0.0;
    printConstant("young", 1.5 * law.kn * (1.0 - poisson * poisson),
                  "Pa, of each of two equal bodies");
    printConstant("poisson", poisson, "-");
  } else if (law.normal == NormalLaw::polynomial) {
    printConstant("k2", law.kn, "N/m^2");
    printConstant("k3", law.kn3, "N/m^3");
  } else {
    printConstant("kn", law.kn, "N/m");
  }
}

/// Where e_t0 is not known, or not all there is to know.
void printRemarks(const ContactLaw& law, const ImpliedImpact& is) {
  if (law.tangential != TangentialLaw::none && !is.et0)
    fmt::print(
        "# e_t0 and what follows from it are known for coulomb_bound = \"compression\" only\n");
  if (is.firstTouchSticksToPsi)
    fmt::print("# e_t0 holds up to |Ψ_i| = µ γ_n/γ_t = {:.6g} only (spring_reset = \"total\")\n",
               *is.firstTouchSticksToPsi);
}

}  // namespace

void printLaw(const ContactLaw& law, const std::string& asked) {
  fmt::print("# {}\n[law]\n", asked);
  for (const LawOption& option : lawOptions()) {
    const bool asLoaded = option.get(law) == option.get(ContactLaw{});
    const bool always = std::ranges::find(alwaysPrinted, option.name) != alwaysPrinted.end();
    if (mattersTo(law, option.name) && (always || !asLoaded))
      fmt::print("{} = \"{}\"\n", option.name, lawOptionValue(law, option.name));
  }
  printStiffness(law);
  const char* const damping = law.damper == Damper::constant       ? "kg/s"
                              : law.damper == Damper::viscoelastic ? "s"
                                                                   : "-";
  printConstant("gn", law.gn, damping);
  if (law.tangential == TangentialLaw::none) return;
  if (law.mu > 0.0)
    printConstant("mu", law.mu, "-");
  else
    fmt::print("# mu = …   a case needs it; not given\n");
  if (law.kt > 0.0 && law.normal != NormalLaw::hertz) printConstant("kt", law.kt, "N/m");
  if (law.gt > 0.0 || law.tangential == TangentialLaw::springDashpot)
    printConstant("gt", law.gt, damping);
}

void printImpact(const ContactLaw& law, const CollidingPair& pair, std::optional<double> vn) {
  const ImpliedImpact is = impliedImpact(law, pair);
  const ReducedPair two = reduced(pair);
  const bool cut = law.conventions.tension == Tension::cut;
  fmt::print("\n# implied (normal frozen: slow impacts)\n");
  note("reduced mass m12, K = 1 + m12 Σ a²/J",
       fmt::format("{}, {}", number(two.mass, "kg"), number(two.K)));
  note("e_n", fmt::format("{:.6g}, with tension {}: {:.6g}", cut ? is.enCut : is.enAllowed,
                          cut ? "allowed" : "cut", cut ? is.enAllowed : is.enCut));
  note("contact time t_c", number(is.contactTime, "s"));
  note("suggested dt = t_c/50", number(is.contactTime / stepsPerContact, "s"));
  if (cut) note("π/ω, which steps_per_contact counts from", number(is.halfPeriod, "s"));
  note("ω, γ_n over critical",
       fmt::format("{}, {}", number(is.omega, "rad/s"), number(is.dampingRatio)));
  if (law.tangential != TangentialLaw::none) {
    note("e_t0 without slip", number(is.et0));
    if (law.kt > 0.0) {
      note("ω_t, γ_t over critical",
           fmt::format("{}, {}", number(is.omegaT, "rad/s"), number(is.dampingRatioT)));
      note("kt/kn", number(law.kt / law.kn));
    }
    note("sliding: Ψ_i − Ψ_f = K (1 + e_cut) µ", number(is.slidingConstant));
    note("sticking ends at Ψ* = K (1 + e_cut) µ/(1 + e_t0)", number(is.stickingEndsAtPsi));
  }
  const double radius = smallerRadius(pair);
  note("δ_max reaches 1 % of the smaller radius at v_n",
       number(softOverlap * radius / is.overlapPerSpeed, "m/s"));
  printRemarks(law, is);
  if (!vn) return;
  const double overlap = *vn * is.overlapPerSpeed;
  note(fmt::format("δ_max, δ_max/a at v_n = {} m/s", *vn),
       fmt::format("{}, {}", number(overlap, "m"), number(overlap / radius)));
  warnIfSoft(overlap / radius);
}

std::vector<CollisionEnd> headOnImpacts(const ContactLaw& law, const std::vector<NamedPair>& pairs,
                                        double speed) {
  ContactLaw normal = law;
  normal.tangential = TangentialLaw::none;
  std::vector<CollisionEnd> ends;
  for (const auto& [name, bodies] : pairs)
    ends.push_back(oracleOutcome(normal, bodies, {0.0, speed}));
  return ends;
}

void printStiffeningPairs(const std::vector<NamedPair>& pairs,
                          const std::vector<CollisionEnd>& ends, double speed) {
  fmt::print("\n# implied, at v_n = {:.6g} m/s\n", speed);
  fmt::print("# {:<12} {:>11} {:>8} {:>9} {:>11} {:>11} {:>9}\n", "pair", "m12 [kg]", "K", "e_n",
             "t_c [s]", "t_c/50 [s]", "δ_max/a");
  double largest = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const ReducedPair two = reduced(pairs[k].bodies);
    const double overlap = *ends[k].maxOverlap / smallerRadius(pairs[k].bodies);
    largest = std::max(largest, overlap);
    fmt::print("# {:<12} {:>11.4g} {:>8.4g} {:>9.4f} {:>11.4g} {:>11.4g} {:>9.2g}\n", pairs[k].name,
               two.mass, two.K, ends[k].en, *ends[k].duration, *ends[k].duration / stepsPerContact,
               overlap);
  }
  warnIfSoft(largest);
}

void printPairs(const ContactLaw& law, const std::vector<NamedPair>& pairs,
                std::optional<double> vn) {
  fmt::print("\n# implied (normal frozen: slow impacts){}\n",
             pairs.size() > 1 && law.gn > 0.0 && law.damper != Damper::critical
                 ? "; the constants are the same for all pairs, so restitutions are not"
                 : "");
  fmt::print("# {:<12} {:>11} {:>8} {:>9} {:>9} {:>11} {:>9} {:>9} {:>9} {:>11}{}\n", "pair",
             "m12 [kg]", "K", "e_n allow", "e_n cut", "t_c [s]", "e_t0", "sliding", "Ψ*",
             "t_c/50 [s]", vn ? fmt::format(" {:>9}", "δ_max/a") : "");
  double largest = 0.0;
  for (const auto& [name, bodies] : pairs) {
    const ImpliedImpact is = impliedImpact(law, bodies);
    const ReducedPair two = reduced(bodies);
    const double overlap = vn.value_or(0.0) * is.overlapPerSpeed / smallerRadius(bodies);
    largest = std::max(largest, overlap);
    const auto cell = [](std::optional<double> value) {
      return value ? fmt::format("{:.4f}", *value) : "-";
    };
    fmt::print(
        "# {:<12} {:>11.4g} {:>8.4g} {:>9.4f} {:>9.4f} {:>11.4g} {:>9} {:>9} {:>9} {:>11.4g}{}\n",
        name, two.mass, two.K, is.enAllowed, is.enCut, is.contactTime, cell(is.et0),
        cell(is.slidingConstant), cell(is.stickingEndsAtPsi), is.contactTime / stepsPerContact,
        vn ? fmt::format(" {:>9.2g}", overlap) : "");
  }
  printRemarks(law, impliedImpact(law, pairs.front().bodies));
  warnIfSoft(largest);
}

}  // namespace crossgrain::inline cli
