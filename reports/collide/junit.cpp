#include "reports/common/junit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/collide/report.hpp"

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

/// Quantities that any sweep of this variant was judged by.
std::vector<std::string> judgedQuantities(const Json& variant) {
  std::vector<std::string> names;
  for (const Json& curve : list(variant, "curves"))
    for (const auto& [name, score] : member(curve, "score").items())
      if (number(score, "limit") && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  return names;
}

/// "0.0031 of the range against a limit of 0.001 (why)"
std::string errorOf(const Json& score) {
  const std::string unit = text(score, "unit_is"), why = text(score, "why");
  return fmt::format("largest error {:.4g}{} against a limit of {:.4g}{}",
                     number(score, "max").value_or(0.0),
                     unit == "absolute" || unit.empty() ? "" : " of the " + unit,
                     number(score, "limit").value_or(0.0), why.empty() ? "" : " (" + why + ")");
}

JUnitCase judgedSweep(const Json& curve, const std::string& sweep, const std::string& quantity) {
  JUnitCase one{"", sweep + ": " + quantity};
  const Json& score = member(member(curve, "score"), quantity);
  const Json& held = member(score, "held");
  if (held.is_boolean()) {
    one.outcome = held.get<bool>() ? Outcome::passed : Outcome::failed;
    if (one.outcome == Outcome::failed) one.message = errorOf(score);
  } else {
    one.outcome = Outcome::skipped;
    one.message = "not measured, or not known of the reference";
  }
  return one;
}

/// Sweeps that ran; where pairs did not part, that is a failure of its own.
std::vector<JUnitCase> sweepCases(const Json& variant, const Json& curve) {
  const std::string status = text(curve, "status"), reason = text(curve, "reason");
  const auto dt = number(curve, "dt");
  const std::string sweep =
      text(curve, "engine") + (dt ? fmt::format(", dt {:.4g} s", *dt) : std::string());
  if (status == "failed") return {{"", sweep, Outcome::error, reason}};
  if (status == "refused") return {{"", text(curve, "engine"), Outcome::skipped, reason}};
  std::vector<JUnitCase> cases;
  for (const std::string& quantity : judgedQuantities(variant))
    cases.push_back(judgedSweep(curve, sweep, quantity));
  if (status == "incomplete")
    cases.push_back({"", sweep + ": all pairs part", Outcome::failed, reason});
  if (cases.empty())
    cases.push_back({"", sweep, Outcome::skipped, "not judged: the case has no limits"});
  cases.front().seconds = number(member(curve, "stats"), "wall_s").value_or(0.0);
  return cases;
}

}  // namespace

std::string collideJunit(const Json& results) {
  std::vector<JUnitCase> cases;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      for (JUnitCase& one : sweepCases(variant, curve)) {
        one.group = junitGroup(text(variant, "case"), text(variant, "variant"));
        cases.push_back(std::move(one));
      }
  return junitXml("collide", cases);
}

}  // namespace crossgrain::reports
