#pragma once

#include <array>
#include <string_view>

namespace crossgrain {

/// Where the energy of a scene is and where it went since load(), term by term [J]. Velocities are
/// those of the snapshot's time.
struct EnergyLedger {
  double initial = 0.0;  ///< the five states below, added up, at load

  // States.
  double kinetic = 0.0;            ///< ½ m v² + ½ J ω² of the disks
  double elasticNormal = 0.0;      ///< ∫ f_el dδ of the contacts' normal springs
  double elasticTangential = 0.0;  ///< ½ k_t ξ², ξ being what carries the force of this time
  double potential = 0.0;  ///< −m g·(x − x₀), x₀ the disks' mean position at load: may be < 0
  double plateSprings = 0.0;  ///< ½ k_b ξ_b² of the springs with the plate

  // Summed since load; > 0 brings energy in.
  double workOfWalls = 0.0;         ///< of walls on the disks
  double gainedByConvention = 0.0;  ///< by springs that grow without being stretched: set to the
                                    ///< bound where they slip, or stiffer as the overlap grows

  // Summed since load; > 0 takes energy out.
  double lostNormalDamping = 0.0;  ///< by normal forces beyond their springs'; of rigid contacts
                                   ///< by the impulse
  double lostTangentialDamping = 0.0;  ///< by tangential forces beyond their springs', sticking
  double lostSliding = 0.0;            ///< at the Coulomb bound
  double lostBottom = 0.0;             ///< to the plate: dashpot, sliding, brake of the spin
  double lostRelease = 0.0;            ///< tangential springs still stretched when a contact ends
};

/// One term by its name in files; `sign` is that in residual().
struct LedgerTerm {
  std::string_view name;
  double EnergyLedger::*value;
  int sign;
};

inline constexpr std::array<LedgerTerm, 13> ledgerTerms = {{
    {"initial", &EnergyLedger::initial, -1},
    {"kinetic", &EnergyLedger::kinetic, 1},
    {"elastic_normal", &EnergyLedger::elasticNormal, 1},
    {"elastic_tangential", &EnergyLedger::elasticTangential, 1},
    {"potential", &EnergyLedger::potential, 1},
    {"plate_springs", &EnergyLedger::plateSprings, 1},
    {"work_of_walls", &EnergyLedger::workOfWalls, -1},
    {"gained_by_convention", &EnergyLedger::gainedByConvention, -1},
    {"lost_normal_damping", &EnergyLedger::lostNormalDamping, 1},
    {"lost_tangential_damping", &EnergyLedger::lostTangentialDamping, 1},
    {"lost_sliding", &EnergyLedger::lostSliding, 1},
    {"lost_bottom", &EnergyLedger::lostBottom, 1},
    {"lost_release", &EnergyLedger::lostRelease, 1},
}};

/// What no term accounts for: states + losses − initial − what came in; > 0: energy from nowhere.
/// It shrinks with dt at the order of the scheme.
constexpr double residual(const EnergyLedger& ledger) {
  double sum = 0.0;
  for (const LedgerTerm& term : ledgerTerms) sum += term.sign * ledger.*term.value;
  return sum;
}

}  // namespace crossgrain
