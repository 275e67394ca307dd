#pragma once

/// Numbers of Lätzel (2003) that checks and tests share. Knows nothing of the project, so that
/// tests of an engine by itself can have it too.
namespace crossgrain::conformance {

// Table 3.1, the small radius as cases use it.
inline constexpr double smallRadius = 3.7e-3;    ///< [m]
inline constexpr double largeRadius = 4.495e-3;  ///< [m]
inline constexpr double wallRadius = 1.25e-3;    ///< of the walls' disks, as cases have it [m]
inline constexpr double smallMass = 0.275e-3;    ///< [kg]
inline constexpr double largeMass = 0.490e-3;    ///< [kg]

/// q of J = q m a² of a solid disk.
inline constexpr double solidDisk = 0.5;
/// Its J [kg m²].
constexpr double solidInertia(double mass, double radius) {
  return solidDisk * mass * radius * radius;
}
inline constexpr double smallInertia = solidInertia(smallMass, smallRadius);  ///< [kg m²]

/// The constants of the contact law, Table 4.1.
struct ThesisConstants {
  double kn = 352.1;  ///< k_n [N/m]
  double gn = 0.19;   ///< γ_n [kg/s]
  double kt = 267.1;  ///< k_t [N/m]
  double gt = 0.15;   ///< γ_t [kg/s]
  double mu = 0.44;   ///< µ, static = dynamic [-]
};
inline constexpr ThesisConstants thesis;

/// t_c = π/ω of two small disks, as the thesis prints it: 3 digits [s].
inline constexpr double smallContactTime = 2.18e-3;

/// The law with these constants, all else as it is; of any engine's own type too.
template <class Law>
Law withThesisConstants(Law law) {
  law.kn = thesis.kn;
  law.gn = thesis.gn;
  law.kt = thesis.kt;
  law.gt = thesis.gt;
  law.mu = thesis.mu;
  return law;
}

/// The plate of Table 4.1, of any engine's own type. The thesis is silent on what presses disks on
/// it: their weight is taken.
/// @param mu  µ_b [-]; tests of what the plate does take more than the thesis
template <class Plate>
constexpr Plate thesisBottom(double mu = 2e-5, bool spin = true) {
  return {.mu = mu, .kb = 267.1, .gb = 0.15, .tauM = 1e-4, .gravity = 9.81, .spin = spin};
}

}  // namespace crossgrain::conformance
