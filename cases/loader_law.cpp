#include <cmath>
#include <initializer_list>
#include <numbers>

#include "adapters/law_options.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

/// The keys of [law]: the constants, of which Hertz' law has materials instead.
struct LawInput : ContactLaw {
  double young[2] = {}, poisson[2] = {};  ///< of the two bodies, or twice the same
};

const char* dampingUnit(const ContactLaw& law) {
  return law.damper == Damper::constant ? "kg/s" : law.damper == Damper::viscoelastic ? "s" : "";
}

Key<LawInput> damping(const char* name, double ContactLaw::*gamma, const char* standard,
                      const char* meaning) {
  return special<LawInput>({name, "kg/s; s; –", standard, valuesOf(atLeast(0.0)), meaning},
                           [=](Reader& in, const std::string& key, LawInput& law) {
                             in.read(key, law.*gamma, atLeast(0.0, dampingUnit(law)));
                           });
}

/// What the options of the law mean; their values are listed with them.
constexpr std::pair<const char*, const char*> optionMeanings[] = {
    {"normal", "elastic part of f_n: k_n δ; 4/3 E₁₂ √R₁₂ δ^(3/2); k₂ δ² + k₃ δ³; or restitutions"},
    {"damper",
     "what γ_n and γ_t multiply besides the velocity: 1, the stiffness, or √(m₁₂ · stiffness)"},
    {"tangential", "tangential law; rigid: `coulomb` if `mu` > 0, else `none`"},
    {"tension", "f_n as it is, or max(f_n, 0)"},
    {"coulomb_bound", "µ max(f_n, 0), µ|f_n|, µ f_n"},
    {"dashpot", "whether γ_t v_t is part of the trial force that the bound limits"},
    {"spring_reset", "on slip ξ = −f_t/k_t, or −(f_t + γ_t v_t)/k_t"},
    {"spring_update", "ξ grows by v_t dt after or before the force, or by half of it on each side"},
    {"lever_arm",
     "a_i (does not conserve angular momentum), a_i − δ a_j/(a_i + a_j), or a_i − δ/2"},
    {"velocity_arm", "the arm of the spins in v_t; `lever_arm`: that of f_t"},
    {"plane_arm", "what an arm other than `radius` is at a plane: a_i − δ, a_i − δ/2, a_i"},
    {"history", "what a Hertz contact remembers: ξ, or the force, which grows by −k_t v_t dt"},
    {"damping_velocity",
     "in the dashpots: v(t − dt/2), v(t − dt/2) + a dt/2, or the one that the force makes"},
    {"integrator", "the scheme of the in-house engine"}};

std::vector<Key<LawInput>> lawTable() {
  std::vector<Key<LawInput>> keys;
  for (const LawOption& option : lawOptions()) {
    const Names names(option.values.begin(), option.values.end());
    const auto* const meaning = std::ranges::find(
        optionMeanings, option.name, [](const auto& each) { return std::string_view(each.first); });
    const std::string standard =
        option.name == "tangential" ? "required (soft)" : printed(names[option.get(ContactLaw{})]);
    keys.push_back(special<LawInput>(
        {std::string(option.name), "", standard, valuesOf(names), meaning->second},
        [names, &option](Reader& in, const std::string& key, LawInput& law) {
          std::string name = names[option.get(law)];
          in.read(key, name, names);
          setLawOption(law, option.name, name);
        }));
  }
  Range stiff = positive("Pa");
  stiff.mayBeInfinite = true;
  const Key<LawInput> constants[] = {
      key("kn", &ContactLaw::kn, atLeast(0.0, "N/m"), "normal stiffness, > 0")
          .listed("required (linear)"),
      key("young", &LawInput::young, stiff,
          "one number, or two of the bodies of a collision; `inf`: rigid")
          .listed("required (hertz)"),
      key("poisson", &LawInput::poisson, between(0.0, 0.5), "one number, or two")
          .listed("required (hertz)"),
      key("k2", &ContactLaw::kn, atLeast(0.0, "N/m^2"), "of the overlap's square, > 0")
          .listed("required (polynomial)"),
      key("k3", &ContactLaw::kn3, anyNumber("N/m^3"), "of its cube: < 0 softens")
          .listed("0 (polynomial)"),
      damping("gn", &ContactLaw::gn, "required (soft)",
              "normal damping, in the unit of `damper`; linear: below critical"),
      key("mu", &ContactLaw::mu, atLeast(0.0), "Coulomb's coefficient, > 0")
          .listed("required with friction"),
      key("kt", &ContactLaw::kt, atLeast(0.0, "N/m"), "tangential stiffness, > 0")
          .listed("required with a spring (not hertz)"),
      damping("gt", &ContactLaw::gt, "required with a dashpot",
              "tangential damping, as `gn` (> 0 for `viscous`)"),
      key("e_n", &ContactLaw::en, between(0.0, 1.0),
          "normal restitution; in place of `gn` with `damper = \"critical\"`")
          .listed("required (rigid)"),
      key("e_t0", &ContactLaw::et0, between(0.0, 1.0),
          "rigid: tangential restitution of a sticking contact")};
  keys.insert(keys.end(), std::begin(constants), std::end(constants));
  return keys;
}

