#pragma once

#include <string>
#include <vector>

#include "reports/common/json_view.hpp"

/// Verdicts as JUnit's XML, which build servers read.
namespace crossgrain::reports {

/// One thing that was judged, or that could not be.
struct JUnitCase {
  enum class Outcome { passed, failed, error, skipped };

  std::string group;  ///< case and variant: "classname"
  std::string name;   ///< engine and what is judged
  Outcome outcome = Outcome::passed;
  std::string message = {};  ///< figure, limit and reason; why it is an error or was skipped
  double seconds = 0.0;      ///< wall time of the run; 0 where others of the same run have it
};

/// @param suite  "stability"
std::string junitXml(const std::string& suite, const std::vector<JUnitCase>& cases);

/// A test for each engine and hard case: unstable ones failed; engines that broke down are errors;
/// what was refused is skipped.
std::string stabilityJunit(const Json& results);

/// A test for each sweep and quantity that the case has a limit for.
std::string collideJunit(const Json& results);

}  // namespace crossgrain::reports
