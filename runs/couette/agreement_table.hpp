#pragma once

#include <nlohmann/json.hpp>

#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// results.json's "ensemble": per engine the mean over packings of every profile, fit and head
/// number of its finished runs, with sd/√P as error.
nlohmann::json ensembleOf(const nlohmann::json& runs, const std::vector<std::string>& engines);

/// One entry of it, of the runs with that switched off; null without a finished one.
nlohmann::json ensembleOf(const nlohmann::json& runs, const std::string& engine,
                          const std::string& without);

/// Two engines to hold against each other, and why; or one and itself without an effect.
struct ComparedPair {
  std::string reference, other;
  std::string kind;     ///< "peer" | "mirror_model" | "mirror_implementation" | "effect"
  std::string without;  ///< what is switched off in the runs of `other`
};

/// results.json's "agreement": for every pair and every field with a margin in the case the
/// verdict, ring by ring, from the packings that both have finished. The family whose false alarms
/// are held to 1 − confidence is all rings of all fields of a pair.
nlohmann::json agreementOf(const Case& setup, const nlohmann::json& runs,
                           const std::vector<ComparedPair>& pairs);

}  // namespace crossgrain::inline runs
