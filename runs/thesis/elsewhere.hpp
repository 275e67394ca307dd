#pragma once

#include <list>
#include <string>
#include <vector>

#include "runs/thesis/claims_scope.hpp"

namespace crossgrain::inline runs {

/// Other runs that a claim can be judged by than those of its rule's reading.
struct Elsewhere {
  std::string words;  ///< "at ν̄ = 0.807 alone", "at Ω = 1 /s, rotations 2 to 3"
  const ThesisResults* results = nullptr;
  Reading reading;
};

/// All there are of the default reading: runs of one regime, of one ν̄, and of legs of the families
/// "rate" and "time" by their rate and rotations.
class OtherRuns {
 public:
  /// The results must outlive it.
  explicit OtherRuns(const ThesisResults& results);

  const std::vector<Elsewhere>& all() const { return all_; }

 private:
  void addRegimes(const ThesisResults& results);
  void addDensities(const ThesisResults& results, const Reading& standard);
  void addRatesAndTimes(const ThesisResults& results, const Reading& standard);

  std::list<ThesisResults> ofRegimes_;
  std::vector<Elsewhere> all_;
};

}  // namespace crossgrain::inline runs
