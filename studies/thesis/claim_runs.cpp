#include "studies/thesis/claim_runs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace crossgrain::inline studies {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Interpretation defaultOf(const ThesisResults& results, const CaseSettings& reference) {
  Interpretation own;
  own.label = "default: ";
  for (const OpenChoice& open : openChoices) {
    if (open.value == &CaseSettings::largeMass && reference.largeMass == 0.0) continue;  // not said
    own.label += describe(open, reference) + ", ";
  }
  own.label += describeRate(reference);
  for (const ThesisCase& setup : results.cases) {
    if (!sameBut(nullptr, false, settingsOf(setup), reference)) continue;
    if (isOf(setup, "packings")) own.judged.push_back(&setup);
    if (isOf(setup, "packings") || isOf(setup, "time")) own.timed.push_back(&setup);
  }
  return own;
}

void addOthers(const ThesisResults& results, const OpenChoice& open, const CaseSettings& reference,
               std::vector<Interpretation>& all) {
  std::map<std::pair<double, double>, Interpretation> byValue;
  for (const ThesisCase& setup : results.cases) {
    const CaseSettings settings = settingsOf(setup);
    if (!isOf(setup, open.key) || sameSetting(settings.*open.value, reference.*open.value) ||
        !sameBut(&open, true, settings, reference))
      continue;
    Interpretation& own = byValue[{settings.*open.value, settings.omega}];
    own.key = open.key;
    own.label = describe(open, settings);
    if (!sameSetting(settings.omega, reference.omega)) own.label += ", " + describeRate(settings);
    own.judged.push_back(&setup);
    own.timed.push_back(&setup);
  }
  for (auto& [value, own] : byValue) all.push_back(std::move(own));
}

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

std::vector<Interpretation> interpretationsOf(const ThesisResults& results) {
  const ThesisCase* const first = referenceCase(results);
  if (!first) return {Interpretation{"", "default", {}, {}}};
  const CaseSettings reference = settingsOf(*first);
  std::vector<Interpretation> all{defaultOf(results, reference)};
  for (const OpenChoice& open : openChoices) addOthers(results, open, reference, all);
  return all;
}

RunSet ClaimScope::runsOf(const std::vector<const ThesisCase*>& cases, std::string label) const {
  RunSet set{{}, std::move(label), {}};
  for (const ThesisCase* setup : cases) {
    std::set<int> own;
    for (const std::string& name : {engine, mirror})
      for (const CaseRun& at : finishedRuns(results, *setup, name))
        if (own.insert(at.run->packing).second) set.runs.push_back(at);
    if (own.empty()) set.without.push_back(setup->name);
  }
  return set;
}

RunSet ClaimScope::densities(double from, double to, const std::string& label) const {
  std::vector<const ThesisCase*> cases;
  for (const ThesisCase* setup : interpretation.judged)
    if (setup->label >= from && setup->label < to) cases.push_back(setup);
  return runsOf(cases, std::isinf(to)
                           ? fmt::format("runs {} (ν̄ from {:g})", label, from)
                           : fmt::format("runs {} (ν̄ from {:g} to {:g})", label, from, to));
}

RunSet ClaimScope::family(std::string_view name) const {
  std::vector<const ThesisCase*> cases;
  for (const ThesisCase& setup : results.cases)
    if (isOf(setup, name)) cases.push_back(&setup);
  return runsOf(cases, fmt::format("runs of the family \"{}\"", name));
}

RunSet ClaimScope::timed() const {
  RunSet all = runsOf(interpretation.timed, "runs of the families \"packings\" and \"time\"");
  all.runs = longestOfEachPacking(all.runs);
  return all;
}

std::string RunSet::missing() const {
  if (!runs.empty()) {
    std::set<std::string> cases;
    for (const CaseRun& at : runs) cases.insert(at.setup->name);
    return fmt::format("none of {} has the data ({})", label, fmt::join(cases, ", "));
  }
  if (without.empty()) return fmt::format("there are no {}: no case of theirs", label);
  return fmt::format("there are no {}: none of {}", label, fmt::join(without, ", "));
}

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
