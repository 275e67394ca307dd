#include <fmt/format.h>

#include "adapters/law_options.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain {
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
      demand(in, "kt", law.kt, "a spring law");
      law.gt = 0.0;
      break;
    case TangentialLaw::springDashpot:
      demand(in, "kt", law.kt, "a spring law");
      if (!in.has("gt")) in.failMissing("gt", "a spring_dashpot law has one, if only of 0 kg/s");
      break;
  }
  demand(in, "mu", law.mu, "a tangential law");
}

void settleLinear(const Reader& in, ContactLaw& law) {
  demand(in, "kn", law.kn, "a linear law");
  if (!in.has("gn")) in.failMissing("gn", "an undamped law says 0 kg/s");
  for (const char* const key : {"e_n", "e_t0"})
    if (in.has(key)) in.fail(key, "only a rigid law takes it (law.normal is linear)");
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

void readLaw(Reader& in, ContactLaw& law) {
  readOptions(in, law);
  in.read("kn", law.kn, atLeast(0.0, "N/m"));
  in.read("gn", law.gn, atLeast(0.0, "kg/s"));
  in.read("kt", law.kt, atLeast(0.0, "N/m"));
  in.read("gt", law.gt, atLeast(0.0, "kg/s"));
  in.read("mu", law.mu, atLeast(0.0));
  in.read("e_n", law.en, between(0.0, 1.0));
  in.read("e_t0", law.et0, between(0.0, 1.0));
  in.finish();
  if (law.normal == NormalLaw::rigid)
    settleRigid(in, law);
  else
    settleLinear(in, law);
}

}  // namespace crossgrain
