#include "adapters/declared_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// Row for the first two bodies in the engine's table of pairs, whose rows are named "A with B" or
/// "A with wall". Absent where no row fits them, or several that differ.
/// @param reducedMass  of the two [kg]: the disk's beside a wall, half of it beside its equal
template <int D>
std::optional<PairCoefficients> pairOf(const SceneOf<D>& scene,
                                       const EffectiveParameters& effective, double reducedMass) {
  constexpr std::string_view with = " with ";
  const auto is = [&](double mass) { return std::abs(mass - reducedMass) <= 1e-12 * reducedMass; };
  const double mass = scene.disks.mass.front();
  std::optional<PairCoefficients> found;
  for (const PairCoefficients& row : effective.pairs) {
    const std::size_t middle = row.pair.find(with);
    if (middle == std::string::npos) continue;
    const std::string_view one = std::string_view(row.pair).substr(0, middle),
                           other = std::string_view(row.pair).substr(middle + with.size());
    if (other.starts_with("wall") != is(mass)) continue;
    if (one == other && !is(0.5 * mass)) continue;
    if (found && (found->en != row.en || found->et0 != row.et0 || found->mu != row.mu)) return {};
    found = row;
  }
  return found;
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

namespace {

/// @param rigid  of the contacts that the engine has in place of soft ones, if that is all it has
std::optional<ContactLaw> declared(const Capabilities& can, ContactLaw law,
                                   const EffectiveParameters& effective,
                                   const std::function<std::optional<PairCoefficients>()>& rigid) {
  law = lawAsRun(can, law);
  const auto stiffness = std::ranges::find(effective.deviations, "stiffness", &Deviation::name);
  if (stiffness != effective.deviations.end()) law = stiffened(law, stiffness->value);
  if (hasNormalLaw(can, law)) return law;
  if (can.lawOptions.at("normal") != std::vector<std::string>{"rigid"}) return std::nullopt;
  const auto pair = rigid();
  if (!pair) return std::nullopt;
  law.normal = NormalLaw::rigid;
  law.en = pair->en;
  law.et0 = pair->et0;
  law.mu = pair->mu;
  return law;
}

}  // namespace

template <int D>
std::optional<ContactLaw> declaredLaw(const Capabilities& can, const SceneOf<D>& scene,
                                      const EffectiveParameters& effective, double reducedMass) {
  return declared(can, scene.materials ? scene.lawOf(0, 1) : scene.law, effective,
                  [&] { return pairOf(scene, effective, reducedMass); });
}
template std::optional<ContactLaw> declaredLaw<2>(const Capabilities&, const Scene&,
                                                  const EffectiveParameters&, double);
template std::optional<ContactLaw> declaredLaw<3>(const Capabilities&, const SpaceScene&,
                                                  const EffectiveParameters&, double);

std::optional<ContactLaw> declaredLaw(const Capabilities& can, const ContactLaw& law,
                                      const EffectiveParameters& effective) {
  return declared(can, law, effective, [&]() -> std::optional<PairCoefficients> {
    if (effective.pairs.empty()) return std::nullopt;
    PairCoefficients mean;
    for (double PairCoefficients::*constant :
         {&PairCoefficients::en, &PairCoefficients::et0, &PairCoefficients::mu})
      for (const PairCoefficients& pair : effective.pairs)
        mean.*constant += pair.*constant / static_cast<double>(effective.pairs.size());
    return mean;
  });
}

}  // namespace crossgrain
