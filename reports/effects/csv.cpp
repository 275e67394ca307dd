#include <cmath>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/effects/report.hpp"

namespace crossgrain::reports {

namespace {

std::string yesOrNo(const std::optional<bool>& value) {
  return value ? (*value ? "yes" : "no") : "";
}

}  // namespace

std::string effectsCsv(const EffectsResults& results) {
  std::string table =
      "engine,effect,time_ratio,field,ring,change,stderr,r_tilde,reference,unit,resolved,"
      "p_adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,step_s,"
      "contacts_per_step,precision,status,reason\n";
  const double level = std::round((1.0 - results.averaging.confidence) * 1e12) / 1e12;
  for (const EffectVariant& variant : results.variants) {
    if (!variant.isSwitched()) continue;  // everything on: what the others are held against
    const bool refused = variant.status == EngineStatus::refused;
    const auto packings =
        refused ? std::nullopt : std::optional(static_cast<double>(variant.changes.packings));
    const std::string bars(refused ? "" : nameOf(variant.changes.bars));
    const auto line = [&](const ChangedField& field, const std::string& place,
                          const RingChange& ring) {
      const auto rTilde = place.empty() ? std::nullopt : at(results.rings.rTilde, ring.ring);
      table +=
          row(variant.engine, variant.effect, variant.timeRatio, field.field, place, ring.change,
              ring.standardError, rTilde, ring.reference, field.unit, yesOrNo(ring.resolved),
              ring.p, ring.smallest, finite(ring.p) ? std::optional(level) : std::nullopt, packings,
              bars, variant.timeRatioError, variant.step, variant.contacts,
              variant.precision.value_or(""), std::string(nameOf(variant.status)), variant.reason);
    };
    for (const ChangedField& field : variant.changes.fields)
      for (const RingChange& ring : field.rings)
        line(field, fmt::format("{}", ring.ring + 1), ring);
    if (variant.changes.fields.empty()) line({}, "", {});
  }
  return table;
}

}  // namespace crossgrain::reports
