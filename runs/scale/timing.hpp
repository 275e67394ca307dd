#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "adapters/scene.hpp"
#include "cases/case.hpp"
#include "results/scale.hpp"

namespace crossgrain::inline runs {

/// One repetition of a point's steps in a fresh process: its seconds, contacts, memory and what the
/// engine is are put down in `point`.
/// @param sharing  the setting that says how many workers share a step; empty: it has none
/// @param scratch  the engine's own folder
/// @throws UnsupportedScene, EngineFailure, Interrupted
void timeSteps(ScalePoint& point, const EngineEntry& engine, const std::string& sharing,
               Case scaled, const Scene& scene, const std::filesystem::path& scratch);

/// Why points[k] would not fit into memory; nothing where it does, or where that cannot be told. By
/// the largest cell before it that its engine ran with as many workers, else with one.
std::optional<std::string> lackOfMemory(const std::vector<ScalePoint>& points, std::size_t k);

}  // namespace crossgrain::inline runs
