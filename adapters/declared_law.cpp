#include "adapters/declared_law.hpp"

#include <algorithm>
#include <cmath>

#include "adapters/pair_table.hpp"
#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// The row of the engine's table that is about two bodies of that reduced mass [kg].
std::optional<PairCoefficients> pairOf(const Scene& scene, const EffectiveParameters& effective,
                                       double reducedMass) {
  const auto massAsStiffness = [](double mass) {
    PairCoefficients row;
    row.kn = mass;
    return row;
  };
  for (const PairCoefficients& kind : pairTable(scene, massAsStiffness)) {
    if (std::abs(kind.kn - reducedMass) > 1e-12 * reducedMass) continue;
    const auto row = std::ranges::find(effective.pairs, kind.pair, &PairCoefficients::pair);
    if (row != effective.pairs.end()) return *row;
  }
  return std::nullopt;
}

}  // namespace

ContactLaw stiffened(ContactLaw law, double factor) {
  law.kn *= factor;
  law.kn3 *= factor;
  law.kt *= factor;
  law.kr *= factor;
  const double slower = law.damper == Damper::constant       ? std::sqrt(factor)
                        : law.damper == Damper::viscoelastic ? 1.0 / std::sqrt(factor)
                                                             : 1.0;
  law.gn *= slower;
  law.gt *= slower;
  // The torque against rolling acts for 1/√factor as long, and a load's impulse is what it was.
  if (law.conventions.rollingDamper == RollingDamper::constant || law.rolling != RollingLaw::spring)
    law.gr *= std::sqrt(factor);
  // Overlaps and forces of an impact change by 1/√factor and √factor, of Hertz' law by their 4/5.
  const double force = law.normal == NormalLaw::hertz ? std::pow(factor, 0.4) : std::sqrt(factor);
  law.kc *= factor;
  law.kUnload *= factor;
  law.plasticDepth /= force;
  law.w *= force;
  return law;
}

std::optional<ContactLaw> declaredLaw(const Capabilities& can, const Scene& scene,
                                      const EffectiveParameters& effective, double reducedMass) {
  ContactLaw law = lawAsRun(can, scene.materials ? scene.lawOf(0, 1) : scene.law);
  const auto stiffness = std::ranges::find(effective.deviations, "stiffness", &Deviation::name);
  if (stiffness != effective.deviations.end()) law = stiffened(law, stiffness->value);
  if (hasNormalLaw(can, law)) return law;
  if (can.lawOptions.at("normal") != std::vector<std::string>{"rigid"}) return std::nullopt;
  const auto pair = pairOf(scene, effective, reducedMass);
  if (!pair) return std::nullopt;
  law.normal = NormalLaw::rigid;
  law.en = pair->en;
  law.et0 = pair->et0;
  law.mu = pair->mu;
  return law;
}

}  // namespace crossgrain
