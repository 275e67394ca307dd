#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "results/agreement.hpp"
#include "results/run.hpp"

namespace crossgrain::inline studies {

/// The mean over packings of every profile, distribution, fit and head number of an engine's
/// finished runs with that switched off, with sd/√P as error; absent without a finished run.
std::optional<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs, const std::string& engine,
                                          const std::string& without);

/// Of those engines that finished a run of the case as it is.
std::vector<CouetteEnsemble> ensembleOf(std::span<const FlowRun> runs,
                                        const std::vector<std::string>& engines);

/// Two engines to hold against each other, and why; or one and itself without an effect.
struct ComparedPair {
  std::string reference, other;
  PairKind kind;
  std::string without;  ///< what is switched off in the runs of `other`
};

/// For every pair and every field with a margin in the case the verdict, ring by ring, from the
/// packings that both have finished. The family whose false alarms are held to 1 − confidence is
/// all rings of all fields of a pair.
std::vector<AgreementRow> agreementOf(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs);

}  // namespace crossgrain::inline studies
