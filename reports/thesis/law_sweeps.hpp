#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/collision.hpp"

namespace crossgrain::reports {

/// Ψ_f against Ψ_i under one tangential law, and the e_n that its asymptote has.
struct LawSweep {
  std::vector<Point> points;
  double en = 0.0;
};
using LawSweeps = std::map<std::string, LawSweep>;  ///< by the law's name in case files

/// An engine's sweeps of the variants of that tension, "allow" or "cut", each at the time step next
/// to so many steps per contact; those that finished.
LawSweeps lawSweeps(const CollideResults& collisions, const std::string& engine,
                    const std::string& tension, double steps);

/// µ of the collisions' law; 0 where no variant says it.
double lawFriction(const CollideResults& collisions);

}  // namespace crossgrain::reports
