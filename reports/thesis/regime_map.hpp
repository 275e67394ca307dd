#pragma once

#include <string>
#include <vector>

#include "averaging/half_carry.hpp"
#include "reports/thesis/leg_rings.hpp"
#include "reports/thesis/leg_runs.hpp"

/// In what state packings are over volume fractions, after how many rotations.
namespace crossgrain::reports {

/// After so many rotations states are told; 8 is the thesis' longest run.
inline constexpr int mapRotations[] = {1, 2, 5, 8, 10, 20};

/// A critical ν̄ further outside of the packings' than half of Table 3.2's span is an extrapolation,
/// no figure: as the claim about it is judged.
inline constexpr double farthestCritical = 0.02;

/// One engine's finished runs of one reading, one rate and the thesis' law, whatever family of legs
/// they are of.
struct StateGroup {
  std::string words;             ///< "default, Ω = 0.1 /s", "wall spacing 7 mm, Ω = 0.1 /s"
  std::vector<LegRun> runs;      ///< all
  std::vector<LegRun> packings;  ///< the longest run of each packing
};

/// The reference leg's reading and rate first, the others as their legs come.
std::vector<StateGroup> stateGroups(const ThesisResults& results, const std::string& engine);

/// Packings of one group and ν̄ in the rotation that ends then; of those that were followed so far.
struct StateRow {
  double nu = 0.0;  ///< as Table 3.2 has it
  int rotations = 0;
  int packings = 0, carry = 0;  ///< carry: the wheel has a contact or more on average
  MeanOfRuns contacts;          ///< of the wheel's disks, at a time
  MeanOfRuns pressure;          ///< on the outer ring [N/m²]
};

/// By ν̄, then by rotations.
std::vector<StateRow> stateRows(const StateGroup& group);

/// All packings of a group.
struct CriticalRow {
  int rotations = 0;
  int packings = 0, carry = 0;
  std::optional<HalfCarry> critical;  ///< absent: none follows
};
std::vector<CriticalRow> criticalRows(const StateGroup& group);

/// Pressure, contacts of the wheel and ν at it over rotations, named map_time.
Figure timeFigure(const std::vector<StateGroup>& groups);

/// engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,
/// outer_pressure,outer_pressure_stderr,critical_nu,critical_nu_stderr
/// A row without ν̄ is of all packings of its group, and has the critical one.
std::string regimeMapCsv(const ThesisResults& results);

}  // namespace crossgrain::reports
