#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline studies {

/// The constant that deviations are expressed in: k_n, of rigid disks e_n.
std::string referencePerturbationOf(const ContactLaw& law);

/// Basis of verdicts in a scene of that law.
LockstepRules lockstepRules(const ContactLaw& law);

/// Changes it by that part of itself.
void changeReference(ContactLaw& law, double by);

/// By disk, how far a unit of change of the reference constant moves it; 0 of a disk whose
/// responses are not in proportion (responsesAlike), or that does not move.
/// @param responses  how far each of referencePerturbations moves each disk, change by change [d]
/// @returns empty where they cannot be read: nothing moves, fewer than half of the disks that do
/// are in proportion, or one of these moves by largestResponse
std::vector<double> proportionalRates(const std::vector<double>& responses);

/// ε_eq: the change of the reference constant that parts the mirror from itself as far as the
/// engine is from it, root mean squares over the disks in proportion. A disk that is not counts
/// with what is beyond the largest of its responses: so far an event may have taken it.
/// @param apart  by disk [d]
/// @returns nothing where it cannot be read, likewise
std::optional<double> equivalentChange(const std::vector<double>& apart,
                                       const std::vector<double>& responses);

/// By which constants are changed to see how averages respond, relative: ten times what lockstep's
/// reference perturbation is read off at, so that it shows in averages.
inline constexpr double responseChange = 0.1;

/// A case with one constant of its law larger by responseChange.
struct ChangedCase {
  std::string constant;  ///< "kn"
  std::string name;      ///< of its runs, "kn+10%"
  Case setup;
};

/// Changes the reference constant, or µ, by that part of itself. @param constant  by name
void changeConstant(ContactLaw& law, const std::string& constant, double by);

/// The constant that ε_eq is expressed in, and µ where there is friction.
std::vector<ChangedCase> changedCases(const Case& setup);

}  // namespace crossgrain::inline studies
