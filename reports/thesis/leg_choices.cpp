#include "reports/thesis/leg_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/thesis_claims.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

LegSettings settingsOf(const ThesisLeg& leg) {
  const double mass = legChoices(leg.caseToml).largeMass.value_or(0.0);
  return {leg.cell.wallSpacing, leg.cell.smallRadius, mass, leg.cell.omega, leg.kn, leg.mu,
          leg.bottomFriction};
}

bool sameSetting(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool sameLaw(const LegSettings& a, const LegSettings& b) {
  return sameSetting(a.kn, b.kn) && sameSetting(a.mu, b.mu) && a.bottomFriction == b.bottomFriction;
}

std::string wordsOf(const OpenChoice& open, const LegSettings& of) {
  return fmt::format("{} {} {}", open.words, readableSetting(of.*open.value / open.unit),
                     open.unitName);
}

std::string wordsOfRate(const LegSettings& of) {
  return fmt::format("Ω = {} /s", readableSetting(of.omega));
}

bool sameBut(const OpenChoice* but, bool anyRate, const LegSettings& a, const LegSettings& b) {
  const bool open = std::ranges::all_of(openChoices, [&](const OpenChoice& each) {
    return &each == but || sameSetting(a.*each.value, b.*each.value);
  });
  return open && sameLaw(a, b) && (anyRate || sameSetting(a.omega, b.omega));
}

bool isOf(const ThesisLeg& leg, std::string_view family) {
  return std::ranges::find(leg.families, family) != leg.families.end();
}

const ThesisLeg* referenceLeg(const ThesisResults& results) {
  if (results.legs.empty()) return nullptr;
  const auto first = std::ranges::find_if(
      results.legs, [](const ThesisLeg& leg) { return isOf(leg, "packings"); });
  return first == results.legs.end() ? &results.legs.front() : &*first;
}

}  // namespace crossgrain::reports
