#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "adapters/law_options.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

void readOptions(Reader& in, ContactLaw& law) {
  for (const LawOption& option : lawOptions()) {
    const std::vector<std::string> names(option.values.begin(), option.values.end());
    std::string name = names[option.get(law)];
    in.read(option.name, name, names);
    setLawOption(law, option.name, name);
  }
}

void demand(const Reader& in, std::string_view key, double value, std::string_view of) {
  const std::string needs = fmt::format("{} needs it > 0", of);
  if (!in.has(key)) in.failMissing(key, needs);
  if (!(value > 0.0)) in.fail(key, needs);
}

/// A parameter that the law does not have may be given as zero, so that variants can switch it off.
void refuse(const Reader& in, std::string_view key, double value, std::string_view reason) {
  if (value > 0.0) in.fail(key, fmt::format("{}: set it to 0 or leave it out", reason));
}

void demandSpring(const Reader& in, const ContactLaw& law) {
  if (law.normal != NormalLaw::hertz) demand(in, "kt", law.kt, "a spring law");
}

/// Checks what the tangential law needs, and clears what it has no use for: the thesis' table 4.1
/// serves all its laws.
void settleTangential(const Reader& in, ContactLaw& law) {
  switch (law.tangential) {
    case TangentialLaw::none:
      for (const auto& [key, value] : {std::pair{"mu", law.mu}, {"kt", law.kt}, {"gt", law.gt}})
        refuse(in, key, value, fmt::format("{} without friction (law.tangential is none)", key));
      return;
    case TangentialLaw::coulomb:
      law.kt = law.gt = 0.0;
      break;
    case TangentialLaw::viscous:
      demand(in, "gt", law.gt, "a viscous law");
      law.kt = 0.0;
      break;
    case TangentialLaw::spring:
      demandSpring(in, law);
      law.gt = 0.0;
      break;
    case TangentialLaw::springDashpot:
      demandSpring(in, law);
      if (!in.has("gt")) in.failMissing("gt", "a spring_dashpot law has one, if only of 0");
      break;
  }
  demand(in, "mu", law.mu, "a tangential law");
}

/// What the keys of one kind of elastic force are for; the others refuse them.
void refuseKeys(const Reader& in, std::initializer_list<const char*> keys, std::string_view takes) {
  for (const char* const key : keys)
    if (in.has(key)) in.fail(key, fmt::format("only {} takes it", takes));
}

/// Young's modulus and Poisson's ratio of the first body and the second; inf: rigid.
struct Material {
  double young[2], poisson[2];
};

/// @param ofTwoBodies  in a collision; elsewhere every contact would be one of the first material
/// with
///                     the second, and no disk has one of its own
Material readMaterial(Reader& in, bool ofTwoBodies) {
  Material material{};
  Range stiff = positive("Pa");
  stiff.mayBeInfinite = true;
  requirePair(in, "young", material.young, stiff);
  requirePair(in, "poisson", material.poisson, between(0.0, 0.5));
  for (const auto& [key, values] :
       {std::pair{"young", material.young}, {"poisson", material.poisson}})
    if (!ofTwoBodies && values[0] != values[1])
      in.fail(key,
              "the values of two bodies belong to a collision; here all disks and walls are of one "
              "material: give one value");
  if (std::isinf(material.young[0]) && std::isinf(material.young[1]))
    in.fail("young", "one of two bodies must give way");
  return material;
}

/// k_n = 4/3 E₁₂ with 1/E₁₂ = Σ (1 − ν²)/E, k_t = 8 G₁₂ with 1/G₁₂ = Σ (2 − ν)/G,
/// G = E/(2(1 + ν)) (Johnson 1985, Eqs. 4.22 and 7.43).
void setHertz(ContactLaw& law, const Material& material) {
  double normal = 0.0, tangential = 0.0;
  for (const int side : {0, 1}) {
    const double young = material.young[side], poisson = material.poisson[side];
    normal += (1.0 - poisson * poisson) / young;
    tangential += (2.0 - poisson) * 2.0 * (1.0 + poisson) / young;
  }
  law.kn = 4.0 / 3.0 / normal;
  law.kt = 8.0 / tangential;
}

