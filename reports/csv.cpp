#include "reports/common/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "reports/common/csv_row.hpp"

namespace crossgrain::reports {

namespace {

/// The index that a run's packing has in the results, as text.
std::string packingOf(const Json& run) {
  const Json& packing = member(run, "packing");
  return packing.is_number_integer() ? packing.dump() : std::string();
}

/// @param bars  what the standard errors are of
std::string profileRows(const Json& results, const std::string& engine, const std::string& packing,
                        const std::string& bars, const Json& profiles) {
  const Json &rings = member(results, "rings"), &averaging = member(results, "averaging");
  const Json& radius = list(rings, "r");
  std::string rows;
  for (const Json& profile : profiles)
    for (std::size_t ring = 0; ring < radius.size(); ++ring)
      rows += row(engine, packing, text(profile, "method"), text(profile, "field"), ring + 1,
                  number(radius[ring]), number(element(list(rings, "r_tilde"), ring)),
                  number(element(list(profile, "mean"), ring)),
                  number(element(list(profile, "stderr"), ring)),
                  number(element(list(profile, "n_eff"), ring)), text(profile, "unit"), bars,
                  number(element(list(profile, "dof"), ring)), number(averaging, "from_rotation"),
                  number(averaging, "to_rotation"), number(averaging, "prepared_rotations"));
  return rows;
}

std::vector<std::string> seriesColumns(const Json& results) {
  std::vector<std::string> columns = {"wheel_torque", "outer_pressure", "kinetic_energy",
                                      "coordination", "max_overlap",    "sliding_fraction"};
  std::set<std::string> further, ledger;
  for (const Json& run : list(results, "runs"))
    for (const auto& [name, values] : member(run, "series").items())
      if (values.is_array() && name != "t_s" && std::ranges::find(columns, name) == columns.end())
        (name.starts_with("energy_") ? ledger : further).insert(name);
  columns.insert(columns.end(), further.begin(), further.end());
  columns.insert(columns.end(), ledger.begin(), ledger.end());
  return columns;
}

}  // namespace

std::string profilesCsv(const Json& results) {
  std::string table =
      "engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,"
      "from_rotation,to_rotation,prepared_rotations\n";
  for (const Json& run : list(results, "runs"))
    table += profileRows(results, text(run, "engine"), packingOf(run), "within_run",
                         list(run, "profiles"));
  for (const Json& ensemble : list(results, "ensemble"))
    table += profileRows(results, text(ensemble, "engine"), "all", "packings",
                         list(ensemble, "profiles"));
  return table;
}

namespace {

std::string distributionRows(const std::string& engine, const std::string& packing,
                             const std::string& bars, const Json& distributions) {
  std::string rows;
  for (const Json& distribution : distributions) {
    const std::string quantity = text(distribution, "quantity");
    const auto ring = number(distribution, "ring");
    const std::string place = ring ? fmt::format("{:.0f}", *ring + 1.0) : "all";
    const Json& axes = list(distribution, "axes");
    const auto edge = [&](std::size_t axis, std::size_t index) -> std::optional<double> {
      const auto low = number(element(axes, axis), "low");
      if (!low) return std::nullopt;
      return *low + static_cast<double>(index) * *number(axes[axis], "width");
    };
    const auto across = static_cast<std::size_t>(number(element(axes, 0), "count").value_or(1.0));
    const Json& density = list(distribution, "density");
    for (std::size_t k = 0; k < density.size(); ++k) {
      const auto value = number(density[k]);
      if (!value || *value == 0.0) continue;
      const std::size_t column = k % across, line = k / across;
      rows += row(engine, packing, quantity, place, edge(0, column), edge(0, column + 1), value,
                  number(element(list(distribution, "stderr"), k)), edge(1, line),
                  edge(1, line + 1), bars);
    }
    if (const auto outside = number(distribution, "outside"); outside && *outside > 0.0) {
      const std::optional<double> absent;
      rows += row(engine, packing, quantity, place, absent, absent, outside, absent, absent, absent,
                  bars);
    }
  }
  return rows;
}

}  // namespace

std::string distributionsCsv(const Json& results) {
  std::string table =
      "engine,packing,quantity,ring,low,high,density,stderr,low_2,high_2,stderr_kind\n";
  for (const Json& run : list(results, "runs"))
    table += distributionRows(text(run, "engine"), packingOf(run), "within_run",
                              list(run, "distributions"));
  for (const Json& ensemble : list(results, "ensemble"))
    table += distributionRows(text(ensemble, "engine"), "all", "packings",
                              list(ensemble, "distributions"));
  return table;
}

std::string seriesCsv(const Json& results) {
  const std::vector<std::string> columns = seriesColumns(results);
  std::string table = "engine,packing,t_s";
  for (const std::string& column : columns) table += "," + cell(column);
  table += "\n";
  for (const Json& run : list(results, "runs")) {
    const Json& series = member(run, "series");
    for (std::size_t k = 0; k < list(series, "t_s").size(); ++k) {
      table += cell(text(run, "engine")) + "," + packingOf(run) + "," +
               cell(number(list(series, "t_s")[k]));
      for (const std::string& column : columns)
        table += "," + cell(number(element(list(series, column), k)));
      table += "\n";
    }
  }
  return table;
}

namespace {

/// On how many packings; absent where nobody knows.
std::optional<double> regimesDiffer(const Json& results, const std::string& a,
                                    const std::string& b) {
  for (const Json& pair : list(results, "regimes"))
    if (text(pair, "a") == a && text(pair, "b") == b)
      return static_cast<double>(list(pair, "differ").size());
  return std::nullopt;
}

}  // namespace

std::string agreementCsv(const Json& results) {
  std::string table =
      "a,b,field,ring,difference,stderr,low,high,margin,verdict,detects,within_share,packings,"
      "more_packings,more_rotations,regimes_differ\n";
  const std::optional<double> absent;
  for (const Json& entry : list(results, "agreement")) {
    const std::string a = text(entry, "a"), b = text(entry, "b"), field = text(entry, "field");
    const auto differ = regimesDiffer(results, a, b);
    table += row(a, b, field, std::string("all"), absent, absent, absent, absent, absent,
                 text(entry, "verdict"), number(entry, "detects"), absent, absent,
                 number(entry, "more_packings"), number(entry, "more_rotations"), differ);
    for (const Json& ring : list(entry, "rings")) {
      const auto index = number(ring, "ring");
      if (!index) continue;
      table += row(a, b, field, static_cast<std::size_t>(*index) + 1, number(ring, "difference"),
                   number(ring, "stderr"), number(ring, "low"), number(ring, "high"),
                   number(ring, "margin"), text(ring, "verdict"), number(ring, "detects"),
                   number(ring, "within_share"), number(ring, "packings"), absent, absent, differ);
    }
  }
  return table;
}

namespace {

std::string yesOrNo(const Json& value) {
  return value.is_boolean() ? (value.get<bool>() ? "yes" : "no") : "";
}

}  // namespace

std::string effectsCsv(const Json& results) {
  std::string table =
      "engine,effect,time_ratio,field,ring,change,stderr,r_tilde,reference,unit,resolved,"
      "p_adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,step_s,"
      "contacts_per_step,precision,status,reason\n";
  const auto confidence = number(member(results, "averaging"), "confidence");
  const auto level =
      confidence ? std::optional(std::round((1.0 - *confidence) * 1e12) / 1e12) : std::nullopt;
  const Json& radii = list(member(results, "rings"), "r_tilde");
  for (const Json& leg : list(results, "legs")) {
    const std::string engine = text(leg, "engine"), effect = text(leg, "effect");
    if (effect.empty()) continue;  // everything on: what the others are held against
    const auto line = [&](const Json& field, const Json& ring) {
      const auto index = number(ring, "ring");
      const std::string place = index ? fmt::format("{:.0f}", *index + 1.0) : "";
      const auto rTilde =
          index ? number(element(radii, static_cast<std::size_t>(*index))) : std::nullopt;
      const bool judged = number(ring, "p").has_value();
      table +=
          row(engine, effect, number(leg, "time_ratio"), text(field, "field"), place,
              number(ring, "change"), number(ring, "stderr"), rTilde, number(ring, "reference"),
              text(field, "unit"), yesOrNo(member(ring, "resolved")), number(ring, "p"),
              number(ring, "smallest"), judged ? level : std::nullopt, number(leg, "packings"),
              text(leg, "stderr_kind"), number(leg, "time_ratio_stderr"), number(leg, "step_s"),
              number(leg, "contacts_per_step"), text(leg, "precision"), text(leg, "status"),
              text(leg, "reason"));
    };
    for (const Json& field : list(leg, "fields"))
      for (const Json& ring : list(field, "rings")) line(field, ring);
    if (list(leg, "fields").empty()) line({}, {});
  }
  return table;
}

std::string revCsv(const Json& results) {
  std::string table = "engine,method,field,r_m,width_over_d,mean,stderr,unit\n";
  const std::string engine = text(results, "engine");
  for (const Json& curve : list(results, "curves"))
    for (std::size_t k = 0; k < list(curve, "width").size(); ++k)
      table += row(engine, text(curve, "method"), text(curve, "field"), number(curve, "r"),
                   number(list(curve, "width")[k]), number(element(list(curve, "mean"), k)),
                   number(element(list(curve, "stderr"), k)), text(curve, "unit"));
  return table;
}

std::string revMeetingsCsv(const Json& results) {
  std::string table = "method,field,near_d,width_over_d,difference\n";
  for (const Json& meeting : list(results, "meetings"))
    table += row(text(meeting, "method"), text(meeting, "field"), number(meeting, "near"),
                 number(meeting, "width"), number(meeting, "difference"));
  return table;
}

}  // namespace crossgrain::reports
