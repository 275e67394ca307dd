#include "studies/effects/effects.hpp"

#include <cmath>

#include "cases/flow.hpp"
#include "studies/flow/agreement_table.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::inline studies {

namespace {

struct TestedChange {
  PairedTest test;                  ///< of no change: margin 0, on the scale of the case's margin
  PairedSample plain;               ///< in the field's unit
  std::optional<double> reference;  ///< mean over packings
  std::optional<double> withinRun;  ///< error of the only packing's difference
};

struct TestedField {
  std::string name, unit;
  bool judged;
  std::vector<TestedChange> rings;
};

/// The two runs' own errors together, where one packing is all there is. Both have a place for each
/// packing.
std::optional<double> combined(const Numbers& one, const Numbers& other) {
  for (std::size_t k = 0; k < one.size(); ++k)
    if (one[k] && other[k]) return std::hypot(*one[k], *other[k]);
  return std::nullopt;
}

struct PairedRuns {
  Runs whole, switched;
  std::size_t packings;
};

/// Of a relative margin ratios are tested, as they are against the margin: so what is shown to lie
/// beyond the margin is also significantly different from no change, µ = 0 being the smaller claim
/// of the same test.
PairedTest testOfNoChange(const Margin* margin, const Numbers& whole, const Numbers& switched) {
  PairedTest ring = testedRing(margin ? *margin : Margin{}, whole, switched);
  ring.sample.margin = 0.0;
  return ring;
}

std::vector<TestedChange> ringsOf(const PairedRuns& runs, const std::string& method,
                                  const std::string& field, const Margin* margin) {
  const auto means = [&](const auto& of) { return fieldByRing(of, method, field, runs.packings); };
  const auto errors = [&](const auto& of) {
    return fieldByRing(of, method, field, runs.packings, &Profile::standardError);
  };
  const auto whole = means(runs.whole), switched = means(runs.switched);
  const auto wholeError = errors(runs.whole), switchedError = errors(runs.switched);
  std::vector<TestedChange> tested;
  for (std::size_t ring = 0; ring < std::min(whole.size(), switched.size()); ++ring) {
    const auto mean = ensembleMean(whole[ring]);
    tested.push_back({testOfNoChange(margin, whole[ring], switched[ring]),
                      {whole[ring], switched[ring], 0.0, 0.0, {}},
                      mean ? std::optional(mean->mean) : std::nullopt,
                      combined(wholeError[ring], switchedError[ring])});
  }
  return tested;
}

std::vector<TestedField> fieldsOf(const Case& setup, const PairedRuns& runs) {
  const std::string& method = setup.averaging.methods.front();
  const auto& margins = setup.averaging.margins;
  std::vector<TestedField> fields;
  for (const Profile& profile : runs.whole.front()->profiles) {
    if (profile.method != method) continue;
    const auto margin = margins.find(profile.field);
    fields.push_back({profile.field, profile.unit, margins.empty() || margin != margins.end(),
                      ringsOf(runs, method, profile.field,
                              margin == margins.end() ? nullptr : &margin->second)});
  }
  return fields;
}

/// Sets what the paired packings say in the field's own unit.
void describe(RingChange& row, const TestedChange& ring) {
  const auto found = comparePaired({&ring.plain, 1}, 0.95).front();
  if (!found || found->packings == 0) return;
  row.change = found->difference;
  row.standardError = found->packings == 1 ? ring.withinRun : found->standardError;
}

/// Sets the verdict and the interval that it rests on, which leaves out 0 exactly if the change is
/// significant.
/// @param half  of it, smallestSignificant()
void judge(RingChange& row, const TestedChange& ring, const PairedComparison& found,
           const std::optional<double>& half, double confidence) {
  if (!found.pDisagree) return;
  row.p = *found.pDisagree;
  row.resolved = *found.pDisagree <= 1.0 - confidence;
  row.low = inUnit(ring.test, found.difference - *half);
  row.high = inUnit(ring.test, found.difference + *half);
  row.smallest = std::abs(inUnit(ring.test, std::copysign(*half, found.difference)));
}

std::vector<ChangedField> changesOf(const std::vector<TestedField>& fields, double confidence) {
  std::vector<PairedSample> judged;
  for (const TestedField& field : fields)
    for (const TestedChange& ring : field.rings)
      if (field.judged) judged.push_back(ring.test.sample);
  const auto results = comparePaired(judged, confidence);
  const auto halves = smallestSignificant(results, confidence);
  std::size_t next = 0;
  std::vector<ChangedField> changes;
  for (const TestedField& field : fields) {
    ChangedField& change = changes.emplace_back(
        ChangedField{field.name, field.unit, field.judged, Verdict::notApplicable, {}});
    for (const TestedChange& ring : field.rings) {
      RingChange row;
      row.ring = change.rings.size();
      row.reference = ring.reference;
      describe(row, ring);
      if (field.judged)
        if (const std::size_t k = next++; results[k])
          judge(row, ring, *results[k], halves[k], confidence);
      change.rings.push_back(std::move(row));
    }
  }
  return changes;
}

/// Effects add no packings: one analysis of those that the case begins with.
InterimPlan oneAnalysis(const Case& setup) {
  return interimPlanAt(flowPackings(setup), 1, 1.0 - setup.averaging.confidence);
}

std::size_t packingsInBoth(const PairedRuns& runs) {
  std::size_t both = 0;
  for (const FlowRun* whole : runs.whole)
    for (const FlowRun* switched : runs.switched) both += whole->packing == switched->packing;
  return both;
}

}  // namespace

EffectChanges effectChanges(const Case& setup, std::span<const FlowRun> runs,
                            const std::string& engine, const std::string& without) {
  const PairedRuns paired = {finishedRuns(runs, engine), finishedRuns(runs, engine, without),
                             packingsOf(runs)};
  EffectChanges changes;
  changes.packings = packingsInBoth(paired);
  changes.bars = changes.packings == 1 ? BarKind::withinRun : BarKind::packings;
  if (changes.packings == 0) return changes;
  const std::vector<ComparedPair> pairs = {{engine, engine, PairKind::effect, without}};
  changes.endpoints = hasClosedForms(setup) ? closedFormRows(setup, runs, {}, pairs)
                                            : endpointRows(setup, runs, pairs, oneAnalysis(setup),
                                                           flowPackings(setup), {});
  changes.fields = changesOf(fieldsOf(setup, paired), setup.averaging.confidence);
  for (const AgreementRow& row : agreementOf(setup, runs, pairs))
    for (ChangedField& field : changes.fields) {
      if (field.field != row.field) continue;
      field.verdict = row.verdict;
      for (const AgreementRing& ring : row.rings) field.rings.at(ring.ring).verdict = ring.verdict;
    }
  return changes;
}

}  // namespace crossgrain::inline studies
