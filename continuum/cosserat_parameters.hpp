#pragma once

#include <array>
#include <numbers>
#include <string_view>

namespace crossgrain::inline continuum {

/// What multiplies m′ + m/r̄ in the balance of moments (Lätzel 2003, Eq. 9.24).
enum class MomentFactor {
  printed,    ///< ε
  consistent  ///< ε L √(2(A+1)), which the definition of m in Eq. 9.18 calls for
};
constexpr auto namesOf(MomentFactor) {
  return std::array<std::string_view, 2>{"printed", "consistent"};
}

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}
constexpr double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Mohan's frictional Cosserat model of the steady flow between two cylinders (Lätzel 2003, chapter
/// 9), with the thesis' numbers. Lengths are in units of the gap H = R_o − R_i.
struct CosseratParameters {
  double innerRadius = 0.6916;              ///< R̄_i = R_i/H [-]
  double grainSize = 0.0536;                ///< ε = d_p/H [-]
  double lengthScale = 10.0;                ///< L, in grain diameters [-]
  double asymmetry = 1.0 / 3.0;             ///< A = a₂/a₁ of Eq. 9.8, within (−1, 1) [-]
  double internalFriction = radians(22.6);  ///< ψ of the yield condition [rad]
  double wallFriction = radians(9.8);       ///< δ: s(0) = tan δ [rad]
  double wheelVelocity = 1.0;  ///< u₀ = u(0): v_φ/(ΩR_i) of the grains at the wheel [-]
  MomentFactor momentFactor = MomentFactor::printed;
};

}  // namespace crossgrain::inline continuum
