#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "averaging/agreement.hpp"
#include "cases/case.hpp"

/// Numbers of results.json's "runs", packing by packing, as two engines or two cases are paired.
namespace crossgrain::inline runs {

using Numbers = std::vector<std::optional<double>>;

/// The finished runs of one engine, with that switched off (empty: nothing), in the order of
/// packings.
std::vector<const nlohmann::json*> finishedRuns(const nlohmann::json& runs,
                                                const std::string& engine,
                                                const std::string& without = "");

/// One more than the largest index of a packing.
std::size_t packingsOf(const nlohmann::json& runs);

/// Null where the run has none.
const nlohmann::json* profileOf(const nlohmann::json& run, const nlohmann::json& method,
                                const std::string& field);

/// One field in each ring, by packing index. @param what "mean" | "stderr", of the profile
std::vector<Numbers> fieldByRing(const std::vector<const nlohmann::json*>& runs,
                                 const nlohmann::json& method, const std::string& field,
                                 std::size_t packings, const char* what = "mean");

/// One ring as it is put to the test. A relative margin is one on the ratio of the two engines:
/// where every packing has a value of one and the same sign it is tested on logarithms, whose
/// paired differences scatter far less than those of the values, for a packing that is stiffer for
/// one engine is so for all. Which sign does not matter: σ_rφ < 0 where the wheel turns clockwise.
struct TestedRing {
  PairedSample sample;
  bool logarithmic = false;
  double sign = 1.0;       ///< of the values, where they are taken as logarithms
  double reference = 0.0;  ///< |mean over packings|, in the field's unit
};

TestedRing testedRing(const Margin& margin, const Numbers& reference, const Numbers& other);

/// Adds what the two runs of every packing say of their own errors, on the scale of the test.
void addWithinVariance(TestedRing& ring, const Numbers& referenceError, const Numbers& otherError);

/// A difference on the scale of the test as the difference that it makes in the field's unit.
double inUnit(const TestedRing& ring, double value);

}  // namespace crossgrain::inline runs
