#pragma once

#include <nlohmann/json.hpp>

#include "cases/case.hpp"

namespace crossgrain {

/// results.json's "ensemble": per engine the mean over packings of every profile, fit and head
/// number of its finished runs, with sd/√P as error.
nlohmann::json ensembleOf(const nlohmann::json& runs, const std::vector<std::string>& engines);

/// Two engines to hold against each other, and why.
struct ComparedPair {
  std::string reference, other;
  std::string kind;  ///< "peer" | "mirror_model" | "mirror_implementation"
};

/// results.json's "agreement": for every pair and every field with a margin in the case the
/// verdict, ring by ring, from the packings that both have finished. The family whose false alarms
/// are held to 1 − confidence is all rings of all fields of a pair.
nlohmann::json agreementOf(const Case& setup, const nlohmann::json& runs,
                           const std::vector<ComparedPair>& pairs);

}  // namespace crossgrain
