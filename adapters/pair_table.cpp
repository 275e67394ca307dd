#include "adapters/pair_table.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace crossgrain {

std::vector<PairCoefficients> pairTable(
    const Scene& scene,
    const std::function<void(PairCoefficients& row, double reducedMass)>& fill) {
  // A table of more kinds than this tells a reader nothing.
  constexpr std::size_t mostKinds = 4;
  std::set<std::pair<double, double>> kinds;  // radius, mass
  for (std::size_t i = 0; i < scene.disks.size() && kinds.size() < mostKinds; ++i)
    kinds.emplace(scene.disks.radius[i], scene.disks.mass[i]);

  const auto name = [](const std::pair<double, double>& kind) {
    return fmt::format("{:.4g} mm, {:.4g} g", kind.first * 1e3, kind.second * 1e3);
  };
  std::vector<PairCoefficients> table;
  const auto addRow = [&](const std::string& pair, double reducedMass) {
    table.push_back({});
    table.back().pair = pair;
    fill(table.back(), reducedMass);
  };
  for (auto a = kinds.begin(); a != kinds.end(); ++a) {
    for (auto b = a; b != kinds.end(); ++b)
      addRow(name(*a) + " with " + name(*b), a->second * b->second / (a->second + b->second));
    if (!scene.bodies.empty()) addRow(name(*a) + " with wall", a->second);
  }
  return table;
}

}  // namespace crossgrain
