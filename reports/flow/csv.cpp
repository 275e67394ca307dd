#include <algorithm>
#include <set>

#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

const std::optional<double> noNumber;

std::string indexOf(const FlowRun& run) {
  return fmt::format("{}", run.packing);
}

/// @param bars  what the standard errors are of
std::string profileRows(const FlowFrame& frame, const std::string& engine,
                        const std::string& packing, const std::string& bars,
                        const std::vector<Profile>& profiles) {
  const FlowAveraging& when = frame.averaging;
  std::string rows;
  for (const Profile& profile : profiles)
    for (std::size_t ring = 0; ring < frame.rings.r.size(); ++ring) {
      rows +=
          row(engine, packing, profile.method, profile.field, ring + 1, at(frame.rings.r, ring),
              at(frame.rings.rTilde, ring), at(profile.mean, ring), at(profile.standardError, ring),
              at(profile.nEff, ring), profile.unit, bars, at(profile.dof, ring), when.fromRotation,
              when.toRotation, when.preparedRotations);
      if (!frame.region) continue;
      const RegionRow& region = *frame.region;
      rows.back() = ',';
      rows += row(at(region.x, ring), at(region.y, ring), std::optional(region.from),
                  std::optional(region.to));
    }
  return rows;
}

Names seriesColumns(const std::vector<FlowRun>& runs) {
  Names columns = {"wheel_torque", "outer_pressure", "kinetic_energy",
                   "coordination", "max_overlap",    "sliding_fraction"};
  std::set<std::string> further, ledger;
  for (const FlowRun& run : runs)
    for (const auto& [name, values] : run.series.value_or(RunSeries{}))
      if (name != "t_s" && std::ranges::find(columns, name) == columns.end())
        (name.starts_with("energy_") ? ledger : further).insert(name);
  columns.insert(columns.end(), further.begin(), further.end());
  columns.insert(columns.end(), ledger.begin(), ledger.end());
  return columns;
}

std::string distributionRows(const std::string& engine, const std::string& packing,
                             const std::string& bars,
                             const std::vector<Distribution>& distributions) {
  std::string rows;
  for (const Distribution& distribution : distributions) {
    const std::string place =
        distribution.ring ? fmt::format("{}", *distribution.ring + 1) : std::string("all");
    const auto edge = [&](std::size_t axis, std::size_t index) -> std::optional<double> {
      if (axis >= distribution.axes.size()) return std::nullopt;
      const Bins& bins = distribution.axes[axis];
      return bins.low + static_cast<double>(index) * bins.width;
    };
    const auto across =
        static_cast<std::size_t>(distribution.axes.empty() ? 1 : distribution.axes[0].count);
    for (std::size_t k = 0; k < distribution.density.size(); ++k) {
      const auto value = at(distribution.density, k);
      if (!value || *value == 0.0) continue;
      const std::size_t column = k % across, line = k / across;
      rows +=
          row(engine, packing, distribution.quantity, place, edge(0, column), edge(0, column + 1),
              value, at(distribution.standardError, k), edge(1, line), edge(1, line + 1), bars);
    }
    if (const auto outside = finite(distribution.outside); outside && *outside > 0.0)
      rows += row(engine, packing, distribution.quantity, place, noNumber, noNumber, outside,
                  noNumber, noNumber, noNumber, bars);
  }
  return rows;
}

/// Number of packings with different regimes; absent where it is unknown.
std::optional<double> regimesDiffer(const std::vector<RegimesOfPair>& regimes, const std::string& a,
                                    const std::string& b) {
  for (const RegimesOfPair& pair : regimes)
    if (pair.a == a && pair.b == b) return static_cast<double>(pair.differ.size());
  return std::nullopt;
}

/// Where a ring's interval lies, which is no verdict.
std::string placeOf(Verdict ring) {
  if (ring == Verdict::pass) return "within";
  return ring == Verdict::fail ? "beyond" : "open";
}

std::string steadinessRow(const SeriesDrift& drifts, const std::string& engine,
                          const std::string& packing, const FlowAveraging& when) {
  const RelativeDrift& drift = drifts.drift;
  return row(engine, packing, drifts.quantity, std::string(toString(drift.verdict)), drift.change,
             drift.half, drift.excluded, when.fromRotation, when.toRotation,
             when.preparedRotations);
}

std::string profilesCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,from_"
      "rotation,to_rotation,prepared_rotations";
  table += results.region ? ",x_m,y_m,from_s,to_s\n" : "\n";
  for (const FlowRun& run : results.runs)
    table += profileRows(results, run.engine, indexOf(run), "within_run", run.profiles);
  for (const CouetteEnsemble& ensemble : results.ensemble)
    table += profileRows(results, ensemble.engine, "all", "packings", ensemble.profiles);
  return table;
}

