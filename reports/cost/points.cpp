#include "reports/cost/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/effects/variants.hpp"

namespace crossgrain::reports {

namespace {

CostRow rowOf(const Json& point) {
  CostRow row;
  row.engine = text(point, "engine");
  row.knob = text(point, "knob");
  row.setting = text(point, "setting");
  row.fragment = text(point, "fragment");
  row.kind = text(point, "error_kind");
  row.measure = text(point, "measure");
  row.status = text(point, "status");
  row.reason = text(point, "reason");
  row.dt = number(point, "dt_s");
  row.stepsPerContact = number(point, "steps_per_contact");
  row.error = number(point, "error");
  row.statistical = number(point, "statistical");
  row.systematic = number(point, "systematic");
  row.reference = number(point, "reference_error");
  row.wall = number(point, "wall_s");
  row.cpu = number(point, "cpu_s");
  row.steps = number(point, "steps");
  row.contacts = number(point, "contact_evaluations");
  return row;
}

template <class Value>
void addOnce(std::vector<Value>& values, const Value& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

struct MeasureName {
  std::string_view name, words, html, enhanced;
};

constexpr std::array measureNames = {
    MeasureName{"psi_f", "Ψ_f", "Ψ<sub>f</sub>", "Ψ_f"},
    MeasureName{"e_n", "e_n", "e<sub>n</sub>", "e_n"},
    MeasureName{"azimuthal_velocity", "azimuthal velocity", "azimuthal velocity v<sub>φ</sub>",
                "azimuthal velocity v_φ"},
    MeasureName{"volume_fraction", "volume fraction", "volume fraction ν", "volume fraction ν"},
    MeasureName{"stress_rr", "radial stress", "radial stress σ<sub>rr</sub>",
                "radial stress σ_{rr}"},
};

const MeasureName* nameOf(const std::string& measure) {
  const auto found = std::ranges::find(measureNames, measure, &MeasureName::name);
  return found == measureNames.end() ? nullptr : &*found;
}

/// Whose reference positions are held against; empty of other measures.
std::string againstWhom(const std::string& measure) {
  constexpr std::string_view positions = "position_rms_";
  if (!measure.starts_with(positions)) return {};
  const std::string whom = measure.substr(positions.size());
  return whom == "own" ? "itself" : whom;
}

/// What all three ways of telling an unknown measure share.
std::string plainWords(const std::string& measure) {
  const std::string whom = againstWhom(measure);
  return whom.empty() ? spaced(measure) : "positions, against " + spaced(whom);
}

}  // namespace

MeasuredError CostRow::measured() const {
  return {error.value_or(0.0), statistical, reference, kindScatters(kind)};
}

bool CostRow::mayBeChance() const {
  return error && measured().mayBeChance();
}

std::optional<double> CostRow::counted() const {
  return ran() && error ? measured().counted() : std::nullopt;
}

std::optional<std::string> CostRow::scheme() const {
  if (knob == "time_step") return std::string();
  const auto comma = setting.find(',');
  if (knob != "integrator" || comma == std::string::npos) return std::nullopt;
  return setting.substr(0, comma);
}

const CostRow* rowAt(const std::vector<CostRow>& rows, const Json& place) {
  const auto index = number(place);
  return index && *index >= 0.0 && *index < static_cast<double>(rows.size())
             ? &rows[static_cast<std::size_t>(*index)]
             : nullptr;
}

std::vector<CostRow> costRows(const Json& results) {
  std::vector<CostRow> rows;
  for (const Json& point : list(results, "points")) rows.push_back(rowOf(point));
  for (const Json& front : list(results, "fronts")) {
    if (!text(front, "engine").empty()) continue;
    for (const Json& place : list(front, "points"))
      if (const CostRow* row = rowAt(rows, place))
        rows[static_cast<std::size_t>(row - rows.data())].onFront = true;
  }
  return rows;
}

std::vector<std::string> costKinds(const std::vector<CostRow>& rows) {
  std::vector<std::string> kinds;
  for (const CostRow& row : rows) addOnce(kinds, row.kind);
  return kinds;
}

std::vector<CostMeasure> costMeasures(const std::vector<CostRow>& rows) {
  std::vector<CostMeasure> measures;
  for (const std::string& kind : costKinds(rows))
    for (const CostRow& row : rows)
      if (row.kind == kind) addOnce(measures, CostMeasure{kind, row.measure});
  return measures;
}

std::vector<EngineResults> costEngines(const Json& results) {
  std::vector<EngineResults> engines = engineResults(results);
  std::erase_if(engines, [&](const EngineResults& engine) {
    return findByText(results, "points", "engine", engine.name).is_null();
  });
  return engines;
}

std::vector<OtherSetting> otherSettings(const std::vector<CostRow>& rows) {
  std::vector<OtherSetting> settings;
  for (const CostRow& row : rows)
    if (row.counted() && !row.scheme()) addOnce(settings, {row.knob, row.setting});
  return settings;
}

std::string settingWords(const OtherSetting& setting) {
  constexpr std::string_view effect = "effect:";
  const auto& [knob, value] = setting;
  if (knob == "time_step" || knob == "integrator") return value;
  if (knob.starts_with(effect)) return effectLabel(knob.substr(effect.size())) + " " + value;
  return value.starts_with(knob) ? spaced(knob) + value.substr(knob.size())
                                 : spaced(knob) + " " + value;
}

const CostRow* baseOf(const std::vector<CostRow>& rows, const CostRow& row) {
  const auto near = [](const std::optional<double>& a, const std::optional<double>& b) {
    constexpr double rounding = 1e-6;
    return a && b && std::abs(*a - *b) <= rounding * std::abs(*b);
  };
  const CostRow* sameStep = nullptr;
  for (const CostRow& base : rows) {
    if (base.knob != "time_step" || base.engine != row.engine || base.kind != row.kind ||
        base.measure != row.measure)
      continue;
    if (near(base.stepsPerContact, row.stepsPerContact)) return &base;
    if (!sameStep && near(base.dt, row.dt)) sameStep = &base;
  }
  return sameStep;
}

std::string measureHtml(const std::string& measure) {
  const MeasureName* name = nameOf(measure);
  if (name) return std::string(name->html);
  return againstWhom(measure).empty() ? fieldLabel(measure) : mathHtml(plainWords(measure));
}

std::string measureEnhanced(const std::string& measure) {
  const MeasureName* name = nameOf(measure);
  return name ? std::string(name->enhanced) : plainWords(measure);
}

std::string measureWords(const std::string& measure) {
  const MeasureName* name = nameOf(measure);
  return name ? std::string(name->words) : plainWords(measure);
}

std::string timeUnit(const std::string& kind) {
  if (kind == "collision") return "one sweep of collisions";
  if (kind == "trajectory") return "the window";
  if (kind == "averages") return "one rotation";
  return "one run";
}

std::string shareText(std::optional<double> share) {
  if (!share) return absentText;
  if (*share == 0.0) return "0";
  constexpr double least = 1e-5;  // as a percentage
  if (*share < least) return readableSetting(std::stod(fmt::format("{:.1e}", *share)));
  const double percent = 100.0 * *share;
  return (percent < 99.5 ? fmt::format("{:.2g}", percent) : readable(percent)) + " %";
}

std::string wantText(double want) {
  if (want >= 1e-4) return fmt::format("{:g} %", 100.0 * want);
  const std::string power = readableSetting(want);
  return power.starts_with("1×") ? power.substr(std::string("1×").size()) : power;
}

}  // namespace crossgrain::reports
