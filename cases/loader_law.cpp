#include <cmath>
#include <initializer_list>
#include <numbers>

#include "cases/loader_sections.hpp"
#include "law/law_options.hpp"

namespace crossgrain::inline cases {

LawConventions usualConventions() {
  LawConventions usual;
  usual.springReset = SpringReset::springOnly;
  usual.springUpdate = SpringUpdate::before;
  usual.leverArm = LeverArm::overlapMiddle;
  return usual;
}

namespace {

/// The keys of [law]: the constants, of which Hertz' law has materials instead, and what others
/// can be given by.
struct LawInput : ContactLaw {
  LawInput() { conventions = usualConventions(); }

  double krPerKt = 0.0, krFactor = 0.0;  ///< k_r = (…) k_t; k_r = (…) k_n µ_r²
  double gamma = 0.0;                    ///< surface energy, w or half of it
  std::string gammaIs = "half_of_w";
  double young[2] = {}, poisson[2] = {};  ///< of the two bodies, or twice the same
  bool ofPair = false;                    ///< [[law.pairs]]: may lack what [law] has
  double krOfLaw = 0.0;                   ///< of a pair without a bound, which no spring is seen of
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

std::vector<Key<LawInput>> lawTable() {
  std::vector<Key<LawInput>> keys;
  for (const LawOption& option : lawOptions()) {
    const Names names(option.values.begin(), option.values.end());
    const std::string standard =
        option.name == "tangential" ? "required (soft)" : printed(names[option.get(LawInput{})]);
    keys.push_back(special<LawInput>(
        {std::string(option.name), "", standard, valuesOf(names), std::string(option.meaning)},
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
          "rigid: tangential restitution of a sticking contact"),
      key("mu_r", &ContactLaw::muR, atLeast(0.0),
          "coefficient of rolling resistance, > 0; `viscous_by_load`: in s/m")
          .listed("required with rolling (not viscous)"),
      key("kr", &ContactLaw::kr, atLeast(0.0, "N/m"),
          "rolling stiffness, > 0, as `rolling_stiffness` says")
          .listed("required with rolling = spring"),
      key("kr_per_kt", &LawInput::krPerKt, atLeast(0.0),
          "in place of `kr`: k_r = k_t times this (1: Iwashita and Oda 1998)"),
      key("kr_factor", &LawInput::krFactor, atLeast(0.0),
          "in place of `kr`: k_r = k_n µ_r² times this (2.25: spheres, Ai et al. 2011; 3: disks, "
          "Jiang et al. 2005)"),
      special<LawInput>({"gr", "kg/s; –", "0", valuesOf(atLeast(0.0)),
                         "rolling damping, in the unit of `rolling_damper`; `viscous`: > 0"},
                        [](Reader& in, const std::string& key, LawInput& law) {
                          const bool critical =
                              law.conventions.rollingDamper == RollingDamper::critical;
                          in.read(key, law.gr, atLeast(0.0, critical ? "" : "kg/s"));
                        }),
      special<LawInput>({"kc", "Pa; N/m", "required (area); 0", valuesOf(atLeast(0.0)),
                         "`area`: pull per area, > 0; `elasto_plastic`: its stiffness"},
                        [](Reader& in, const std::string& key, LawInput& law) {
                          const bool area = law.cohesion == CohesionLaw::area;
                          in.read(key, law.kc, atLeast(0.0, area ? "Pa" : "N/m"));
                        }),
      key("w", &ContactLaw::w, atLeast(0.0, "J/m^2"), "work of adhesion, > 0")
          .listed("required (dmt, jkr)"),
      key("gamma", &LawInput::gamma, atLeast(0.0, "J/m^2"), "in place of `w`: surface energy")
          .listed(""),
      key("gamma_is", &LawInput::gammaIs, Names{"half_of_w", "w"},
          "what `gamma` means: w = 2 γ, or w = γ"),
      key("k_unload", &ContactLaw::kUnload, atLeast(0.0, "N/m"),
          "the largest stiffness of unloading, > `kn`")
          .listed("required (elasto_plastic)"),
      key("plastic_depth", &ContactLaw::plasticDepth, atLeast(0.0),
          "φ: overlap at zero force, as a share of 2 R₁₂, from which unloading is that stiff; 0: "
          "always")
          .listed("0")};
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

void demand(const Reader& in, std::string_view key, double value, std::string_view of) {
  if (!in.has(key)) in.failMissing(key, fmt::format("{} needs it > 0", of));
  in.check(value > 0.0, key, "{} needs it > 0", of);
}

/// A pair may be without it.
void demandUnlessPair(const Reader& in, std::string_view key, double value, std::string_view of,
                      const LawInput& law) {
  if (!law.ofPair || !in.has(key) || value > 0.0) demand(in, key, value, of);
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
void settleTangential(const Reader& in, LawInput& law) {
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
    demandUnlessPair(in, "gt", law.gt, "a viscous law", law);
  else if (law.tangential != TangentialLaw::springDashpot)
    law.gt = 0.0;
  else if (!in.has("gt"))
    in.failMissing("gt", "a spring_dashpot law has one, if only of 0");
  demandUnlessPair(in, "mu", law.mu, "a tangential law", law);
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
  in.notBeside("e_n", "gn");
  in.check(law.en > 0.0, "e_n", "a soft law needs it > 0");
  const double log = std::log(law.en);
  const double fraction = law.normal == NormalLaw::hertz ? std::sqrt(5.0 / 6.0) : 1.0;
  law.gn = -2.0 * fraction * log / std::hypot(std::numbers::pi, log);
  law.en = 1.0;
}

/// Constants that the part `without` asks for and the law lacks: may be given as zero.
void refuseAll(const Reader& in, std::initializer_list<std::pair<const char*, double>> constants,
               const char* without) {
  for (const auto& [key, value] : constants)
    refuse(in, key, value, fmt::format("{} without {}", key, without));
}

/// k_r as it is, per k_t or per k_n µ_r².
void setRollingStiffness(const Reader& in, LawInput& law) {
  const int given = in.has("kr") + in.has("kr_per_kt") + in.has("kr_factor");
  in.check(given < 2, in.has("kr") ? "kr" : "kr_factor", "one of kr, kr_per_kt and kr_factor");
  if (given == 0) in.failMissing("kr", "a rolling spring needs it > 0, or kr_per_kt or kr_factor");
  for (const auto& [key, factor, of] : {std::tuple{"kr_per_kt", law.krPerKt, law.kt},
                                        {"kr_factor", law.krFactor, law.kn * law.muR * law.muR}}) {
    if (!in.has(key)) continue;
    if (law.ofPair && law.muR == 0.0) {
      law.kr = law.krOfLaw;
      return;
    }
    in.check(law.normal == NormalLaw::linear, key,
             "a linear law's stiffness is a constant: give kr");
    in.check(law.conventions.rollingStiffness != RollingStiffness::constant, key,
             "[N/m], and rolling_stiffness = \"constant\" is [N m]: give kr");
    in.check(factor > 0.0 && of > 0.0, key, "a rolling spring needs it > 0, and what it is times");
    law.kr = factor * of;
  }
  if (in.has("kr")) demand(in, "kr", law.kr, "a rolling spring");
}

/// Checks what the rolling law needs, and clears what it does not use, as of friction.
void settleRolling(const Reader& in, LawInput& law) {
  if (!law.rolls())
    return refuseAll(in,
                     {{"mu_r", law.muR},
                      {"kr", law.kr},
                      {"kr_per_kt", law.krPerKt},
                      {"kr_factor", law.krFactor},
                      {"gr", law.gr}},
                     "rolling resistance (law.rolling is none)");
  if (law.rolling == RollingLaw::viscous) {
    demand(in, "gr", law.gr, "viscous rolling resistance");
    law.muR = 0.0;
  } else {
    demandUnlessPair(in, "mu_r", law.muR, "this rolling resistance", law);
  }
  if (law.rolling == RollingLaw::spring)
    setRollingStiffness(in, law);
  else
    law.kr = 0.0;
  if (law.rolling != RollingLaw::viscous && law.rolling != RollingLaw::spring) law.gr = 0.0;
}

/// The same of cohesion.
void settleCohesion(const Reader& in, LawInput& law) {
  if (!law.coheres())
    return refuseAll(in,
                     {{"kc", law.kc},
                      {"w", law.w},
                      {"gamma", law.gamma},
                      {"k_unload", law.kUnload},
                      {"plastic_depth", law.plasticDepth}},
                     "cohesion (law.cohesion is none)");
  const bool bySurface = law.cohesion == CohesionLaw::dmt || law.cohesion == CohesionLaw::jkr;
  const bool yields = law.cohesion == CohesionLaw::elastoPlastic;
  if (law.cohesion == CohesionLaw::jkr)
    in.check(law.normal == NormalLaw::hertz, "cohesion",
             "\"jkr\" is Hertz' law with adhesion: it needs normal = \"hertz\"");
  if (yields)
    in.check(law.normal == NormalLaw::linear, "cohesion",
             "\"elasto_plastic\" is piecewise linear: it needs normal = \"linear\"");
  if (bySurface) {
    in.notBeside("gamma", "w");
    const char* const given = in.has("gamma") ? "gamma" : "w";
    const double value = in.has("gamma") ? law.gamma : law.w;
    if (law.cohesion == CohesionLaw::jkr)
      demand(in, given, value, "a bond of JKR's");
    else
      demandUnlessPair(in, given, value, "adhesion", law);
    if (in.has("gamma")) law.w = law.gammaIs == "w" ? law.gamma : 2.0 * law.gamma;
    law.kc = 0.0;
  } else {
    law.w = 0.0;
  }
  if (law.cohesion == CohesionLaw::area)
    demandUnlessPair(in, "kc", law.kc, "cohesion by area", law);
  if (yields) {
    demand(in, "k_unload", law.kUnload, "an elasto-plastic law");
    in.check(law.kUnload > law.kn, "k_unload", "unloading is stiffer than loading: more than kn");
  } else {
    law.kUnload = law.plasticDepth = 0.0;
  }
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
  settleRolling(in, law);
  settleCohesion(in, law);
}

void settleRigid(const Reader& in, LawInput& law) {
  in.check(!law.rolls(), "rolling", "a rigid law has no rolling resistance");
  in.check(!law.coheres(), "cohesion", "a rigid law has no cohesion");
  if (!in.has("e_n")) in.failMissing("e_n", "a rigid law needs it");
  for (const auto& [key, value] :
       {std::pair{"kn", law.kn}, {"gn", law.gn}, {"kt", law.kt}, {"gt", law.gt}})
    refuse(in, key, value, "a rigid law has none");
  if (!in.has("tangential"))
    law.tangential = law.mu > 0.0 ? TangentialLaw::coulomb : TangentialLaw::none;
  if (law.tangential == TangentialLaw::coulomb)
    demandUnlessPair(in, "mu", law.mu, "a tangential law", law);
  else if (law.tangential != TangentialLaw::none)
    in.fail("tangential", "a rigid law has none or coulomb");
  else
    refuse(in, "mu", law.mu, "mu without friction (law.tangential is none)");
}

}  // namespace

namespace {

/// Keys that two materials cannot differ in.
bool isOption(const std::string& key) {
  return key == "gamma_is" || std::ranges::count(lawOptions(), key, &LawOption::name) > 0;
}

SectionInfo pairSection() {
  SectionInfo info{.name = "law.pairs",
                   .note =
                       "Constants of two materials. Constants not given, all options and effects "
                       "are those of `[law]`.",
                   .isList = true,
                   .keys = {{"between", "", "required", "", "the two, or twice the same"}}};
  for (KeyInfo key : lawKeys().info().keys) {
    if (isOption(key.name)) continue;
    key.standard = "that of `[law]`";
    key.meaning = "as in `[law]`";
    info.keys.push_back(key);
  }
  return info;
}

void settle(Reader& in, LawInput& input, bool ofTwoBodies) {
  lawKeys().read(in, input);
  if (input.normal != NormalLaw::hertz) refuseKeys(in, {"young", "poisson"}, "normal = \"hertz\"");
  if (input.normal != NormalLaw::polynomial)
    refuseKeys(in, {"k2", "k3"}, "normal = \"polynomial\"");
  if (input.soft())
    settleSoft(in, input, ofTwoBodies);
  else
    settleRigid(in, input);
}

/// Of keys that stand for each other, those that a pair puts out of use in [law] by giving one.
Names replaced(const Reader& pair) {
  Names hidden;
  for (const Names& same : {Names{"gn", "e_n"}, {"w", "gamma"}, {"kr", "kr_per_kt", "kr_factor"}})
    if (std::ranges::any_of(same, [&](const std::string& key) { return pair.has(key); }))
      hidden.insert(hidden.end(), same.begin(), same.end());
  return hidden;
}

/// A part that a pair has and [law] has not would be an effect that engines do not look for.
void refuseNewEffects(const Reader& in, const ContactLaw& pair, const ContactLaw& law) {
  const auto check = [&](bool is, bool may, const char* key) {
    if (in.has(key))
      in.check(!is || may, key, "[law] is without it, and pairs have no effect that it has not");
  };
  check(pair.gn > 0.0, law.gn > 0.0, in.has("e_n") ? "e_n" : "gn");
  if (!pair.soft()) check(pair.en < 1.0, law.en < 1.0, "e_n");
  check(pair.gt > 0.0, law.gt > 0.0, "gt");
  check(pair.mu > 0.0, law.mu > 0.0, "mu");
}

}  // namespace

std::vector<SectionInfo> lawSections() {
  return {lawKeys().info(), pairSection()};
}

void readPairLaws(const Reader& law, std::vector<Reader>& pairs, Case& c) {
  if (pairs.empty()) return;
  std::vector<std::pair<Names, ContactLaw>> found;
  Names names;
  for (Reader& pair : pairs) {
    Names between;
    pair.require("between", between);
    if (!pair.has("between")) pair.failMissing("between");
    pair.check(between.size() == 2, "between", "must be two materials");
    for (const std::string& key : pair.keys())
      if (isOption(key)) pair.fail(key, "an option is that of [law] for all pairs");
    for (const auto& [others, theirs] : found)
      pair.check(!std::ranges::is_permutation(others, between), "between", "is there twice");
    LawInput input;
    input.dimension = c.law.dimension;
    input.ofPair = true;
    input.krOfLaw = c.law.kr;
    Reader both = pair.above(law, replaced(pair));
    settle(both, input, true);
    refuseNewEffects(both, input, c.law);
    for (const std::string& name : between)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    found.emplace_back(between, input);
  }
  Materials& materials = c.materials.emplace();
  materials.names = names;
  materials.laws.assign(names.size() * names.size(), c.law);
  const auto indexOf = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  for (const auto& [between, own] : found) {
    const std::size_t a = indexOf(between[0]), b = indexOf(between[1]);
    materials.laws[a * names.size() + b] = materials.laws[b * names.size() + a] = own;
  }
}

void readLaw(Reader& in, ContactLaw& contact, bool ofTwoBodies) {
  LawInput input;
  input.dimension = contact.dimension;
  settle(in, input, ofTwoBodies);
  if (!input.inSpace())
    for (const LawOption& option : lawOptions())
      if (option.part == LawPart::space && in.has(option.name))
        in.fail(option.name, "only a law in space has it (case.dimension = 3)");
  contact = input;
}

}  // namespace crossgrain::inline cases
