#pragma once

#include <string>

#include "results/lockstep_findings.hpp"

/// What lockstep found, in words; for the page and the command line alike.
namespace crossgrain::reports {

/// "kn" → "k_n", as everywhere in reports.
std::string constantSymbol(const std::string& constant);

/// "same to rounding", "same law", "differs, like 2.1 % of k_n", "not measured".
std::string verdictInWords(const LockstepRow& row, const LockstepRules& rules);

/// "k_n, +0.01 % (leaves 0.3 % of the separation)"; empty: no term was named.
std::string termInWords(const LockstepRow& row);

/// Where and when it was first seen: "between 0.4 ms and 0.52 ms, disk 17 with 203 (new, wall)".
std::string firstInWords(const LockstepRow& row);

/// One sentence on one engine.
std::string sentenceOf(const LockstepRow& row, const LockstepRules& rules);

/// "one and another are the laws that they declare; a third was not measured."
std::string leadOf(const LockstepFindings& findings);

}  // namespace crossgrain::reports
