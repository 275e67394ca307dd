#pragma once

#include <span>
#include <vector>

#include "cases/case.hpp"
#include "results/flow_numbers.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::inline studies {

/// For every pair and every field with a margin in the case the verdict, ring by ring, from the
/// packings that both have finished. The family whose false alarms are limited to 1 − confidence is
/// all rings of all fields of a pair.
/// @param surrogates  who is evaluated through a mirror
std::vector<AgreementRow> agreementOf(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs,
                                      const std::vector<SurrogateEngine>& surrogates = {});

}  // namespace crossgrain::inline studies
