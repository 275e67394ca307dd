#include "reports/common/csv.hpp"
#include "reports/common/csv_row.hpp"

namespace crossgrain::reports {

namespace {

/// Which rotations were averaged, in every run.
struct Averaged {
  std::optional<double> from, to, prepared;
};

Averaged averagedOf(const Json& results) {
  const Json& averaging = member(results, "averaging");
  return {number(averaging, "from_rotation"), number(averaging, "to_rotation"),
          number(averaging, "prepared_rotations")};
}

std::string packingOf(const Json& run) {
  const Json& packing = member(run, "packing");
  return packing.is_number_integer() ? packing.dump() : std::string();
}

std::string steadinessRow(const Json& entry, const std::string& engine, const std::string& packing,
                          const Averaged& when) {
  return row(engine, packing, text(entry, "quantity"), text(entry, "verdict"),
             number(entry, "change"), number(entry, "half_width"), number(entry, "excluded"),
             when.from, when.to, when.prepared);
}

}  // namespace

std::string regimesCsv(const Json& results) {
  std::string table =
      "engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,"
      "from_rotation,to_rotation,prepared_rotations,reason\n";
  const Averaged when = averagedOf(results);
  for (const Json& run : list(results, "runs")) {
    const Json& regime = member(run, "regime");
    if (!regime.is_object()) continue;
    table += row(text(run, "engine"), packingOf(run), text(regime, "name"),
                 number(regime, "wheel_contacts"), number(regime, "wheel_slip"),
                 number(regime, "shear_share"), number(regime, "inertial_number"),
                 number(regime, "blocked_share"), when.from, when.to, when.prepared,
                 text(regime, "reason"));
  }
  return table;
}

std::string steadinessCsv(const Json& results) {
  std::string table =
      "engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,"
      "prepared_rotations\n";
  const Averaged when = averagedOf(results);
  for (const Json& run : list(results, "runs"))
    for (const Json& entry : list(run, "steadiness"))
      table += steadinessRow(entry, text(run, "engine"), packingOf(run), when);
  for (const Json& entry : list(results, "steadiness"))
    table += steadinessRow(entry, text(entry, "engine"), "all", when);
  return table;
}

}  // namespace crossgrain::reports
