#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/overview.hpp"

/// Verdicts as JUnit's XML, which build servers read.
namespace crossgrain::reports {

/// One thing that was judged, or that could not be.
struct JUnitCase {
  std::string group;  ///< case and variant: "classname"
  std::string name;   ///< engine and what is judged
  Verdict verdict = Verdict::pass;
  std::string message = {};  ///< figure, limit and reason; why it is an error or was skipped
  double seconds = 0.0;      ///< wall time of the run; 0 where others of the same run have it
  bool broke = false;        ///< the engine did, so that nothing could be judged
};

/// @param suite  "stability"
std::string junitXml(const std::string& suite, const std::vector<JUnitCase>& cases);

/// A matrix as tests, one for each cell that answers a question: what passed passes, a model
/// difference too; what failed fails; borderline, undecided and not measured are skipped with their
/// words, for nothing was shown. Figures and cells without a question are left out.
/// @param group  "classname" of all
std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group);

/// "CASE VARIANT", or the one where the other says nothing more.
std::string junitGroup(const std::string& name, const std::string& variant);

/// Of a run; 0 where it is not known [s].
double junitSeconds(const std::optional<Stats>& stats);

}  // namespace crossgrain::reports
