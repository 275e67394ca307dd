#include "adapters/pair_table.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <tuple>

namespace crossgrain {

PairCoefficients coefficientsOf(const ContactLaw& law) {
  PairCoefficients row;
  const bool soft = law.soft();
  const bool friction = law.friction();
  if (soft) {
    row.kn = law.kn;
    row.gn = law.gn;
  } else {
    row.en = law.en;
  }
  if (soft && law.rolls()) {
    row.kr = law.kr;
    row.gr = law.gr;
    row.muR = law.muR;
  }
  if (soft && law.coheres()) {
    row.kc = law.kc;
    row.w = law.w;
  }
  if (!friction) return row;
  row.mu = law.mu;
  if (!soft) row.et0 = law.et0;
  if (soft && law.springs()) row.kt = law.kt;
  if (soft && law.dashpots()) row.gt = law.gt;
  return row;
}

template <int D>
std::vector<PairCoefficients> pairTable(
    const SceneOf<D>& scene,
    const std::function<PairCoefficients(const ContactLaw& law, double reducedMass)>&
        coefficients) {
  // A table of more kinds than this is of no use to a reader.
  constexpr std::size_t mostKinds = 4;
  const auto& materials = scene.materials;
  std::set<std::tuple<double, double, std::int32_t>> kinds;  // radius, mass, material
  for (std::size_t i = 0; i < scene.disks.size() && kinds.size() < mostKinds; ++i)
    kinds.emplace(scene.disks.radius[i], scene.disks.mass[i], materials ? materials->ofDisk[i] : 0);
  std::set<std::int32_t> walls;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    walls.insert(materials ? materials->ofBody[b] : 0);

  const auto madeOf = [&](std::int32_t material) {
    return materials ? " of " + materials->names[static_cast<std::size_t>(material)] : "";
  };
  const auto name = [&](const auto& kind) {
    const auto& [radius, mass, material] = kind;
    return fmt::format("{:.4g} mm, {:.4g} g{}", radius * 1e3, mass * 1e3, madeOf(material));
  };
  std::vector<PairCoefficients> table;
  const auto addRow = [&](const std::string& pair, std::int32_t a, std::int32_t b,
                          double reducedMass) {
    PairCoefficients& row =
        table.emplace_back(coefficients(materials ? materials->law(a, b) : scene.law, reducedMass));
    row.pair = pair;
  };
  for (auto a = kinds.begin(); a != kinds.end(); ++a) {
    const auto [radius, mass, material] = *a;
    for (auto b = a; b != kinds.end(); ++b) {
      const double other = std::get<1>(*b);
      addRow(name(*a) + " with " + name(*b), material, std::get<2>(*b),
             mass * other / (mass + other));
    }
    for (const std::int32_t wall : walls)
      addRow(name(*a) + " with wall" + madeOf(wall), material, wall, mass);
  }
  return table;
}
using CoefficientsOf = std::function<PairCoefficients(const ContactLaw& law, double reducedMass)>;
template std::vector<PairCoefficients> pairTable<2>(const Scene&, const CoefficientsOf&);
template std::vector<PairCoefficients> pairTable<3>(const SpaceScene&, const CoefficientsOf&);

std::vector<PairCoefficients> pairTable(
    const Scene& scene, const std::function<PairCoefficients(double reducedMass)>& coefficients) {
  return pairTable(scene, [&](const ContactLaw&, double mass) { return coefficients(mass); });
}

}  // namespace crossgrain