/// A dashpot that is to give e_n at every speed: γ = −2 c ln e_n/√(π² + ln² e_n) with c = 1 for a
/// linear law and √(5/6) for Hertz' (Tsuji et al. 1992; Antypov and Elliott 2011), tension allowed.
void setRestitution(const Reader& in, ContactLaw& law) {
  if (law.damper != Damper::critical || law.normal == NormalLaw::polynomial)
    in.fail("e_n", "a rigid law takes it, and a linear or Hertz law with damper = \"critical\"");
  if (in.has("gn")) in.fail("e_n", "and gn: give one of them");
  if (!(law.en > 0.0)) in.fail("e_n", "a soft law needs it > 0");
  const double log = std::log(law.en);
  const double fraction = law.normal == NormalLaw::hertz ? std::sqrt(5.0 / 6.0) : 1.0;
  law.gn = -2.0 * fraction * log / std::hypot(std::numbers::pi, log);
  law.en = 1.0;
}

void settleSoft(Reader& in, ContactLaw& law) {
  refuseKeys(in, {"e_t0"}, "a rigid law");
  if (in.has("e_n"))
    setRestitution(in, law);
  else if (!in.has("gn"))
    in.failMissing("gn", "an undamped law says 0");
  if (!in.has("tangential")) in.failMissing("tangential", "a frictionless law says none");
  settleTangential(in, law);
}

void settleLinear(Reader& in, ContactLaw& law) {
  refuseKeys(in, {"young", "poisson"}, "normal = \"hertz\"");
  refuseKeys(in, {"k2", "k3"}, "normal = \"polynomial\"");
  demand(in, "kn", law.kn, "a linear law");
  settleSoft(in, law);
}

void settleHertz(Reader& in, ContactLaw& law) {
  refuseKeys(in, {"kn", "kt"}, "a law that does not get it from young and poisson");
  refuseKeys(in, {"k2", "k3"}, "normal = \"polynomial\"");
  for (const char* const key : {"young", "poisson"})
    if (!in.has(key)) in.failMissing(key, "Hertz' law needs it");
  if (!law.springs()) law.kt = 0.0;
  settleSoft(in, law);
}

void settlePolynomial(Reader& in, ContactLaw& law) {
  refuseKeys(in, {"young", "poisson"}, "normal = \"hertz\"");
  refuseKeys(in, {"kn"}, "normal = \"linear\"");
  demand(in, "k2", law.kn, "a polynomial law");
  settleSoft(in, law);
}

void settleRigid(const Reader& in, ContactLaw& law) {
  refuseKeys(in, {"young", "poisson"}, "normal = \"hertz\"");
  refuseKeys(in, {"k2", "k3"}, "normal = \"polynomial\"");
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

void readLaw(Reader& in, ContactLaw& law, bool ofTwoBodies) {
  readOptions(in, law);
  const char* const damping = law.damper == Damper::constant       ? "kg/s"
                              : law.damper == Damper::viscoelastic ? "s"
                                                                   : "";
  in.read("kn", law.kn, atLeast(0.0, "N/m"));
  in.read("k2", law.kn, atLeast(0.0, "N/m^2"));
  in.read("k3", law.kn3, Range{});
  in.read("gn", law.gn, atLeast(0.0, damping));
  in.read("kt", law.kt, atLeast(0.0, "N/m"));
  in.read("gt", law.gt, atLeast(0.0, damping));
  in.read("mu", law.mu, atLeast(0.0));
  in.read("e_n", law.en, between(0.0, 1.0));
  in.read("e_t0", law.et0, between(0.0, 1.0));
  if (law.normal == NormalLaw::hertz && in.has("young") && in.has("poisson"))
    setHertz(law, readMaterial(in, ofTwoBodies));
  in.take("young");
  in.take("poisson");
  in.finish();
  switch (law.normal) {
    case NormalLaw::linear:
      return settleLinear(in, law);
    case NormalLaw::hertz:
      return settleHertz(in, law);
    case NormalLaw::polynomial:
      return settlePolynomial(in, law);
    case NormalLaw::rigid:
      return settleRigid(in, law);
  }
}

}  // namespace crossgrain::inline cases
