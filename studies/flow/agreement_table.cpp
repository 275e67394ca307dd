#include "studies/flow/agreement_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace crossgrain::inline studies {

namespace {

/// In the field's unit; of a relative one none where the reference has nothing.
std::optional<double> marginOf(const PairedTest& test, const Margin& margin) {
  if (!margin.relative) return margin.value;
  if (test.reference == 0.0) return std::nullopt;
  return margin.value * std::abs(test.reference);
}

/// The difference found, in the field's unit: a ratio as the difference that it makes to the
/// reference.
/// @param level  of a test that would find a difference by itself
AgreementRing ringRow(std::size_t index, const PairedTest& test, const PairedComparison& found,
                      const Margin& margin, double level) {
  const auto bound = [&](const std::optional<double>& value) {
    return value ? std::optional(inUnit(test, *value)) : std::nullopt;
  };
  AgreementRing row;
  row.ring = index;
  if (found.packings > 0) row.difference = inUnit(test, found.difference);
  row.standardError = found.standardError;
  if (test.logarithmic && found.standardError)
    row.standardError =
        std::abs(test.reference) * std::exp(test.sign * found.difference) * *found.standardError;
  row.low = bound(found.low);
  row.high = bound(found.high);
  row.margin = marginOf(test, margin);
  if (found.standardError)
    if (const auto smallest =
            smallestDetectable(*found.standardError, found.dof, test.sample.margin, level))
      row.detects = std::abs(inUnit(test, test.sign * *smallest));
  row.withinFraction = found.withinFraction;
  row.scale = test.logarithmic ? TestScale::logarithmic : TestScale::linear;
  row.packings = found.packings;
  row.verdict = found.verdict;
  return row;
}

/// Smallest difference in all rings that is found: the ring that shows it best.
std::optional<double> smallestOf(const std::vector<AgreementRing>& rings) {
  std::optional<double> smallest;
  for (const AgreementRing& ring : rings)
    if (ring.detects && (!smallest || *ring.detects < *smallest)) smallest = ring.detects;
  return smallest;
}

/// All rings of all fields are one family of tests, so they are put through together.
struct RingFamily {
  struct Field {
    std::string name;
    const Margin* margin;
    std::size_t first, rings;
  };
  std::vector<Field> fields;
  std::vector<PairedTest> tested;
};

/// Ring by ring the median of those engines that have the field; of one its own values. Of several
/// two must have it.
std::vector<Numbers> mediansByRing(const std::vector<Runs>& engines, const std::string& method,
                                   const std::string& field, std::size_t packings) {
  std::vector<std::vector<Numbers>> all;
  std::size_t rings = SIZE_MAX;
  for (const Runs& engine : engines)
    if (auto values = fieldByRing(engine, method, field, packings); !values.empty()) {
      rings = std::min(rings, values.size());
      all.push_back(std::move(values));
    }
  if (all.size() < std::min<std::size_t>(engines.size(), 2)) return {};
  std::vector<Numbers> medians;
  for (std::size_t ring = 0; ring < rings; ++ring) {
    std::vector<Numbers> values;
    for (const auto& engine : all) values.push_back(engine[ring]);
    medians.push_back(medianByPacking(values));
  }
  return medians;
}

/// @param references  those whose median is the reference, or it alone
RingFamily ringFamilyOf(const Case& setup, const std::vector<Runs>& references, const Runs& other,
                        bool independent) {
  const std::string& method = setup.averaging.methods.front();
  const Runs& reference = references.front();
  std::size_t ourPackings = packingsOf(reference), theirPackings = packingsOf(other);
  if (!independent)
    for (const Runs& each : references)
      ourPackings = theirPackings = std::max({ourPackings, theirPackings, packingsOf(each)});
  RingFamily family;
  for (const auto& [name, margin] : setup.averaging.margins) {
    const auto ours = mediansByRing(references, method, name, ourPackings);
    const auto theirs = fieldByRing(other, method, name, theirPackings);
    const std::size_t rings = std::min(ours.size(), theirs.size());
    if (rings == 0) continue;
    family.fields.push_back({name, &margin, family.tested.size(), rings});
    const auto error = &Profile::standardError;
    const auto ourError = fieldByRing(reference, method, name, ourPackings, error);
    const auto theirError = fieldByRing(other, method, name, theirPackings, error);
    const auto dof = &Profile::dof;
    const auto ourDof = fieldByRing(reference, method, name, ourPackings, dof);
    const auto theirDof = fieldByRing(other, method, name, theirPackings, dof);
    for (std::size_t ring = 0; ring < rings; ++ring) {
      family.tested.push_back(testedRing(margin, ours[ring], theirs[ring]));
      PairedSample& sample = family.tested.back().sample;
      sample.independent = independent;
      if (independent && ring < ourDof.size() && ring < theirDof.size())
        sample.withinDof =
            std::min(ourDof[ring].front().value_or(0.0), theirDof[ring].front().value_or(0.0));
      if (references.size() == 1 && ring < ourError.size() && ring < theirError.size())
        addWithinVariance(family.tested.back(), ourError[ring], theirError[ring]);
    }
  }
  return family;
}

void addPair(std::vector<AgreementRow>& table, const Case& setup, std::span<const FlowRun> runs,
             const ComparedPair& pair, const std::vector<SurrogateEngine>& surrogates) {
  const std::vector<Runs> references = referenceRuns(runs, pair, surrogates);
  const Runs other = runsFor(runs, pair.b, surrogates, pair.without);
  if (references.empty() || other.empty()) return;
  const RingFamily family =
      ringFamilyOf(setup, references, other, independentRuns(pair, references.front(), other));
  std::vector<PairedSample> samples;
  for (const PairedTest& ring : family.tested) samples.push_back(ring.sample);
  const auto results = comparePaired(samples, setup.averaging.confidence);

  const auto tests =
      std::ranges::count_if(results, [](const auto& ring) { return ring && ring->pDisagree; });
  // Holm's first step: what is found there is found whatever the other rings are.
  const double level =
      (1.0 - setup.averaging.confidence) / static_cast<double>(std::max<std::ptrdiff_t>(tests, 1));

  for (const RingFamily::Field& field : family.fields) {
    const std::span rings(results.begin() + static_cast<std::ptrdiff_t>(field.first), field.rings);
    const FieldVerdict verdict = fieldVerdict(rings);
    AgreementRow row;
    row.a = pair.a;
    row.b = pair.b;
    row.kind = pair.kind;
    row.field = field.name;
    row.margin = field.margin->value;
    row.marginRelative = field.margin->relative;
    row.marginWhy = field.margin->why;
    row.verdict = verdict.verdict;
    for (std::size_t ring = 0; ring < field.rings; ++ring)
      if (rings[ring])
        row.rings.push_back(
            ringRow(ring, family.tested[field.first + ring], *rings[ring], *field.margin, level));
    row.detects = smallestOf(row.rings);
    table.push_back(std::move(row));
  }
}

}  // namespace

std::vector<AgreementRow> agreementOf(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs,
                                      const std::vector<SurrogateEngine>& surrogates) {
  std::vector<AgreementRow> table;
  for (const ComparedPair& pair : pairs) addPair(table, setup, runs, pair, surrogates);
  return table;
}

}  // namespace crossgrain::inline studies
