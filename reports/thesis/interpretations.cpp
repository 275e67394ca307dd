// How much each interpretation of the thesis, and each constant, changes each profile.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/drawing.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {
namespace {

using Maybe = std::optional<double>;

/// Labels are 0.001 apart or more.
constexpr double sameNu = 6e-4;

/// The one thing in which a case's settings differ from the reference's, with its label.
struct FamilyChange {
  std::string family, label;
};

/// Absent: none, or several.
std::optional<FamilyChange> changeOf(const CaseSettings& own, const CaseSettings& reference) {
  std::vector<FamilyChange> all;
  for (const OpenChoice& open : openChoices)
    if (!sameSetting(own.*open.value, reference.*open.value))
      all.push_back({open.key, describe(open, own)});
  if (!sameSetting(own.kn, reference.kn))
    all.push_back({"kn", fmt::format("k_n {} N/m", readableSetting(own.kn))});
  if (own.bottomFriction != reference.bottomFriction)
    all.push_back(
        {"bottom", own.bottomFriction ? "friction with the plate" : "no friction with the plate"});
  if (!sameSetting(own.mu, reference.mu))
    all.push_back({"friction", fmt::format("µ = {}", readableSetting(own.mu))});
  if (!sameSetting(own.omega, reference.omega)) all.push_back({"rate", describeRate(own)});
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::string rotationsOf(const ThesisCase& setup) {
  return fmt::format("{:g} to {:g}", setup.settleRotations, setup.endRotation());
}

struct RunPair {
  CaseRun own, standard;
};

/// An engine's runs of a case, each with that of the default beside it.
std::vector<RunPair> pairsOf(const ThesisResults& results, const ThesisCase& setup,
                             const std::string& engine, const CaseSettings& reference) {
  std::vector<RunPair> pairs;
  for (const CaseRun& own : finishedRuns(results, setup, engine)) {
    const auto counterpart = [&]() -> CaseRun {
      for (const ThesisCase& other : results.cases) {
        if (!sameBut(nullptr, false, settingsOf(other), reference) ||
            std::abs(other.label - setup.label) > sameNu ||
            rotationsOf(other) != rotationsOf(setup))
          continue;
        for (const CaseRun& at : finishedRuns(results, other, engine))
          if (at.run->packing == own.run->packing) return at;
      }
      return {};
    }();
    if (counterpart.run) pairs.push_back({own, counterpart});
  }
  return pairs;
}

std::vector<InterpretationChange> changesOver(const std::vector<RunPair>& pairs) {
  std::vector<InterpretationChange> changes;
  for (const ProfileNumber& number : profileNumbers) {
    const Formula formula(number.formula);
    const auto of = [&](const CaseRun& at) -> Maybe {
      const auto value = formula.number(
          {at, at.run->run.profiles, "", [&](std::string_view name) -> std::optional<FormulaValue> {
             if (name != "wheel_contacts") return std::nullopt;
             const auto& regime = at.run->run.regime;
             return uncertain(regime ? regime->wheelContacts : std::nullopt);
           }});
      return value ? Maybe(value->value) : std::nullopt;
    };
    std::vector<Maybe> standards, differences;
    for (const RunPair& pair : pairs) {
      const auto own = of(pair.own), standard = of(pair.standard);
      if (!own || !standard) continue;
      standards.push_back(standard);
      differences.push_back(*own - *standard);
    }
    const auto [change, error] = meanOfRuns(differences);
    changes.push_back(
        {meanOfRuns(standards).mean, change, error, static_cast<int>(differences.size())});
  }
  return changes;
}

/// An interpretation's pairs; in one part, or by ν̄.
struct Gathered {
  std::size_t order;  ///< of the family
  FamilyChange of;
  std::string rotations;
  Maybe label;  ///< of a part
  std::vector<RunPair> pairs;
};

std::vector<Gathered> gather(const ThesisResults& results, const std::string& engine,
                             const CaseSettings& reference, bool eachDensity) {
  static const std::vector<std::string> familyOrder = {"spacing", "mass",     "radius", "kn",
                                                       "bottom",  "friction", "rate"};
  std::vector<Gathered> all;
  for (const ThesisCase& setup : results.cases) {
    const auto change = changeOf(settingsOf(setup), reference);
    if (!change || !isOf(setup, change->family)) continue;
    const std::string rotations = rotationsOf(setup);
    const Maybe label = eachDensity ? Maybe(setup.label) : std::nullopt;
    auto found = std::ranges::find_if(all, [&](const Gathered& each) {
      return each.of.label == change->label && each.rotations == rotations && each.label == label;
    });
    if (found == all.end()) {
      const auto order = std::ranges::find(familyOrder, change->family) - familyOrder.begin();
      found =
          all.insert(all.end(), {static_cast<std::size_t>(order), *change, rotations, label, {}});
    }
    const std::vector<RunPair> pairs = pairsOf(results, setup, engine, reference);
    found->pairs.insert(found->pairs.end(), pairs.begin(), pairs.end());
  }
  std::ranges::stable_sort(all, {}, &Gathered::order);
  return all;
}

}  // namespace

std::vector<InterpretationRow> interpretationRows(const ThesisResults& results, bool eachDensity) {
  std::vector<InterpretationRow> rows;
  const ThesisCase* const first = referenceCase(results);
  if (!first) return rows;
  std::vector<std::string> engines = enginesWithRuns(results);
  if (engines.empty()) engines = {absentText};
  for (const std::string& engine : engines)
    for (const Gathered& of : gather(results, engine, settingsOf(*first), eachDensity)) {
      if (of.pairs.empty() && engine != engines.front()) continue;
      std::set<double> labels;
      for (const RunPair& pair : of.pairs) labels.insert(pair.own.setup->label);
      if (of.label) labels.insert(*of.label);
      rows.push_back({of.of.family,
                      of.of.label,
                      engine,
                      {labels.begin(), labels.end()},
                      of.rotations,
                      static_cast<int>(of.pairs.size()),
                      changesOver(of.pairs)});
    }
  return rows;
}

std::string interpretationsCsv(const ThesisResults& results) {
  std::string table =
      "engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs\n";
  for (const bool eachDensity : {false, true})
    for (const InterpretationRow& of : interpretationRows(results, eachDensity))
      for (std::size_t k = 0; k < of.changes.size(); ++k) {
        const InterpretationChange& change = of.changes[k];
        const std::string nu = eachDensity ? fmt::format("{:.3f}", of.labels.front()) : "";
        table += row(of.engine, of.family, of.label, nu, of.rotations,
                     std::string(profileNumbers[k].label), std::string(profileNumbers[k].unit),
                     change.standard, change.change, change.error,
                     static_cast<std::size_t>(change.pairs));
      }
  return table;
}

}  // namespace crossgrain::reports
