#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/pages.hpp"
#include "results/collision.hpp"

/// What is written of collisions.
namespace crossgrain::reports {

/// engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status
/// then further quantities, reason (reports/README.md). One row per collision; a sweep without any
/// is one row with its status, its reason and no numbers. The contract of reports/common/csv.hpp.
std::string collisionsCsv(const CollideResults& results);

/// JUnit: a test for each sweep and quantity that the case has a limit for.
std::string collideJunit(const CollideResults& results);

/// collision_1, collision_2, … in the order of the cases, each with its collision_1_energy.
std::vector<Figure> collideFigures(const CollideResults& results);

std::string collidePage(const CollideResults& results, const Illustrations& shown);

}  // namespace crossgrain::reports