const Section<LawInput>& lawKeys() {
  static const Section<LawInput> section(
      {.name = "law",
       .note = "With n from j to i, s = z × n, δ > 0 in contact, v_n < 0 on approach, v_t = (v_i − "
               "v_j)·s − (a_i ω_i + a_j ω_j)."},
      lawTable());
  return section;
}

const Section<BottomPlate>& bottomKeys() {
  static const Section<BottomPlate> section(
      {.name = "bottom",
       .kinds = "couette, assembly",
       .commands = "compare plan lockstep identify baseline record effects cost stability collide "
                   "scale",
       .note = "Leave it out for no plate."},
      {need("mu", &BottomPlate::mu, atLeast(0.0), "µ_b"),
       need("kb", &BottomPlate::kb, atLeast(0.0, "N/m"), "spring of a disk on the plate"),
       need("gb", &BottomPlate::gb, atLeast(0.0, "kg/s"), "dashpot"),
       need("tau_m", &BottomPlate::tauM, atLeast(0.0), "τ_M of Eq. 4.28"),
       key("gravity", &BottomPlate::gravity, positive("m/s^2"), "presses disks on the plate"),
       key("spin", &BottomPlate::spin, any, "whether the plate also brakes spin")});
  return section;
}

void demand(const Reader& in, std::string_view key, double value, std::string_view of) {
  if (!in.has(key)) in.failMissing(key, fmt::format("{} needs it > 0", of));
  in.check(value > 0.0, key, "{} needs it > 0", of);
}

/// A parameter that the law does not have may be given as zero, so that variants can switch it off.
void refuse(const Reader& in, std::string_view key, double value, std::string_view reason) {
  if (value > 0.0) in.fail(key, "{}: set it to 0 or leave it out", reason);
}

/// Keys of one kind of elastic force, which the others refuse.
void refuseKeys(const Reader& in, std::initializer_list<const char*> keys, std::string_view takes) {
  for (const char* const key : keys)
    if (in.has(key)) in.fail(key, "only {} takes it", takes);
}

/// Checks what the tangential law needs, and clears what it does not use: the thesis' table 4.1
/// serves all its laws.
void settleTangential(const Reader& in, ContactLaw& law) {
  if (law.tangential == TangentialLaw::none) {
    for (const auto& [key, value] : {std::pair{"mu", law.mu}, {"kt", law.kt}, {"gt", law.gt}})
      refuse(in, key, value, fmt::format("{} without friction (law.tangential is none)", key));
    return;
  }
  if (!law.springs())
    law.kt = 0.0;
  else if (law.normal != NormalLaw::hertz)
    demand(in, "kt", law.kt, "a spring law");
  if (law.tangential == TangentialLaw::viscous)
    demand(in, "gt", law.gt, "a viscous law");
  else if (law.tangential != TangentialLaw::springDashpot)
    law.gt = 0.0;
  else if (!in.has("gt"))
    in.failMissing("gt", "a spring_dashpot law has one, if only of 0");
  demand(in, "mu", law.mu, "a tangential law");
}

