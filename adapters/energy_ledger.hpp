#pragma once

#include <array>
#include <string_view>

#include "engines/grain/ledger.hpp"

namespace crossgrain {

/// Where the energy of a scene is and where it went since load(), term by term [J]: five states,
/// what came in (> 0 brings energy in), and losses (> 0 takes it out); engines/grain/ledger.hpp has
/// what each of them is. Velocities are those of the snapshot's time.
using EnergyLedger = grain::EnergyLedger;

/// One term by its name in files; `sign` is that in residual().
struct LedgerTerm {
  std::string_view name;
  double EnergyLedger::*value;
  int sign;
};

inline constexpr std::array<LedgerTerm, 18> ledgerTerms = {{
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
    {"elastic_rolling", &EnergyLedger::elasticRolling, 1},
    {"lost_rolling_damping", &EnergyLedger::lostRollingDamping, 1},
    {"lost_rolling", &EnergyLedger::lostRolling, 1},
    {"lost_plastic", &EnergyLedger::lostPlastic, 1},
    {"lost_detachment", &EnergyLedger::lostDetachment, 1},
}};

/// The first ones are those of every law, the rest of laws that resist rolling or cohere.
inline constexpr std::size_t commonLedgerTerms = 13;

/// Energy that no term accounts for, states + losses − initial − inflow [J]; > 0: energy from
/// nowhere. It shrinks with dt at the order of the scheme.
constexpr double residual(const EnergyLedger& ledger) {
  double sum = 0.0;
  for (const LedgerTerm& term : ledgerTerms) sum += term.sign * ledger.*term.value;
  return sum;
}

}  // namespace crossgrain