std::string distributionsCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,quantity,ring,low,high,density,stderr,low_2,high_2,stderr_kind\n";
  for (const FlowRun& run : results.runs)
    table += distributionRows(run.engine, indexOf(run), "within_run", run.distributions);
  for (const CouetteEnsemble& ensemble : results.ensemble)
    table += distributionRows(ensemble.engine, "all", "packings", ensemble.distributions);
  return table;
}

std::string seriesCsv(const CompareResults& results) {
  const Names columns = seriesColumns(results.runs);
  std::string table = "engine,packing,t_s";
  for (const std::string& column : columns) table += "," + cell(column);
  table += "\n";
  for (const FlowRun& run : results.runs) {
    if (!run.series) continue;
    const Numbers& times = valuesOf(*run.series, "t_s");
    for (std::size_t k = 0; k < times.size(); ++k) {
      table += cell(run.engine) + "," + indexOf(run) + "," + cell(times[k]);
      for (const std::string& column : columns)
        table += "," + cell(at(valuesOf(*run.series, column), k));
      table += "\n";
    }
  }
  return table;
}

std::string regimesCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,"
      "from_rotation,to_rotation,prepared_rotations,reason\n";
  const FlowAveraging& when = results.averaging;
  for (const FlowRun& run : results.runs) {
    if (!run.regime) continue;
    const RegimeRow& regime = *run.regime;
    table += row(run.engine, fmt::format("{}", run.packing),
                 std::string(regime.regime ? toString(*regime.regime) : ""), regime.wheelContacts,
                 regime.wheelSlip, regime.shearShare, regime.inertialNumber, regime.blockedFraction,
                 when.fromRotation, when.toRotation, when.preparedRotations, regime.reason);
  }
  return table;
}

std::string steadinessCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,"
      "prepared_rotations\n";
  for (const FlowRun& run : results.runs)
    for (const SeriesDrift& drift : run.steadiness)
      table += steadinessRow(drift, run.engine, fmt::format("{}", run.packing), results.averaging);
  for (const EngineDrift& drift : results.steadiness)
    table += steadinessRow(drift, drift.engine, "all", results.averaging);
  return table;
}

/// Empty of what no test was made of: a closed form, or no value.
std::string basisOf(const EndpointRow& row) {
  if (row.kind == PairKind::closedForm || row.packings == 0) return {};
  return std::string(nameOf(row.unpaired ? row.unpaired->basis : Basis::paired, basisNames));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> averageTables(const CompareResults& results) {
  return {{"profiles.csv", profilesCsv(results)},
          {"series.csv", seriesCsv(results)},
          {"regimes.csv", regimesCsv(results)},
          {"steadiness.csv", steadinessCsv(results)},
          {"distributions.csv", distributionsCsv(results)}};
}

std::string endpointsCsv(const CompareResults& results) {
  std::string table =
      "a,b,kind,endpoint,unit,margin,answer,difference,low,high,distance,distance_low,distance_"
      "high,look,packings,lost,needs,needs_at_most,carrier_a,carrier_b,bound,regimes_differ,"
      "reference,reason,reach,basis,packings_a,packings_b,reference_half,value,value_half\n";
  for (const EndpointRow& entry : results.endpoints.rows) {
    const auto margin = entry.marginRelative && entry.reference
                            ? std::optional(entry.margin * std::abs(*entry.reference))
                            : std::optional(entry.margin);
    const auto& runs = entry.unpaired;
    table += row(entry.a, entry.b, std::string(nameOf(entry.kind)), entry.endpoint, entry.unit,
                 margin, entry.answer(), entry.difference, entry.low, entry.high, entry.distance,
                 entry.distanceLow, entry.distanceHigh, std::optional<double>(entry.look),
                 static_cast<std::size_t>(entry.packings), static_cast<std::size_t>(entry.lost),
                 std::optional<double>(entry.needs), std::optional<double>(entry.needsAtMost),
                 entry.surrogateA, entry.surrogateB, entry.bound,
                 regimesDiffer(results.regimes, entry.a, entry.b), entry.reference, entry.reason,
                 entry.reach, basisOf(entry), runs ? std::optional<double>(runs->a) : std::nullopt,
                 runs ? std::optional<double>(runs->b) : std::nullopt, entry.referenceHalf,
                 entry.value(), entry.valueHalf);
  }
  return table;
}

std::string agreementCsv(const CompareResults& results) {
  std::string table =
      "a,b,field,ring,difference,stderr,low,high,margin,place,detects,within_share,packings,"
      "regimes_differ\n";
  for (const AgreementRow& entry : results.agreement) {
    const auto differ = regimesDiffer(results.regimes, entry.a, entry.b);
    for (const AgreementRing& ring : entry.rings)
      table += row(entry.a, entry.b, entry.field, ring.ring + 1, ring.difference,
                   ring.standardError, ring.low, ring.high, ring.margin, placeOf(ring.verdict),
                   ring.detects, ring.withinFraction, std::optional<double>(ring.packings), differ);
  }
  return table;
}

}  // namespace crossgrain::reports