/// k_n = 4/3 E₁₂ with 1/E₁₂ = Σ (1 − ν²)/E, k_t = 8 G₁₂ with 1/G₁₂ = Σ (2 − ν)/G,
/// G = E/(2(1 + ν)) (Johnson 1985, Eqs. 4.22 and 7.43).
/// @param ofTwoBodies  else every contact would be one of the first material with the second
void setHertz(const Reader& in, LawInput& law, bool ofTwoBodies) {
  double normal = 0.0, tangential = 0.0;
  for (const int side : {0, 1}) {
    const double young = law.young[side], poisson = law.poisson[side];
    normal += (1.0 - poisson * poisson) / young;
    tangential += (2.0 - poisson) * 2.0 * (1.0 + poisson) / young;
  }
  for (const auto& [key, values] : {std::pair{"young", law.young}, {"poisson", law.poisson}})
    in.check(ofTwoBodies || values[0] == values[1], key,
             "the values of two bodies belong to a collision; here all disks and walls are of one "
             "material: give one value");
  in.check(normal > 0.0, "young", "one of two bodies must give way");
  law.kn = 4.0 / 3.0 / normal;
  law.kt = law.springs() ? 8.0 / tangential : 0.0;
}

/// A dashpot that is to give e_n at every speed: γ = −2 c ln e_n/√(π² + ln² e_n) with c = 1 for a
/// linear law and √(5/6) for Hertz' (Tsuji et al. 1992; Antypov and Elliott 2011), tension allowed.
void setRestitution(const Reader& in, ContactLaw& law) {
  in.check(law.damper == Damper::critical && law.normal != NormalLaw::polynomial, "e_n",
           "a rigid law takes it, and a linear or Hertz law with damper = \"critical\"");
  in.check(!in.has("gn"), "e_n", "and gn: give one of them");
  in.check(law.en > 0.0, "e_n", "a soft law needs it > 0");
  const double log = std::log(law.en);
  const double fraction = law.normal == NormalLaw::hertz ? std::sqrt(5.0 / 6.0) : 1.0;
  law.gn = -2.0 * fraction * log / std::hypot(std::numbers::pi, log);
  law.en = 1.0;
}

void settleSoft(const Reader& in, LawInput& law, bool ofTwoBodies) {
  refuseKeys(in, {"e_t0"}, "a rigid law");
  if (law.normal == NormalLaw::linear) {
    demand(in, "kn", law.kn, "a linear law");
  } else if (law.normal == NormalLaw::hertz) {
    refuseKeys(in, {"kn", "kt"}, "a law that does not get it from young and poisson");
    for (const char* const key : {"young", "poisson"})
      if (!in.has(key)) in.failMissing(key, "Hertz' law needs it");
    setHertz(in, law, ofTwoBodies);
  } else {
    refuseKeys(in, {"kn"}, "normal = \"linear\"");
    demand(in, "k2", law.kn, "a polynomial law");
  }
  if (in.has("e_n"))
    setRestitution(in, law);
  else if (!in.has("gn"))
    in.failMissing("gn", "an undamped law says 0");
  if (!in.has("tangential")) in.failMissing("tangential", "a frictionless law says none");
  settleTangential(in, law);
}

void settleRigid(const Reader& in, ContactLaw& law) {
  if (!in.has("e_n")) in.failMissing("e_n", "a rigid law needs it");
  for (const auto& [key, value] :
       {std::pair{"kn", law.kn}, {"gn", law.gn}, {"kt", law.kt}, {"gt", law.gt}})
    refuse(in, key, value, "a rigid law has none");
  if (!in.has("tangential"))
    law.tangential = law.mu > 0.0 ? TangentialLaw::coulomb : TangentialLaw::none;
  if (law.tangential == TangentialLaw::coulomb)
    demand(in, "mu", law.mu, "a tangential law");
  else if (law.tangential != TangentialLaw::none)
    in.fail("tangential", "a rigid law has none or coulomb");
  else
    refuse(in, "mu", law.mu, "mu without friction (law.tangential is none)");
}

}  // namespace

std::vector<SectionInfo> lawSections() {
  return {lawKeys().info(), bottomKeys().info()};
}

void readLaw(Reader& in, ContactLaw& contact, bool ofTwoBodies) {
  LawInput input;
  lawKeys().read(in, input);
  if (input.normal != NormalLaw::hertz) refuseKeys(in, {"young", "poisson"}, "normal = \"hertz\"");
  if (input.normal != NormalLaw::polynomial)
    refuseKeys(in, {"k2", "k3"}, "normal = \"polynomial\"");
  if (input.soft())
    settleSoft(in, input, ofTwoBodies);
  else
    settleRigid(in, input);
  contact = input;
}

void readBottom(Reader& root, std::optional<BottomPlate>& plate) {
  Reader in = root.section("bottom");
  if (!root.has("bottom")) return;
  bottomKeys().read(in, plate.emplace());
  if (plate->mu == 0.0) plate.reset();
}

}  // namespace crossgrain::inline cases
