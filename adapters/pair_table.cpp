#include "adapters/pair_table.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

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

std::vector<PairCoefficients> pairTable(
    const Scene& scene, const std::function<PairCoefficients(double reducedMass)>& coefficients) {
  // A table of more kinds than this is of no use to a reader.
  constexpr std::size_t mostKinds = 4;
  std::set<std::pair<double, double>> kinds;  // radius, mass
  for (std::size_t i = 0; i < scene.disks.size() && kinds.size() < mostKinds; ++i)
    kinds.emplace(scene.disks.radius[i], scene.disks.mass[i]);

  const auto name = [](const std::pair<double, double>& kind) {
    return fmt::format("{:.4g} mm, {:.4g} g", kind.first * 1e3, kind.second * 1e3);
  };
  std::vector<PairCoefficients> table;
  const auto addRow = [&](const std::string& pair, double reducedMass) {
    PairCoefficients& row = table.emplace_back(coefficients(reducedMass));
    row.pair = pair;
  };
  for (auto a = kinds.begin(); a != kinds.end(); ++a) {
    for (auto b = a; b != kinds.end(); ++b)
      addRow(name(*a) + " with " + name(*b), a->second * b->second / (a->second + b->second));
    if (!scene.bodies.empty()) addRow(name(*a) + " with wall", a->second);
  }
  return table;
}

}  // namespace crossgrain
