#include "adapters/declared_law.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/pair_table.hpp"
#include "adapters/suitability.hpp"

namespace crossgrain {
namespace {

/// Of the rows "3.7 mm with 2 mm", "… with wall", in an engine's own words, those of that kind of
/// pair. @param wall  of a disk and a wall  @param alike  else of two disks that are alike
std::vector<PairCoefficients> rowsOf(const EffectiveParameters& effective, bool wall, bool alike) {
  constexpr std::string_view with = " with ";
  std::vector<PairCoefficients> rows;
  for (const PairCoefficients& row : effective.pairs) {
    const std::size_t middle = row.pair.find(with);
    if (middle == std::string::npos) continue;
    const std::string one = row.pair.substr(0, middle),
                      other = row.pair.substr(middle + with.size());
    const bool ofWall = other.starts_with("wall");
    if (ofWall == wall && (wall || (one == other) == alike)) rows.push_back(row);
  }
  return rows;
}

/// The row of the engine's table that is about the first two bodies, of that reduced mass [kg]: the
/// one of their name, or where the engine has other names all that can be theirs, if these say the
/// same.
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
  const Disks& disks = scene.disks;
  const bool wall = !scene.bodies.empty(), two = disks.size() > 1;
  const bool alike = two && disks.radius[0] == disks.radius[1] && disks.mass[0] == disks.mass[1];
  const std::vector<PairCoefficients> rows = rowsOf(effective, wall, alike);
  const bool same = std::ranges::all_of(rows, [&](const PairCoefficients& row) {
    return row.en == rows.front().en && row.et0 == rows.front().et0 && row.mu == rows.front().mu;
  });
  return rows.empty() || !same ? std::nullopt : std::optional(rows.front());
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
