#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "averaging/agreement.hpp"
#include "cases/case.hpp"
#include "cases/endpoints.hpp"
#include "results/endpoints.hpp"
#include "results/run.hpp"

/// Runs by engine, and their numbers packing by packing, for comparisons of two engines or cases.
namespace crossgrain::inline studies {

/// Runs in the order of packings.
using Runs = std::vector<const FlowRun*>;

/// Finished runs of one engine without that effect (empty: with all). They point into `runs`.
Runs finishedRuns(std::span<const FlowRun> runs, const std::string& engine,
                  const std::string& without = "");

/// Runs that verdicts on an engine rest on: its mirror's, where it is evaluated through that, else
/// its own.
Runs runsFor(std::span<const FlowRun> runs, const std::string& engine,
             const std::vector<SurrogateEngine>& surrogates, const std::string& without = "");

/// One more than the largest index of a packing.
std::size_t packingsOf(std::span<const FlowRun> runs);
std::size_t packingsOf(const Runs& runs);

/// Two engines to compare, and why; or one and itself without an effect.
struct ComparedPair {
  std::string a, b;  ///< the reference first
  PairKind kind = PairKind::peer;
  std::string without = {};  ///< effect switched off in the runs of `b`
  /// One of them is files: its runs are taken to be other packings than the other's.
  bool ofFiles = false;
  /// Where `a` is medianName: the engines whose median it is, packing by packing.
  std::vector<std::string> others = {};

  /// Engines whose runs make up the reference: `a`, or the others.
  std::vector<std::string> references() const { return others.empty() ? std::vector{a} : others; }
};

/// Of each of references() the runs that verdicts rest on, if any finished. Empty where none did,
/// or fewer than two of a median.
std::vector<Runs> referenceRuns(std::span<const FlowRun> runs, const ComparedPair& pair,
                                const std::vector<SurrogateEngine>& surrogates);

/// Median of several engines' values on each packing; absent where fewer than two have one. Of one
/// engine its own values.
Numbers medianByPacking(const std::vector<Numbers>& engines);

/// Whether two engines' runs are independent samples: those of files, unless both have the same
/// indices. Then they are paired one by one, which is valid whether or not their packings are the
/// same, and more sensitive where they are.
bool independentRuns(const ComparedPair& pair, const Runs& reference, const Runs& other);

/// One field in each ring, by packing index. @param what  of the profile
std::vector<Numbers> fieldByRing(const Runs& runs, const std::string& method,
                                 const std::string& field, std::size_t packings,
                                 Numbers Profile::*what = &Profile::mean);

/// Two engines' values of one number as they are put to the test: by difference, or by the
/// logarithm of the ratio, whose paired differences scatter far less than those of the values, for
/// a packing that is stiffer for one engine is so for all. Which sign the values have does not
/// matter: σ_rφ < 0 where the wheel turns clockwise.
struct PairedTest {
  PairedSample sample;  ///< on a scale that rises with the values
  bool logarithmic = false;
  double sign = 1.0;       ///< of the values, where they are taken as logarithms
  double reference = 0.0;  ///< mean over packings [unit of the values]
};

/// A ring of a field. A relative margin is one on the ratio of the two engines where every packing
/// has a value of one and the same sign, else a part of the reference's mean.
PairedTest testedRing(const Margin& margin, const Numbers& reference, const Numbers& other);

/// An endpoint. What is 0 or of another sign than the reference has no ratio: such a packing has no
/// value. Without one sign of the reference's values none has. @param margin  the case's
PairedTest testedEndpoint(const Endpoint& endpoint, const Margin& margin, const Numbers& reference,
                          const Numbers& other);

/// Of the values of a reference, for a margin that is a share of |reference|: +1 or −1; 0 where
/// both occur or none, as a share of what may be 0 is no margin.
double signOf(const Numbers& values);

/// Adds what a single run of each says of its own error of the endpoint, on the scale of the test.
/// @returns the first run that says nothing of it: then nothing is added; null: both do
const FlowRun* addOwnErrors(PairedTest& test, const FlowRun& reference, const FlowRun& other,
                            std::string_view endpoint);

/// Adds what the two runs of every packing say of their own errors, on the scale of the test.
void addWithinVariance(PairedTest& test, const Numbers& referenceError, const Numbers& otherError);

/// A difference on the scale of the test as the difference that it makes in the unit of the values.
double inUnit(const PairedTest& test, double difference);

}  // namespace crossgrain::inline studies
