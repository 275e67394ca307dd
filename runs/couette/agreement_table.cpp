#include "runs/couette/agreement_table.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "runs/common/records.hpp"
#include "runs/couette/paired_rings.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// Angles next to the first one, not on the far side of ±π.
void unwrap(Numbers& angles, double period) {
  std::optional<double> first;
  for (auto& angle : angles) {
    if (!angle) continue;
    if (!first) first = angle;
    angle = *first + std::remainder(*angle - *first, period);
  }
}

/// Mean and error over packings of one number per run. A fit that most packings refuse is not one
/// of the ensemble: those that let themselves be fitted are no sample of all.
json ensembleRow(json row, Numbers perPacking, bool fit) {
  if (row.contains("period")) unwrap(perPacking, row["period"]);
  const auto mean = ensembleMean(perPacking);
  const int found = mean ? mean->packings : 0;
  const bool most = 2 * found >= static_cast<int>(perPacking.size());
  const bool says = mean && (most || !fit);
  row["value"] = says ? json(mean->mean) : json(nullptr);
  row["stderr"] = says ? toJson(mean->standardError) : json(nullptr);
  row["packings"] = found;
  if (fit) row["of_packings"] = perPacking.size();
  return row;
}

/// Rows of `list` ("fits" or "head") by name, averaged over runs.
json ensembleRows(const std::vector<const json*>& runs, const char* list) {
  const bool fits = std::string_view(list) == "fits";
  json rows = json::array();
  for (const json& first : (*runs.front())[list]) {
    Numbers perPacking, chi2;
    std::string reason;
    json like = first;
    for (const json* run : runs)
      for (const json& row : (*run)[list]) {
        if (row["name"] != first["name"]) continue;
        perPacking.push_back(optionalNumber(row["value"]));
        chi2.push_back(optionalNumber(row.value("chi2_per_dof", json())));
        if (row.contains("period")) like["period"] = row["period"];
        if (reason.empty()) reason = row.value("reason", "");
      }
    json row = ensembleRow(like, perPacking, fits);
    const bool says = row["value"].is_number();
    const auto mean = ensembleMean(chi2);
    row["chi2_per_dof"] = says && mean ? json(mean->mean) : json(nullptr);
    row["reason"] = says ? "" : reason;
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
  Numbers mean, error, count, dof;
  for (const Numbers& packings : perRing) {
    const auto ensemble = ensembleMean(packings);
    mean.push_back(ensemble ? std::optional(ensemble->mean) : std::nullopt);
    error.push_back(ensemble ? ensemble->standardError : std::nullopt);
    count.push_back(ensemble ? std::optional<double>(ensemble->packings) : std::nullopt);
    dof.push_back(ensemble && ensemble->standardError
                      ? std::optional<double>(ensemble->packings - 1)
                      : std::nullopt);
  }
  json result = profileJson(like["method"], like["field"], like["unit"], mean, error, count);
  result["dof"] = toJson(dof);
  return result;
}

/// Densities cell by cell, over packings. Bins are the same in all runs of a case.
json ensembleDistribution(const std::vector<const json*>& runs, json like) {
  const auto cells = like["density"].size();
  std::vector<Numbers> perCell(cells);
  Numbers outside;
  double samples = 0.0;
  for (const json* run : runs)
    for (const json& other : run->value("distributions", json::array())) {
      if (other["quantity"] != like["quantity"] || other["ring"] != like["ring"]) continue;
      for (std::size_t cell = 0; cell < cells; ++cell)
        perCell[cell].push_back(optionalNumber(other["density"][cell]));
      outside.push_back(optionalNumber(other["outside"]));
      samples += other["samples"].get<double>();
    }
  Numbers mean, error;
  for (const Numbers& packings : perCell) {
    const auto ensemble = ensembleMean(packings);
    mean.push_back(ensemble->mean);
    error.push_back(ensemble->standardError);
  }
  like["density"] = toJson(mean);
  like["stderr"] = toJson(error);
  like["outside"] = ensembleMean(outside)->mean;
  like["samples"] = samples;
  return like;
}

/// In the field's unit; of a relative one none where the reference has nothing.
json marginOf(const TestedRing& ring, const Margin& margin) {
  if (!margin.relative) return margin.value;
  return ring.reference > 0.0 ? json(margin.value * ring.reference) : json(nullptr);
}

/// What was found, in the field's unit: a ratio as the difference that it makes to the reference.
/// @param detects  the smallest difference that such a test finds, on its own scale
json ringJson(std::size_t index, const TestedRing& ring, const PairedComparison& found,
              const Margin& margin, std::optional<double> detects) {
  const auto bound = [&](const std::optional<double>& value) {
    return value ? json(inUnit(ring, *value)) : json(nullptr);
  };
  const auto size = [&](const std::optional<double>& value) {
    return value ? json(std::abs(inUnit(ring, *value))) : json(nullptr);
  };
  // The larger of two negative values has the smaller logarithm.
  const auto& [low, high] =
      ring.sign < 0.0 ? std::tie(found.high, found.low) : std::tie(found.low, found.high);
  json error = toJson(found.standardError);
  if (ring.logarithmic && found.standardError)
    error = ring.reference * std::exp(found.difference) * *found.standardError;
  return {{"ring", index},
          {"difference", found.packings > 0 ? json(inUnit(ring, found.difference)) : json(nullptr)},
          {"stderr", error},
          {"low", bound(low)},
          {"high", bound(high)},
          {"margin", marginOf(ring, margin)},
          {"detects", size(detects)},
          {"within_share", toJson(found.withinShare)},
          {"scale", ring.logarithmic ? "logarithmic" : "linear"},
          {"packings", found.packings},
          {"verdict", toString(found.verdict)}};
}

std::optional<double> detectable(const TestedRing& ring, const PairedComparison& found,
                                 double level) {
  if (!found.standardError) return std::nullopt;
  return smallestDetectable(*found.standardError, found.packings, ring.sample.margin, level);
}

/// What a difference in all rings must at least be to be found: the ring that shows it best.
json smallestOf(const json& rings) {
  json smallest = nullptr;
  for (const json& ring : rings)
    if (ring["detects"].is_number() && (smallest.is_null() || ring["detects"] < smallest))
      smallest = ring["detects"];
  return smallest;
}

json pairAgreement(const Case& setup, const json& runs, const ComparedPair& pair) {
  const auto reference = finishedRuns(runs, pair.reference);
  const auto other = finishedRuns(runs, pair.other, pair.without);
  if (reference.empty() || other.empty()) return json::array();
  const json method = setup.averaging.methods.front();
  const std::size_t packings = packingsOf(runs);

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
    const auto ourError = fieldByRing(reference, method, name, packings, "stderr");
    const auto theirError = fieldByRing(other, method, name, packings, "stderr");
    for (std::size_t ring = 0; ring < rings; ++ring) {
      tested.push_back(testedRing(margin, ours[ring], theirs[ring]));
      if (ring < ourError.size() && ring < theirError.size())
        addWithinVariance(tested.back(), ourError[ring], theirError[ring]);
    }
  }
  std::vector<PairedSample> family;
  for (const TestedRing& ring : tested) family.push_back(ring.sample);
  const auto results = comparePaired(family, setup.averaging.confidence);

  const auto tests =
      std::ranges::count_if(results, [](const auto& ring) { return ring && ring->pDisagree; });
  // Holm's first step: what is found there is found whatever the other rings are.
  const double level =
      (1.0 - setup.averaging.confidence) / static_cast<double>(std::max<std::ptrdiff_t>(tests, 1));

  json table = json::array();
  for (const Field& field : fields) {
    const std::span rings(results.begin() + static_cast<std::ptrdiff_t>(field.first), field.rings);
    const FieldVerdict verdict = fieldVerdict(rings);
    json rows = json::array();
    for (std::size_t ring = 0; ring < field.rings; ++ring)
      if (rings[ring])
        rows.push_back(ringJson(ring, tested[field.first + ring], *rings[ring], *field.margin,
                                detectable(tested[field.first + ring], *rings[ring], level)));
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
         {"more_rotations", verdict.longerRuns
                                ? json((*verdict.longerRuns - 1.0) * setup.averaging.rotations)
                                : json(nullptr)},
         {"detects", smallestOf(rows)},
         {"rings", rows}});
  }
  return table;
}

}  // namespace

