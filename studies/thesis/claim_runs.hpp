#pragma once

#include <functional>

#include "studies/thesis/claim_evidence.hpp"

/// By which runs a figure is judged.
namespace crossgrain::inline studies {

using RunChoice = std::function<RunSet(const ClaimScope& scope)>;

RunSet flow(const ClaimScope& scope);             ///< of shear flow by table 3.2
RunSet upward(const ClaimScope& scope);           ///< of shear flow and all labels above it
RunSet blocked(const ClaimScope& scope);          ///< from the first blocked label on
RunSet lowDensities(const ClaimScope& scope);     ///< of shear flow up to the rule's low_to
RunSet figureDensities(const ClaimScope& scope);  ///< of shear flow up to the rule's change_to
RunSet atLabel(const ClaimScope& scope);          ///< at the rule's ν̄
RunSet timedAtLabel(const ClaimScope& scope);  ///< the longest of each packing, at the rule's ν̄
/// Of the family "rate" up to the rule's rate, or from it on, of shear flow and above.
RunSet slowRates(const ClaimScope& scope);
RunSet fastRates(const ClaimScope& scope);
RunSet withoutPlate(const ClaimScope& scope);
RunSet withoutFriction(const ClaimScope& scope);
RunSet ofAnotherStiffness(const ClaimScope& scope);  ///< than that of upward()

/// Those whose wheel has the common number of contacts while they are averaged.
RunSet thatCarry(const ClaimScope& scope, RunSet set);
template <RunSet (*from)(const ClaimScope&)>
RunSet carrying(const ClaimScope& scope) {
  return thatCarry(scope, from(scope));
}

}  // namespace crossgrain::inline studies
