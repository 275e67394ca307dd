#pragma once

#include <nlohmann/json.hpp>

#include "adapters/engine.hpp"
#include "adapters/worker/arrays.hpp"

/// What the worker protocol says of each shared type. Names and values are those of the case files;
/// numbers are printed so that they read back to the same bits. Reading throws std::exception with
/// one line on whatever is missing or malformed. README.md of this folder is the reference.

namespace crossgrain {

/// Lists go to the array writer; the JSON holds the rest.
nlohmann::json toJson(const Scene& scene, ArrayWriter& arrays);
Scene sceneFromJson(const nlohmann::json& json, const ArrayReader& arrays);

nlohmann::json toJson(const Snapshot& snapshot, ArrayWriter& arrays);

/// Also checks the lists' lengths and the contacts' ids against the scene that was loaded.
Snapshot snapshotFromJson(const nlohmann::json& json, const ArrayReader& arrays,
                          const Scene& scene);

nlohmann::json toJson(const Capabilities& capabilities);
Capabilities capabilitiesFromJson(const nlohmann::json& json);

nlohmann::json toJson(const Settings& settings);
Settings settingsFromJson(const nlohmann::json& json);

nlohmann::json toJson(const Realised& realised);
Realised realisedFromJson(const nlohmann::json& json);

nlohmann::json toJson(const Stats& stats);
Stats statsFromJson(const nlohmann::json& json);

nlohmann::json toJson(ContactReport report);
ContactReport contactReportFromJson(const nlohmann::json& json);

}  // namespace crossgrain
