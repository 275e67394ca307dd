#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "averaging/agreement.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"

/// Numbers of runs, packing by packing, as two engines or two cases are paired.
namespace crossgrain::inline studies {

/// In the order of packings.
using Runs = std::vector<const FlowRun*>;

/// The finished runs of one engine, with that switched off (empty: nothing). They point into runs.
Runs finishedRuns(std::span<const FlowRun> runs, const std::string& engine,
                  const std::string& without = "");

/// One more than the largest index of a packing.
std::size_t packingsOf(std::span<const FlowRun> runs);

/// One field in each ring, by packing index. @param what  of the profile
std::vector<Numbers> fieldByRing(const Runs& runs, const std::string& method,
                                 const std::string& field, std::size_t packings,
                                 Numbers Profile::*what = &Profile::mean);

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

}  // namespace crossgrain::inline studies
