#pragma once

#include <string>

#include "results/lockstep_findings.hpp"

/// Lockstep findings in words, for the page and the command line alike.
namespace crossgrain::inline results {

/// "kn" → "k_n", as everywhere in reports.
std::string constantSymbol(const std::string& constant);

/// The same in plain text: "kₙ".
std::string plainSymbol(const std::string& constant);

/// "kn" → "the normal stiffness"; what is no constant as it is: "tension = cut".
std::string constantWords(const std::string& constant);

/// "2.10 %"
std::string percentText(double fraction);

std::string verdictWord(Equivalence verdict);

/// "identical to rounding", "equivalent", "identical to its precision", "undecided", "not
/// measured". What differs is "differs (equivalent to 2.1 % of k_n)" only where that change of k_n
/// explains it, else "differs (24 times the limit)" or "differs from 5 of 16 starts".
std::string describeVerdict(const LockstepRow& row, const LockstepRules& rules);

/// "k_n, +0.01 % (leaves 0.3 % of the difference)"; empty: no term was named.
std::string describeTerm(const LockstepRow& row);

/// Where and when it was first seen: "between 0.4 ms and 0.52 ms, disk 17 with 203 (new, wall)".
std::string describeFirst(const LockstepRow& row);

/// Rigid disks that touch several at once: the law leaves the order of these collisions open. Empty
/// otherwise.
std::string openInLaw(const LockstepRow& row, const LockstepRules& rules);

/// How many starts could be read, ε_eq with its interval and what share of states these starts do
/// not exclude; empty where none was read.
std::string describeReading(const LockstepRow& row, const LockstepRules& rules);

/// Of identical to its precision: "0.51 % of k_n would show". Empty of other verdicts.
std::string describeResolution(const LockstepRow& row, const LockstepRules& rules);

/// "in the order in which they act: spring_update in step 1, 62 % of the divergence after 100 ms;
/// lever_arm in step 3, 30 %", of differences from the case's law; empty: there is none.
std::string describeCauses(const LockstepRow& row);

/// One line on one engine.
std::string describe(const LockstepRow& row, const LockstepRules& rules);

}  // namespace crossgrain::inline results
