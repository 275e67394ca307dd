#include "runs/cost/point.hpp"

#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// What was not measured is 0 in a point and null in its entry.
template <class Number>
json unlessZero(Number value) {
  return value > Number{} ? json(value) : json(nullptr);
}

template <class Number>
Number orZero(const json& value) {
  return value.is_null() ? Number{} : value.get<Number>();
}

}  // namespace

json toJson(const CostPoint& point) {
  return {{"engine", point.engine},
          {"knob", point.knob},
          {"setting", point.setting},
          {"fragment", point.fragment},
          {"error_kind", point.errorKind},
          {"measure", point.measure},
          {"dt_s", unlessZero(point.dt)},
          {"steps_per_contact", toJson(point.stepsPerContact)},
          {"error", toJson(point.error)},
          {"statistical", toJson(point.statistical)},
          {"systematic", toJson(point.systematic)},
          {"reference_error", toJson(point.referenceError)},
          {"wall_s", toJson(point.wallSeconds)},
          {"cpu_s", toJson(point.cpuSeconds)},
          {"steps", unlessZero(point.steps)},
          {"contact_evaluations", unlessZero(point.contactEvaluations)},
          {"status", point.status},
          {"reason", point.reason}};
}

CostPoint costPointFromJson(const json& entry) {
  return {.engine = entry.at("engine"),
          .knob = entry.at("knob"),
          .setting = entry.at("setting"),
          .fragment = entry.at("fragment"),
          .errorKind = entry.at("error_kind"),
          .measure = entry.at("measure"),
          .dt = orZero<double>(entry.at("dt_s")),
          .stepsPerContact = optionalNumber(entry.at("steps_per_contact")),
          .error = optionalNumber(entry.at("error")),
          .statistical = optionalNumber(entry.at("statistical")),
          .systematic = optionalNumber(entry.at("systematic")),
          .referenceError = optionalNumber(entry.at("reference_error")),
          .wallSeconds = optionalNumber(entry.at("wall_s")),
          .cpuSeconds = optionalNumber(entry.at("cpu_s")),
          .steps = orZero<std::uint64_t>(entry.at("steps")),
          .contactEvaluations = orZero<std::uint64_t>(entry.at("contact_evaluations")),
          .status = entry.at("status"),
          .reason = entry.at("reason")};
}

}  // namespace crossgrain::inline runs
