#pragma once

#include <string>
#include <vector>

#include "reports/thesis/figure_specs.hpp"

namespace crossgrain::reports {

/// A curve and what it is of, in words.
struct DrawnCurve {
  std::string of;  ///< "ν̄ = 0.804, σ_rr"
  std::vector<Point> points;
  bool overRTilde = true;
};

/// What a curve shows, in a clause: "0.61 next to the wheel, 0.82 at 6 d, 0.80 at the outer ring".
/// Empty without points.
std::string clauseOf(const DrawnCurve& curve, Finding finding);

/// "Thesis: ….  Found: …; …." of some curves, those without points left out.
std::string thesisAndFound(const std::string& says, const std::vector<DrawnCurve>& curves,
                           Finding finding);
/// The same from clauses.
std::string thesisAndFound(const std::string& says, const std::vector<std::string>& clauses);

}  // namespace crossgrain::reports
