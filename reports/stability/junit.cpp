#include "reports/common/junit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/stability/report.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

/// "0.31 J against a limit of 0.1 J, which is there since …; reason"
std::string figureOf(const StabilityRun& run, const std::string& why) {
  std::string figure;
  if (run.value)
    figure = fmt::format("{:.4g}{}{} against a limit of {:.4g}", *run.value,
                         run.unit.empty() ? "" : " ", run.unit, run.limit);
  if (!figure.empty() && !why.empty()) figure += fmt::format(" ({})", why);
  return figure + (figure.empty() || run.reason.empty() ? "" : "; ") + run.reason;
}

Outcome outcomeOf(const StabilityRun& run) {
  if (run.status == HardRunStatus::failed) return Outcome::error;
  switch (run.verdict) {
    case StabilityVerdict::unstable:
      return Outcome::failed;
    case StabilityVerdict::notRun:
    case StabilityVerdict::refused:
      return Outcome::skipped;
    default:
      return Outcome::passed;
  }
}

}  // namespace

std::string stabilityJunit(const StabilityResults& results) {
  std::vector<JUnitCase> cases;
  for (const StabilityRun& run : results.runs) {
    JUnitCase one{junitGroup(run.name, run.variant), run.engine + ": " + run.measure,
                  outcomeOf(run), "", junitSeconds(run.stats)};
    if (one.outcome == Outcome::error || one.outcome == Outcome::skipped) {
      one.message = run.reason;
    } else if (run.verdict != StabilityVerdict::stable) {
      std::string why;
      for (const HardCase& setup : results.cases)
        if (setup.name == run.name && setup.variant == run.variant) why = setup.why;
      one.message = std::string(nameOf(run.verdict)) + ": " + figureOf(run, why);
    }
    cases.push_back(std::move(one));
  }
  return junitXml("stability", cases);
}

}  // namespace crossgrain::reports
