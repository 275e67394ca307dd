#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "studies/core/executor.hpp"

namespace crossgrain::inline studies {

/// Report of `check` on one case, and of each engine on it. A packing file is read and checked.
/// Of a Couette case some steps are timed on every engine, on its first packing where that is in
/// the cache, else on a made-up one (cautions.hpp): nothing of it is kept.
/// @param names  of engines, "all" allowed; mirrors that would run along are asked too
/// @param timed         whether to time steps
/// @param beforeTiming  called with the number of engines, mirrors left out
/// @returns name, variant, kind, disks, wall_disks, dt_s, effects, cautions, engines; of a Couette
///          case also cell figures and predictions (docs/methods.md)
/// @throws BadInput, also for a time step beyond the limit of a case that compare would refuse
nlohmann::json checkedCase(const Case& setup, const std::vector<std::string>& names, bool timed,
                           const std::filesystem::path& scratch, Progress& progress,
                           const std::function<void(std::size_t)>& beforeTiming);

}  // namespace crossgrain::inline studies
