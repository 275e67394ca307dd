#include "studies/flow/agreement_table.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "studies/flow/paired_rings.hpp"

namespace crossgrain::inline studies {

namespace {

/// In the field's unit; of a relative one none where the reference has nothing.
std::optional<double> marginOf(const TestedRing& ring, const Margin& margin) {
  if (!margin.relative) return margin.value;
  if (!(ring.reference > 0.0)) return std::nullopt;
  return margin.value * ring.reference;
}

/// What was found, in the field's unit: a ratio as the difference that it makes to the reference.
/// @param detects  the smallest difference that such a test finds, on its own scale
AgreementRing ringRow(std::size_t index, const TestedRing& ring, const PairedComparison& found,
                      const Margin& margin, std::optional<double> detects) {
  const auto bound = [&](const std::optional<double>& value) {
    return value ? std::optional(inUnit(ring, *value)) : std::nullopt;
  };
  // The larger of two negative values has the smaller logarithm.
  const auto& [low, high] =
      ring.sign < 0.0 ? std::tie(found.high, found.low) : std::tie(found.low, found.high);
  AgreementRing row;
  row.ring = index;
  if (found.packings > 0) row.difference = inUnit(ring, found.difference);
  row.standardError = found.standardError;
  if (ring.logarithmic && found.standardError)
    row.standardError = ring.reference * std::exp(found.difference) * *found.standardError;
  row.low = bound(low);
  row.high = bound(high);
  row.margin = marginOf(ring, margin);
  if (detects) row.detects = std::abs(inUnit(ring, *detects));
  row.withinFraction = found.withinFraction;
  row.scale = ring.logarithmic ? TestScale::logarithmic : TestScale::linear;
  row.packings = found.packings;
  row.verdict = found.verdict;
  return row;
}

std::optional<double> detectable(const TestedRing& ring, const PairedComparison& found,
                                 double level) {
  if (!found.standardError) return std::nullopt;
  return smallestDetectable(*found.standardError, found.packings, ring.sample.margin, level);
}

/// What a difference in all rings must at least be to be found: the ring that shows it best.
std::optional<double> smallestOf(const std::vector<AgreementRing>& rings) {
  std::optional<double> smallest;
  for (const AgreementRing& ring : rings)
    if (ring.detects && (!smallest || *ring.detects < *smallest)) smallest = ring.detects;
  return smallest;
}

/// All rings of all fields are one family of tests, so they are put through together.
struct Family {
  struct Field {
    std::string name;
    const Margin* margin;
    std::size_t first, rings;
  };
  std::vector<Field> fields;
  std::vector<TestedRing> tested;
};

Family familyOf(const Case& setup, const Runs& reference, const Runs& other, std::size_t packings) {
  const std::string& method = setup.averaging.methods.front();
  Family family;
  for (const auto& [name, margin] : setup.averaging.margins) {
    const auto ours = fieldByRing(reference, method, name, packings);
    const auto theirs = fieldByRing(other, method, name, packings);
    const std::size_t rings = std::min(ours.size(), theirs.size());
    if (rings == 0) continue;
    family.fields.push_back({name, &margin, family.tested.size(), rings});
    const auto error = &Profile::standardError;
    const auto ourError = fieldByRing(reference, method, name, packings, error);
    const auto theirError = fieldByRing(other, method, name, packings, error);
    for (std::size_t ring = 0; ring < rings; ++ring) {
      family.tested.push_back(testedRing(margin, ours[ring], theirs[ring]));
      if (ring < ourError.size() && ring < theirError.size())
        addWithinVariance(family.tested.back(), ourError[ring], theirError[ring]);
    }
  }
  return family;
}

std::vector<AgreementRow> pairAgreement(const Case& setup, std::span<const FlowRun> runs,
                                        const ComparedPair& pair) {
  const Runs reference = finishedRuns(runs, pair.reference);
  const Runs other = finishedRuns(runs, pair.other, pair.without);
  if (reference.empty() || other.empty()) return {};
  const Family family = familyOf(setup, reference, other, packingsOf(runs));
  std::vector<PairedSample> samples;
  for (const TestedRing& ring : family.tested) samples.push_back(ring.sample);
  const auto results = comparePaired(samples, setup.averaging.confidence);

  const auto tests =
      std::ranges::count_if(results, [](const auto& ring) { return ring && ring->pDisagree; });
  // Holm's first step: what is found there is found whatever the other rings are.
  const double level =
      (1.0 - setup.averaging.confidence) / static_cast<double>(std::max<std::ptrdiff_t>(tests, 1));

  std::vector<AgreementRow> table;
  for (const Family::Field& field : family.fields) {
    const std::span rings(results.begin() + static_cast<std::ptrdiff_t>(field.first), field.rings);
    const FieldVerdict verdict = fieldVerdict(rings);
    AgreementRow row;
    row.a = pair.reference;
    row.b = pair.other;
    row.kind = pair.kind;
    row.field = field.name;
    row.margin = field.margin->value;
    row.marginRelative = field.margin->relative;
    row.marginWhy = field.margin->why;
    row.verdict = verdict.verdict;
    for (std::size_t ring = 0; ring < field.rings; ++ring) {
      const TestedRing& tested = family.tested[field.first + ring];
      if (rings[ring])
        row.rings.push_back(ringRow(ring, tested, *rings[ring], *field.margin,
                                    detectable(tested, *rings[ring], level)));
    }
    row.detects = smallestOf(row.rings);
    table.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::vector<AgreementRow> agreementOf(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs) {
  std::vector<AgreementRow> table;
  for (const ComparedPair& pair : pairs)
    for (AgreementRow& row : pairAgreement(setup, runs, pair)) table.push_back(std::move(row));
  return table;
}

}  // namespace crossgrain::inline studies
