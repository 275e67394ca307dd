#include "runs/effect_changes.hpp"

#include <cmath>

#include "runs/agreement_table.hpp"
#include "runs/paired_rings.hpp"
#include "runs/records.hpp"

namespace crossgrain {

using nlohmann::json;

namespace {

struct Ring {
  PairedSample sample;
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

std::vector<Ring> ringsOf(const PairedRuns& runs, const json& method, const std::string& field) {
  const auto means = [&](const auto& of) { return fieldByRing(of, method, field, runs.packings); };
  const auto errors = [&](const auto& of) {
    return fieldByRing(of, method, field, runs.packings, "stderr");
  };
  const auto whole = means(runs.whole), switched = means(runs.switched);
  const auto wholeError = errors(runs.whole), switchedError = errors(runs.switched);
  std::vector<Ring> rings;
  for (std::size_t ring = 0; ring < std::min(whole.size(), switched.size()); ++ring) {
    const auto mean = ensembleMean(whole[ring]);
    rings.push_back({{whole[ring], switched[ring], 0.0, {}},
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
    fields.push_back({name, profile["unit"], margins.empty() || margins.contains(name),
                      ringsOf(runs, method, name)});
  }
  return fields;
}

json ringJson(std::size_t index, const Ring& ring) {
  return {{"ring", index},      {"reference", toJson(ring.reference)},
          {"change", nullptr},  {"stderr", nullptr},
          {"p", nullptr},       {"resolved", nullptr},
          {"smallest", nullptr}};
}

/// Sets what the paired packings say. @param tests  in the family, 0: the field is not judged
void describe(json& row, const Ring& ring, const PairedComparison& found, std::size_t tests,
              double confidence) {
  if (found.packings == 0) return;
  row["change"] = found.difference;
  row["stderr"] = toJson(found.packings == 1 ? ring.withinRun : found.standardError);
  if (tests == 0 || !found.pDisagree) return;
  row["p"] = *found.pDisagree;
  row["resolved"] = *found.pDisagree <= 1.0 - confidence;
  row["smallest"] =
      toJson(smallestSignificant(*found.standardError, found.packings, tests, confidence));
}

/// Field by field, each a list of its rings' rows.
std::vector<json> rowsOf(const std::vector<Field>& fields, double confidence) {
  std::vector<PairedSample> judged, others;
  for (const Field& field : fields)
    for (const Ring& ring : field.rings) (field.judged ? judged : others).push_back(ring.sample);
  const auto ofJudged = comparePaired(judged, confidence);
  const auto ofOthers = comparePaired(others, confidence);
  std::size_t tests = 0;
  for (const auto& found : ofJudged) tests += found && found->pDisagree;

  auto nextJudged = ofJudged.begin();
  auto nextOther = ofOthers.begin();
  std::vector<json> rows;
  for (const Field& field : fields) {
    json ofField = json::array();
    for (std::size_t ring = 0; ring < field.rings.size(); ++ring) {
      json row = ringJson(ring, field.rings[ring]);
      const auto& found = field.judged ? *nextJudged++ : *nextOther++;
      if (found) describe(row, field.rings[ring], *found, field.judged ? tests : 0, confidence);
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
    for (const json& row : margins)
      if (row["field"] == fields[k].name) field["verdict"] = row["verdict"];
    changes["fields"].push_back(std::move(field));
  }
  return changes;
}

}  // namespace crossgrain