json ensembleOf(const json& runs, const std::string& engine, const std::string& without) {
  const auto finished = finishedRuns(runs, engine, without);
  if (finished.empty()) return nullptr;
  json profiles = json::array();
  for (const json& profile : (*finished.front())["profiles"])
    profiles.push_back(ensembleProfile(finished, profile));
  json distributions = json::array();
  for (const json& distribution : finished.front()->value("distributions", json::array()))
    distributions.push_back(ensembleDistribution(finished, distribution));
  return {{"engine", engine},
          {"packings", finished.size()},
          {"profiles", profiles},
          {"distributions", distributions},
          {"fits", ensembleRows(finished, "fits")},
          {"head", ensembleRows(finished, "head")}};
}

json ensembleOf(const json& runs, const std::vector<std::string>& engines) {
  json ensemble = json::array();
  for (const std::string& engine : engines)
    if (json entry = ensembleOf(runs, engine, ""); !entry.is_null())
      ensemble.push_back(std::move(entry));
  return ensemble;
}

json agreementOf(const Case& setup, const json& runs, const std::vector<ComparedPair>& pairs) {
  json table = json::array();
  for (const ComparedPair& pair : pairs)
    for (json& row : pairAgreement(setup, runs, pair)) table.push_back(std::move(row));
  return table;
}

}  // namespace crossgrain::inline runs
