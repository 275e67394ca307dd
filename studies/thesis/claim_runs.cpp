#include "studies/thesis/claim_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace crossgrain::inline studies {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Contacts of the wheel's disks at a time, in the averaged time; absent: nobody knows.
std::optional<double> wheelContactsOf(const FlowRun& run) {
  if (run.regime && run.regime->wheelContacts) return run.regime->wheelContacts;
  const auto found = std::ranges::find(run.head, "wheel_contacts", &HeadNumber::name);
  return found == run.head.end() ? std::nullopt : found->value;
}

RunSet rates(const ClaimScope& scope, bool slow) {
  RunSet set = scope.family("rate");
  const double to = scope.number("independent_to"), slack = 1e-6 * to;
  std::erase_if(set.runs, [&](const CaseRun& at) {
    const double omega = std::abs(at.setup->cell.omega);
    return (slow ? omega > to + slack : omega < to - slack) ||
           at.setup->label < scope.common("flow_from");
  });
  set.label +=
      slow ? fmt::format(" up to Ω = {:g} /s", to) : fmt::format(" from Ω = {:g} /s on", to);
  return set;
}

}  // namespace

RunSet flow(const ClaimScope& scope) {
  return scope.densities(scope.common("flow_from"), scope.common("flow_to"), "of shear flow");
}
RunSet upward(const ClaimScope& scope) {
  return scope.densities(scope.common("flow_from"), infinity, "of shear flow and above");
}
RunSet blocked(const ClaimScope& scope) {
  return scope.densities(scope.common("blocked_from"), infinity, "of blocked labels");
}
RunSet lowDensities(const ClaimScope& scope) {
  return scope.densities(scope.common("flow_from"), scope.number("low_to"), "of low ν̄");
}
RunSet figureDensities(const ClaimScope& scope) {
  return scope.densities(scope.common("flow_from"),
                         scope.number("change_to") + scope.common("same_label"),
                         "of the figure's ν̄");
}
RunSet atLabel(const ClaimScope& scope) {
  const double label = scope.number("label"), half = scope.common("same_label");
  RunSet set = scope.densities(label - half, label + half, "");
  set.label = fmt::format("runs at ν̄ = {:g}", label);
  return set;
}
RunSet timedAtLabel(const ClaimScope& scope) {
  RunSet set = scope.timed();
  const double label = scope.number("label");
  std::erase_if(set.runs, [&](const CaseRun& at) {
    return std::abs(at.setup->label - label) > scope.common("same_label");
  });
  set.label += fmt::format(" at ν̄ = {:g}", label);
  return set;
}

RunSet thatCarry(const ClaimScope& scope, RunSet set) {
  const std::size_t before = set.runs.size();
  const double fewest = scope.common("wheel_contacts");
  std::erase_if(set.runs, [&](const CaseRun& at) {
    const auto contacts = wheelContactsOf(at.run->run);
    return !contacts || *contacts < fewest;
  });
  set.label += fmt::format(" that carry ({} of {})", set.runs.size(), before);
  return set;
}

RunSet slowRates(const ClaimScope& scope) {
  return rates(scope, true);
}
RunSet fastRates(const ClaimScope& scope) {
  return rates(scope, false);
}
RunSet withoutPlate(const ClaimScope& scope) {
  RunSet set = scope.family("bottom");
  std::erase_if(set.runs, [](const CaseRun& at) { return at.setup->bottomFriction; });
  set.label += " without bottom friction";
  return set;
}
RunSet withoutFriction(const ClaimScope& scope) {
  RunSet set = scope.family("friction");
  std::erase_if(set.runs, [](const CaseRun& at) { return at.setup->mu != 0.0; });
  set.label += " without friction";
  return set;
}
RunSet ofAnotherStiffness(const ClaimScope& scope) {
  const RunSet judged = carrying<upward>(scope);
  const double kn = judged.runs.empty() ? 0.0 : judged.runs.front().setup->kn;
  RunSet set = scope.family("kn");
  std::erase_if(set.runs, [&](const CaseRun& at) { return at.setup->kn == kn; });
  set.label += " of another k_n";
  return set;
}

}  // namespace crossgrain::inline studies
