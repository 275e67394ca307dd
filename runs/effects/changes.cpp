#include "runs/effects/changes.hpp"

#include <cmath>

#include "runs/common/records.hpp"
#include "runs/couette/agreement_table.hpp"
#include "runs/couette/paired_rings.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

struct Ring {
  TestedRing test;                  ///< of no change: margin 0, on the scale of the case's margin
  PairedSample plain;               ///< in the field's unit
  std::optional<double> reference;  ///< mean over packings
  std::optional<double> withinRun;  ///< error of the only packing's difference
};

struct Field {
  std::string name, unit;
  bool judged;
  std::vector<Ring> rings;
};

/// The two runs' own errors together, where one packing is all there is.
std::optional<double> combined(const Numbers& one, const Numbers& other) {
  for (std::size_t k = 0; k < one.size() && k < other.size(); ++k)
    if (one[k] && other[k]) return std::hypot(*one[k], *other[k]);
  return std::nullopt;
}

struct PairedRuns {
  std::vector<const json*> whole, switched;
  std::size_t packings;
};

/// Of a relative margin ratios are tested, as they are against the margin: so what is shown to lie
/// beyond the margin is also told apart from no change, µ = 0 being the smaller claim of the same
/// test.
TestedRing testOfNoChange(const Margin* margin, const Numbers& whole, const Numbers& switched) {
  TestedRing ring = testedRing(margin ? *margin : Margin{}, whole, switched);
  ring.sample.margin = 0.0;
  return ring;
}

std::vector<Ring> ringsOf(const PairedRuns& runs, const json& method, const std::string& field,
                          const Margin* margin) {
  const auto means = [&](const auto& of) { return fieldByRing(of, method, field, runs.packings); };
  const auto errors = [&](const auto& of) {
    return fieldByRing(of, method, field, runs.packings, "stderr");
  };
  const auto whole = means(runs.whole), switched = means(runs.switched);
  const auto wholeError = errors(runs.whole), switchedError = errors(runs.switched);
  std::vector<Ring> rings;
  for (std::size_t ring = 0; ring < std::min(whole.size(), switched.size()); ++ring) {
    const auto mean = ensembleMean(whole[ring]);
    rings.push_back({testOfNoChange(margin, whole[ring], switched[ring]),
                     {whole[ring], switched[ring], 0.0, {}},
                     mean ? std::optional(mean->mean) : std::nullopt,
                     combined(wholeError[ring], switchedError[ring])});
  }
  return rings;
}

std::vector<Field> fieldsOf(const Case& setup, const PairedRuns& runs) {
  const json method = setup.averaging.methods.front();
  const auto& margins = setup.averaging.margins;
  std::vector<Field> fields;
  for (const json& profile : (*runs.whole.front())["profiles"]) {
    if (profile["method"] != method) continue;
    const std::string name = profile["field"];
    const auto margin = margins.find(name);
    fields.push_back(
        {name, profile["unit"], margins.empty() || margin != margins.end(),
         ringsOf(runs, method, name, margin == margins.end() ? nullptr : &margin->second)});
  }
  return fields;
}

json ringJson(std::size_t index, const Ring& ring) {
  return {{"ring", index},       {"reference", toJson(ring.reference)},
          {"change", nullptr},   {"stderr", nullptr},
          {"p", nullptr},        {"resolved", nullptr},
          {"low", nullptr},      {"high", nullptr},
          {"smallest", nullptr}, {"verdict", ""}};
}

/// Sets what the paired packings say in the field's own unit.
void describe(json& row, const Ring& ring) {
  const auto found = comparePaired({&ring.plain, 1}, 0.95).front();
  if (!found || found->packings == 0) return;
  row["change"] = found->difference;
  row["stderr"] = toJson(found->packings == 1 ? ring.withinRun : found->standardError);
}

/// How the family of a leg's tests ended.
struct Family {
  double confidence;
  std::size_t tests = 0, rejected = 0;
  bool resolves(const PairedComparison& one) const { return *one.pDisagree <= 1.0 - confidence; }
};

/// Sets the verdict and the interval that it rests on: half as wide as the smallest change that
/// would have been told apart, so that it leaves out 0 exactly if the change is. Holm (1979) holds
/// the largest t against the level α/m of m tests, the next against α/(m − 1), and stops at the
/// first that fails, the K + 1st: all that he rejects pass α/(m − K + 1), all others fail
/// α/(m − K).
void judge(json& row, const Ring& ring, const PairedComparison& found, const Family& family) {
  if (!found.pDisagree) return;
  const bool resolved = family.resolves(found);
  row["p"] = *found.pDisagree;
  row["resolved"] = resolved;
  const auto half =
      smallestSignificant(*found.standardError, found.packings,
                          family.tests - family.rejected + (resolved ? 1 : 0), family.confidence);
  row["low"] = inUnit(ring.test, found.difference - *half);
  row["high"] = inUnit(ring.test, found.difference + *half);
  row["smallest"] = std::abs(inUnit(ring.test, std::copysign(*half, found.difference)));
}

/// Field by field, each a list of its rings' rows.
std::vector<json> rowsOf(const std::vector<Field>& fields, double confidence) {
  std::vector<PairedSample> judged;
  for (const Field& field : fields)
    for (const Ring& ring : field.rings)
      if (field.judged) judged.push_back(ring.test.sample);
  const auto results = comparePaired(judged, confidence);
  Family family{confidence};
  for (const auto& found : results)
    if (found && found->pDisagree) {
      ++family.tests;
      family.rejected += family.resolves(*found);
    }

  auto next = results.begin();
  std::vector<json> rows;
  for (const Field& field : fields) {
    json ofField = json::array();
    for (std::size_t ring = 0; ring < field.rings.size(); ++ring) {
      json row = ringJson(ring, field.rings[ring]);
      describe(row, field.rings[ring]);
      if (field.judged)
        if (const auto& found = *next++) judge(row, field.rings[ring], *found, family);
      ofField.push_back(std::move(row));
    }
    rows.push_back(std::move(ofField));
  }
  return rows;
}

std::size_t packingsInBoth(const PairedRuns& runs) {
  std::size_t both = 0;
  for (const json* whole : runs.whole)
    for (const json* switched : runs.switched)
      both += (*whole)["packing"] == (*switched)["packing"];
  return both;
}

}  // namespace

json effectChanges(const Case& setup, const json& runs, const std::string& engine,
                   const std::string& without) {
  const PairedRuns paired = {finishedRuns(runs, engine), finishedRuns(runs, engine, without),
                             packingsOf(runs)};
  json changes = {{"packings", packingsInBoth(paired)}, {"fields", json::array()}};
  changes["stderr_kind"] = changes["packings"] == 1 ? "within_run" : "packings";
  if (changes["packings"] == 0) return changes;
  const auto fields = fieldsOf(setup, paired);
  const auto rows = rowsOf(fields, setup.averaging.confidence);
  const json margins = agreementOf(setup, runs, {{engine, engine, "effect", without}});
  for (std::size_t k = 0; k < fields.size(); ++k) {
    json field = {{"field", fields[k].name},
                  {"unit", fields[k].unit},
                  {"judged", fields[k].judged},
                  {"verdict", ""},
                  {"rings", rows[k]}};
    for (const json& row : margins) {
      if (row["field"] != fields[k].name) continue;
      field["verdict"] = row["verdict"];
      for (const json& ring : row["rings"])
        field["rings"].at(ring["ring"].get<std::size_t>())["verdict"] = ring["verdict"];
    }
    changes["fields"].push_back(std::move(field));
  }
  return changes;
}

}  // namespace crossgrain::inline runs
