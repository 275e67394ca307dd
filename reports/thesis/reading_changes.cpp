#include "reports/thesis/reading_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/leg_choices.hpp"
#include "reports/thesis/leg_rings.hpp"

namespace crossgrain::reports {

namespace {

/// Labels are 0.001 apart or more.
constexpr double sameNu = 6e-4;

std::optional<double> ringNumber(const LegRun& at, const char* field, std::size_t ring) {
  const Profile* const profile = profileOf(at.run->run.profiles, field);
  return profile ? reports::at(profile->mean, ring) : std::nullopt;
}

/// Mean over the rings of 8 ≤ r̃ < 16, well outside of the band and off the outer wall.
std::optional<double> bulkNumber(const LegRun& at, const char* field) {
  const auto view = ringViewOf(*at.leg, *at.run);
  if (!view) return std::nullopt;
  const Numbers place = valuesIn(*view, {"r_tilde"}), values = valuesIn(*view, {field});
  std::vector<std::optional<double>> bulk;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (*place[k] >= 8.0 && *place[k] < 16.0) bulk.push_back(values[k]);
  return meanOfRuns(bulk).mean;
}

std::optional<double> lgOf(const std::optional<double>& value) {
  return value && *value > 0.0 ? std::optional(std::log10(*value)) : std::nullopt;
}

std::optional<double> scaled(const std::optional<double>& value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

/// What a family's legs differ in, and that alone.
struct FamilyChange {
  const char* family;
  bool (*differs)(const LegSettings& own, const LegSettings& reference);
  std::string (*words)(const LegSettings& own);
};

template <std::size_t k>
bool openDiffers(const LegSettings& own, const LegSettings& reference) {
  return !sameSetting(own.*openChoices[k].value, reference.*openChoices[k].value);
}
template <std::size_t k>
std::string openWords(const LegSettings& own) {
  return wordsOf(openChoices[k], own);
}

constexpr FamilyChange familyChanges[] = {
    {"spacing", openDiffers<0>, openWords<0>},
    {"mass", openDiffers<1>, openWords<1>},
    {"radius", openDiffers<2>, openWords<2>},
    {"kn",
     [](const LegSettings& own, const LegSettings& reference) {
       return !sameSetting(own.kn, reference.kn);
     },
     [](const LegSettings& own) { return fmt::format("k_n {} N/m", readableSetting(own.kn)); }},
    {"bottom",
     [](const LegSettings& own, const LegSettings& reference) {
       return own.bottomFriction != reference.bottomFriction;
     },
     [](const LegSettings& own) {
       return std::string(own.bottomFriction ? "friction with the plate"
                                             : "no friction with the plate");
     }},
    {"friction",
     [](const LegSettings& own, const LegSettings& reference) {
       return !sameSetting(own.mu, reference.mu);
     },
     [](const LegSettings& own) { return fmt::format("µ = {}", readableSetting(own.mu)); }},
    {"rate",
     [](const LegSettings& own, const LegSettings& reference) {
       return !sameSetting(own.omega, reference.omega);
     },
     wordsOfRate}};

/// The one thing that the leg differs in; null: none, or several.
const FamilyChange* changeOf(const LegSettings& own, const LegSettings& reference) {
  const FamilyChange* only = nullptr;
  for (const FamilyChange& each : familyChanges) {
    if (!each.differs(own, reference)) continue;
    if (only) return nullptr;
    only = &each;
  }
  return only;
}

struct RunPair {
  LegRun own, standard;
};

std::string rotationWords(const ThesisLeg& leg) {
  return fmt::format("{:g} to {:g}", leg.settleRotations,
                     leg.settleRotations + leg.averagedRotations);
}

/// Runs of one engine, leg by leg with the leg of the default beside it.
class PairsOfEngine {
 public:
  PairsOfEngine(const ThesisResults& results, const std::string& engine,
                const LegSettings& reference)
      : results_(results), engine_(engine) {
    for (const ThesisLeg& leg : results.legs)
      if (const LegSettings own = settingsOf(leg);
          sameLaw(own, reference) && sameBut(nullptr, false, own, reference))
        standard_.push_back(&leg);
  }

  std::vector<RunPair> of(const ThesisLeg& leg) const {
    std::vector<RunPair> pairs;
    for (const ThesisRun* run : finishedRuns(results_, leg, engine_))
      if (const LegRun standard = counterpart(leg, run->packing); standard.run)
        pairs.push_back({{&leg, run}, standard});
    return pairs;
  }

 private:
  LegRun counterpart(const ThesisLeg& leg, int packing) const {
    for (const ThesisLeg* each : standard_) {
      if (std::abs(each->label - leg.label) > sameNu || rotationWords(*each) != rotationWords(leg))
        continue;
      for (const ThesisRun* run : finishedRuns(results_, *each, engine_))
        if (run->packing == packing) return {each, run};
    }
    return {};
  }

  const ThesisResults& results_;
  const std::string& engine_;
  std::vector<const ThesisLeg*> standard_;
};

std::vector<ReadingChange> changesOver(const std::vector<RunPair>& pairs) {
  std::vector<ReadingChange> changes;
  for (const ProfileNumber& number : profileNumbers()) {
    std::vector<std::optional<double>> standards, differences;
    for (const RunPair& pair : pairs) {
      const auto own = number.of(pair.own), standard = number.of(pair.standard);
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

/// A reading's pairs; in one part, or by ν̄.
struct Gathered {
  const FamilyChange* family;
  std::string words, rotations;
  std::optional<double> label;  ///< of a part
  std::vector<RunPair> pairs;
};

std::vector<Gathered> gather(const ThesisResults& results, const std::string& engine,
                             const LegSettings& reference, bool eachDensity) {
  std::vector<Gathered> all;
  const PairsOfEngine pairsOf(results, engine, reference);
  for (const ThesisLeg& leg : results.legs) {
    const LegSettings own = settingsOf(leg);
    const FamilyChange* const family = changeOf(own, reference);
    if (!family || !isOf(leg, family->family)) continue;
    const std::string words = family->words(own), rotations = rotationWords(leg);
    const auto label = eachDensity ? std::optional(leg.label) : std::nullopt;
    auto found = std::ranges::find_if(all, [&](const Gathered& each) {
      return each.words == words && each.rotations == rotations && each.label == label;
    });
    if (found == all.end()) found = all.insert(all.end(), {family, words, rotations, label, {}});
    const std::vector<RunPair> pairs = pairsOf.of(leg);
    found->pairs.insert(found->pairs.end(), pairs.begin(), pairs.end());
  }
  std::ranges::stable_sort(all, {}, [](const Gathered& each) { return each.family; });
  return all;
}

}  // namespace

const std::vector<ProfileNumber>& profileNumbers() {
  static const std::vector<ProfileNumber> numbers = {
      {"filling_wheel", "ν, ring 1", "",
       [](const LegRun& at) { return ringNumber(at, "volume_fraction", 0); }},
      {"filling_bulk", "ν, bulk", "",
       [](const LegRun& at) { return bulkNumber(at, "volume_fraction"); }},
      {"velocity_wheel", "v_φ/(ΩR_i), ring 1", "",
       [](const LegRun& at) {
         const CouetteCell& cell = at.leg->cell;
         return scaled(ringNumber(at, "azimuthal_velocity", 0),
                       1.0 / (cell.omega * cell.innerRadius));
       }},
      {"velocity_decay", "B of v_φ", "d",
       [](const LegRun& at) { return fittedIn(*at.run, "velocity_decay"); }},
      {"spin_wheel", "S d/(ΩD), ring 1", "",
       [](const LegRun& at) {
         const CouetteCell& cell = at.leg->cell;
         return scaled(ringNumber(at, "spin", 0),
                       cell.diameter / (cell.omega * 2.0 * cell.innerRadius));
       }},
      {"stress_rr_bulk", "lg σ_rr [N/m²], bulk", "",
       [](const LegRun& at) { return lgOf(bulkNumber(at, "stress_rr")); }},
      {"stress_rp_wheel", "lg σ_rφ [N/m²], ring 1", "",
       [](const LegRun& at) { return lgOf(ringNumber(at, "stress_rp", 0)); }},
      {"fabric_bulk", "tr F, bulk", "",
       [](const LegRun& at) { return bulkNumber(at, "fabric_trace"); }},
      {"wheel_contacts", "wheel contacts", "", [](const LegRun& at) -> std::optional<double> {
         const auto& regime = at.run->run.regime;
         return regime ? regime->wheelContacts : std::nullopt;
       }}};
  return numbers;
}

std::vector<ReadingRow> readingRows(const ThesisResults& results, bool eachDensity) {
  std::vector<ReadingRow> rows;
  const ThesisLeg* const first = referenceLeg(results);
  if (!first) return rows;
  const LegSettings reference = settingsOf(*first);
  std::vector<std::string> engines = enginesWithRuns(results);
  if (engines.empty()) engines = {absentText};
  for (const std::string& engine : engines)
    for (const Gathered& of : gather(results, engine, reference, eachDensity)) {
      if (of.pairs.empty() && engine != engines.front()) continue;
      std::set<double> labels;
      for (const RunPair& pair : of.pairs) labels.insert(pair.own.leg->label);
      if (of.label) labels.insert(*of.label);
      rows.push_back({of.family->family,
                      of.words,
                      engine,
                      {labels.begin(), labels.end()},
                      of.rotations,
                      static_cast<int>(of.pairs.size()),
                      changesOver(of.pairs)});
    }
  return rows;
}

std::string readingsCsv(const ThesisResults& results) {
  std::string table =
      "engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs\n";
  for (const bool eachDensity : {false, true})
    for (const ReadingRow& of : readingRows(results, eachDensity))
      for (std::size_t k = 0; k < of.changes.size(); ++k) {
        const ReadingChange& change = of.changes[k];
        const std::string nu = eachDensity ? fmt::format("{:.3f}", of.labels.front()) : "";
        table += row(of.engine, of.family, of.words, nu, of.rotations,
                     std::string(profileNumbers()[k].label), std::string(profileNumbers()[k].unit),
                     change.standard, change.change, change.error,
                     static_cast<std::size_t>(change.pairs));
      }
  return table;
}

}  // namespace crossgrain::reports
