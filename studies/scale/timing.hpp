#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>
#include "adapters/engine_entry.hpp"
#include "adapters/scene.hpp"
#include "cases/case.hpp"
#include "results/scale.hpp"

namespace crossgrain::inline studies {

/// What `scale` is asked for.
struct ScalePlan {
  std::vector<std::size_t> disks;      ///< sizes of the cell
  std::vector<int> workers;            ///< threads or ranks
  std::optional<std::uint64_t> steps;  ///< timed in each repetition; absent: stepsFor()
  int repetitions = 3;
};

/// One engine on one size with so many workers.
struct PlannedTiming {
  std::size_t disks = 0;
  std::size_t engine = 0;  ///< its place
  int workers = 1;
  bool operator==(const PlannedTiming&) const = default;
};

/// Strong scaling: every size with every number of workers, one always among them. Weak scaling:
/// from each size n that is asked for, p·n disks on p workers, where that is no more than the
/// largest size asked for. An engine without workers has one.
/// @param shares  whether an engine's step can be shared
/// @returns by size, engine and workers, each once
std::vector<PlannedTiming> plannedPoints(const ScalePlan& plan, const std::vector<bool>& shares);

/// So many that a run of some 2·10⁷ disk steps is timed, and never fewer than 50.
std::uint64_t stepsFor(std::size_t disks);

/// Before the timed ones: a tenth as many, at least 5.
std::uint64_t warmUpSteps(std::uint64_t timed);

/// Memory that so many disks would take, by what fewer of them took [bytes].
double expectedMemory(std::size_t disks, std::size_t fewer, double taken);

/// 1, 2, 4, … up to the cores, and their number itself.
std::vector<int> usualWorkers(unsigned cores);

/// "1000,10000": whole numbers between the two, each once.
/// @param option  the name that an error begins with
/// @throws BadInput
std::vector<std::size_t> wholeNumbers(const std::string& option, const std::string& list,
                                      std::size_t least, std::size_t most);

/// One repetition of a point's steps in a fresh process: its seconds, contacts, memory and what the
/// engine is are put down in `point`.
/// @param sharing  the setting that says how many workers share a step; empty: it has none
/// @param scratch  the engine's own folder
/// @throws UnsupportedScene, EngineFailure, Interrupted
void timeSteps(ScalePoint& point, const EngineEntry& engine, const std::string& sharing,
               Case scaled, const Scene& scene, const std::filesystem::path& scratch);

/// Why points[k] would not fit into memory; nothing where it does, or where that is not known. By
/// the largest cell before it that its engine ran with as many workers, else with one.
std::optional<std::string> lackOfMemory(const std::vector<ScalePoint>& points, std::size_t k);

}  // namespace crossgrain::inline studies
