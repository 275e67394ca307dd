#pragma once

#include <optional>
#include <vector>

namespace crossgrain::inline runs {

/// Mohan's Cosserat model over ξ = (r − R_i)/H, rising from 0 to 1; all dimensionless
/// (thesis-facts, section 4). First index of a stress = normal: s is this project's σ_φr, q its
/// σ_rφ.
struct CosseratFields {
  std::vector<double> xi;
  std::vector<double> s, q;      ///< σ_rφ/σ_c and σ_φr/σ_c of the model
  std::vector<double> m;         ///< M_rz/(d_p L √(2(A+1)) σ_c)
  std::vector<double> u, omega;  ///< v_φ and −spin·H, each in units of the wheel's, up to a factor
};

/// With the constants of chapter 9 as printed, solved once. Absent: the numbers did not settle.
const std::optional<CosseratFields>& cosseratAsPrinted();

}  // namespace crossgrain::inline runs
