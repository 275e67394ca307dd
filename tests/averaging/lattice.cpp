#include "tests/averaging/lattice.hpp"

#include <cmath>

namespace crossgrain::test {

Instant lattice(double a, const Vec2& e1, const Vec2& e2, const std::vector<Bond>& bonds) {
  constexpr int reach = 80;
  Instant instant;
  std::vector<std::int32_t> index(4 * reach * reach, -1);
  const auto slot = [&](int m, int n) {
    return static_cast<std::size_t>((m + reach) * 2 * reach + n + reach);
  };
  for (int m = -reach; m < reach; ++m)
    for (int n = -reach; n < reach; ++n) {
      const Vec2 x = m * e1 + n * e2;
      if (x.norm() > 0.28) continue;
      index[slot(m, n)] = static_cast<std::int32_t>(instant.scene.disks.size());
      instant.addDisk(x, a);
    }
  for (int m = -reach + 1; m < reach - 1; ++m)
    for (int n = -reach + 1; n < reach - 1; ++n)
      for (const Bond& bond : bonds) {
        const std::int32_t here = index[slot(m, n)];
        const std::int32_t there = index[slot(m + bond.m, n + bond.n)];
        if (here < 0 || there < 0) continue;
        const Vec2 outward = (bond.m * e1 + bond.n * e2).normalized();
        const bool first = here < there;
        instant.addContact(first ? here : there, first ? there : here,
                           first ? Vec2(-outward) : outward, bond.force, 0.0);
      }
  return instant;
}

Instant triangularLattice(double a, double force) {
  return lattice(a, {2.0 * a, 0.0}, {a, std::sqrt(3.0) * a},
                 {{1, 0, force}, {0, 1, force}, {-1, 1, force}});
}

}  // namespace crossgrain::test
