#include "runs/agreement_table.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "runs/records.hpp"

namespace crossgrain {

using nlohmann::json;
using Numbers = std::vector<std::optional<double>>;

namespace {

/// The finished runs of one engine, in the order of packings.
std::vector<const json*> runsOf(const json& runs, const std::string& engine) {
  std::vector<const json*> found;
  for (const json& run : runs)
    if (run["engine"] == engine && run["status"] == "finished") found.push_back(&run);
  std::ranges::sort(found, {}, [](const json* run) { return (*run)["packing"].get<int>(); });
  return found;
}

const json* profileOf(const json& run, const json& method, const std::string& field) {
  for (const json& profile : run["profiles"])
    if (profile["field"] == field && profile["method"] == method) return &profile;
  return nullptr;
}

/// Mean and error over packings of one number per run.
json ensembleRow(json row, const Numbers& perPacking) {
  const auto mean = ensembleMean(perPacking);
  row["value"] = mean ? json(mean->mean) : json(nullptr);
  row["stderr"] = mean ? toJson(mean->standardError) : json(nullptr);
  row["packings"] = mean ? mean->packings : 0;
  return row;
}

/// Rows of `list` ("fits" or "head") by name, averaged over runs.
json ensembleRows(const std::vector<const json*>& runs, const char* list) {
  json rows = json::array();
  for (const json& first : (*runs.front())[list]) {
    Numbers perPacking;
    for (const json* run : runs)
      for (const json& row : (*run)[list])
        if (row["name"] == first["name"]) perPacking.push_back(optionalNumber(row["value"]));
    json row = ensembleRow(first, perPacking);
    if (row["value"].is_number()) row["reason"] = "";
    rows.push_back(row);
  }
  return rows;
}

json ensembleProfile(const std::vector<const json*>& runs, const json& like) {
  std::vector<Numbers> perRing(like["mean"].size());
  for (const json* run : runs) {
    const json* profile = profileOf(*run, like["method"], like["field"]);
    const Numbers mean = profile ? optionalNumbers((*profile)["mean"]) : Numbers{};
    for (std::size_t ring = 0; ring < perRing.size(); ++ring)
      perRing[ring].push_back(ring < mean.size() ? mean[ring] : std::nullopt);
  }
  Numbers mean, error, count;
  for (const Numbers& packings : perRing) {
    const auto ensemble = ensembleMean(packings);
    mean.push_back(ensemble ? std::optional(ensemble->mean) : std::nullopt);
    error.push_back(ensemble ? ensemble->standardError : std::nullopt);
    count.push_back(ensemble ? std::optional<double>(ensemble->packings) : std::nullopt);
  }
  return profileJson(like["method"], like["field"], like["unit"], mean, error, count);
}

/// The mean of one field in each ring, by packing index.
std::vector<Numbers> fieldByRing(const std::vector<const json*>& runs, const json& method,
                                 const std::string& field, std::size_t packings) {
  std::vector<Numbers> rings;
  for (const json* run : runs) {
    const json* profile = profileOf(*run, method, field);
    if (!profile) continue;
    const Numbers mean = optionalNumbers((*profile)["mean"]);
    rings.resize(std::max(rings.size(), mean.size()), Numbers(packings));
    for (std::size_t ring = 0; ring < mean.size(); ++ring)
      rings[ring][(*run)["packing"].get<std::size_t>()] = mean[ring];
  }
  return rings;
}

/// One ring as it is put to the test. A relative margin is one on the ratio of the two engines:
/// where every packing has a positive value it is tested on logarithms, whose paired differences
/// scatter far less than those of the values, for a packing that is stiffer for one engine is so
/// for all.
struct TestedRing {
  PairedSample sample;
  bool logarithmic = false;
  double reference = 0.0;  ///< mean over packings, in the field's unit
};

TestedRing testedRing(const Margin& margin, const Numbers& reference, const Numbers& other) {
  const auto mean = ensembleMean(reference);
  TestedRing ring;
  ring.reference = mean ? std::abs(mean->mean) : 0.0;
  ring.sample = {reference, other, margin.relative ? margin.value * ring.reference : margin.value};
  const auto positive = [](const std::optional<double>& value) { return !value || *value > 0.0; };
  ring.logarithmic = margin.relative && mean && std::ranges::all_of(reference, positive) &&
                     std::ranges::all_of(other, positive);
  if (!ring.logarithmic) return ring;
  for (auto* values : {&ring.sample.reference, &ring.sample.other})
    for (auto& value : *values)
      if (value) value = std::log(*value);
  ring.sample.margin = std::log1p(margin.value);
  return ring;
}

/// What was found, in the field's unit: a ratio as the difference that it makes to the reference.
json ringJson(std::size_t index, const TestedRing& ring, const PairedComparison& found,
              const Margin& margin) {
  const auto inUnit = [&](double value) {
    return ring.logarithmic ? ring.reference * std::expm1(value) : value;
  };
  const auto bound = [&](const std::optional<double>& value) {
    return value ? json(inUnit(*value)) : json(nullptr);
  };
  json error = toJson(found.standardError);
  if (ring.logarithmic && found.standardError)
    error = ring.reference * std::exp(found.difference) * *found.standardError;
  return {{"ring", index},
          {"difference", inUnit(found.difference)},
          {"stderr", error},
          {"low", bound(found.low)},
          {"high", bound(found.high)},
          {"margin", margin.relative ? margin.value * ring.reference : margin.value},
          {"scale", ring.logarithmic ? "logarithmic" : "linear"},
          {"packings", found.packings},
          {"verdict", toString(found.verdict)}};
}

json pairAgreement(const Case& setup, const json& runs, const ComparedPair& pair) {
  const auto reference = runsOf(runs, pair.reference);
  const auto other = runsOf(runs, pair.other);
  if (reference.empty() || other.empty()) return json::array();
  const json method = setup.averaging.methods.front();
  std::size_t packings = 0;
  for (const json& run : runs) packings = std::max(packings, run["packing"].get<std::size_t>() + 1);

  // All rings of all fields are one family of tests, so they are put through together.
  struct Field {
    std::string name;
    const Margin* margin;
    std::size_t first, rings;
  };
  std::vector<Field> fields;
  std::vector<TestedRing> tested;
  for (const auto& [name, margin] : setup.averaging.margins) {
    const auto ours = fieldByRing(reference, method, name, packings);
    const auto theirs = fieldByRing(other, method, name, packings);
    const std::size_t rings = std::min(ours.size(), theirs.size());
    if (rings == 0) continue;
    fields.push_back({name, &margin, tested.size(), rings});
    for (std::size_t ring = 0; ring < rings; ++ring)
      tested.push_back(testedRing(margin, ours[ring], theirs[ring]));
  }
  std::vector<PairedSample> family;
  for (const TestedRing& ring : tested) family.push_back(ring.sample);
  const auto results = comparePaired(family, setup.averaging.confidence);

  json table = json::array();
  for (const Field& field : fields) {
    const std::span rings(results.begin() + static_cast<std::ptrdiff_t>(field.first), field.rings);
    const FieldVerdict verdict = fieldVerdict(rings);
    json rows = json::array();
    for (std::size_t ring = 0; ring < field.rings; ++ring)
      if (rings[ring])
        rows.push_back(ringJson(ring, tested[field.first + ring], *rings[ring], *field.margin));
    table.push_back(
        {{"a", pair.reference},
         {"b", pair.other},
         {"kind", pair.kind},
         {"field", field.name},
         {"margin", field.margin->value},
         {"margin_relative", field.margin->relative},
         {"margin_why", field.margin->why},
         {"verdict", toString(verdict.verdict)},
         {"more_packings", verdict.morePackings ? json(*verdict.morePackings) : json(nullptr)},
         {"rings", rows}});
  }
  return table;
}

}  // namespace

json ensembleOf(const json& runs, const std::vector<std::string>& engines) {
  json ensemble = json::array();
  for (const std::string& engine : engines) {
    const auto finished = runsOf(runs, engine);
    if (finished.empty()) continue;
    json profiles = json::array();
    for (const json& profile : (*finished.front())["profiles"])
      profiles.push_back(ensembleProfile(finished, profile));
    ensemble.push_back({{"engine", engine},
                        {"packings", finished.size()},
                        {"profiles", profiles},
                        {"fits", ensembleRows(finished, "fits")},
                        {"head", ensembleRows(finished, "head")}});
  }
  return ensemble;
}

json agreementOf(const Case& setup, const json& runs, const std::vector<ComparedPair>& pairs) {
  json table = json::array();
  for (const ComparedPair& pair : pairs)
    for (json& row : pairAgreement(setup, runs, pair)) table.push_back(std::move(row));
  return table;
}

}  // namespace crossgrain
