#pragma once

#include "adapters/worker/json.hpp"
#include "results/engine_row.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, EngineRow& row) {
  io("name", row.name, aName);
  io("summary", row.summary);
  io("version", row.version);
  io("mirrors", row.mirrors, aName);
  io("status", row.status);
  io("reason", row.reason);
}

void fields(auto& io, Stats& stats) {
  io("steps", stats.steps);
  io("contact_evaluations", stats.contactEvaluations);
  io("wall_s", stats.wallSeconds);
  io("cpu_s", stats.cpuSeconds);
  io("counters", stats.counters);
}

/// What the worker protocol says of a type, its errors as those of a file.
template <typename T>
T readAsProtocol(const Json& json, T (*read)(const Json&)) {
  try {
    return read(json);
  } catch (const std::exception& error) {
    throw FieldError(": " + asOneLine(withoutPrefix(error.what()), 200));
  }
}

template <>
inline Json jsonOf(const Realised& realised) {
  return crossgrain::toJson(realised);
}
template <>
inline void readFrom(const Json& json, Realised& realised) {
  realised = readAsProtocol(json, realisedFromJson);
}

template <>
inline Json jsonOf(const Capabilities& capabilities) {
  return crossgrain::toJson(capabilities);
}
template <>
inline void readFrom(const Json& json, Capabilities& capabilities) {
  capabilities = readAsProtocol(json, capabilitiesFromJson);
}

}  // namespace crossgrain::inline results
