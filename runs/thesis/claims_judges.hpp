#pragma once

#include "runs/thesis/claims_cosserat.hpp"
#include "runs/thesis/claims_evidence.hpp"

/// One function per claim: what its figures come to. The rule's text says what is measured; the
/// names of figures and numbers are those of the rule.
namespace crossgrain::inline runs {

using ClaimJudge = void (*)(const ClaimScope& scope, Evidence& evidence);

void judgeBinning(const ClaimScope& scope, Evidence& evidence);            // C3
void judgeDensityInTime(const ClaimScope& scope, Evidence& evidence);      // C4
void judgeDilatedZone(const ClaimScope& scope, Evidence& evidence);        // C5
void judgeCriticalDensity(const ClaimScope& scope, Evidence& evidence);    // C6
void judgeVelocityDecay(const ClaimScope& scope, Evidence& evidence);      // C7
void judgeSpinOscillation(const ClaimScope& scope, Evidence& evidence);    // C8
void judgeRateIndependence(const ClaimScope& scope, Evidence& evidence);   // C9
void judgeRadialVelocities(const ClaimScope& scope, Evidence& evidence);   // C10
void judgeJointDistribution(const ClaimScope& scope, Evidence& evidence);  // C11
void judgeFabricTrace(const ClaimScope& scope, Evidence& evidence);        // C12
void judgeFabricAnisotropy(const ClaimScope& scope, Evidence& evidence);   // C13
void judgeContactDirections(const ClaimScope& scope, Evidence& evidence);  // C14
void judgeStressProfiles(const ClaimScope& scope, Evidence& evidence);     // C15
void judgeDynamicStress(const ClaimScope& scope, Evidence& evidence);      // C16
void judgeStressOverDensity(const ClaimScope& scope, Evidence& evidence);  // C17
void judgeDeformation(const ClaimScope& scope, Evidence& evidence);        // C18
void judgeAxes(const ClaimScope& scope, Evidence& evidence);               // C19
void judgeBulkModulus(const ClaimScope& scope, Evidence& evidence);        // C20
void judgeShearModulus(const ClaimScope& scope, Evidence& evidence);       // C21
void judgeContinuumRotation(const ClaimScope& scope, Evidence& evidence);  // C22
void judgeCoupleStress(const ClaimScope& scope, Evidence& evidence);       // C23
void judgeCosseratModel(const ClaimScope& scope, Evidence& evidence);      // C24
void judgeCost(const ClaimScope& scope, Evidence& evidence);               // C25
void judgeOverlap(const ClaimScope& scope, Evidence& evidence);            // C26
void judgeDivergence(const ClaimScope& scope, Evidence& evidence);         // C27

/// C24 by a solution of the model; none: its figures are missing.
void judgeCosserat(const ClaimScope& scope, Evidence& evidence,
                   const std::optional<CosseratFields>& model);

/// Rows of no engine: C1 and C2 are about the law, which the reference leg's case has.
std::vector<ClaimRow> judgeCollisionLaws(const ThesisResults& results, const ClaimRules& rules);

}  // namespace crossgrain::inline runs
