#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "results/head.hpp"
#include "results/scene_picture.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// Now, as ISO 8601 in UTC.
std::string timeStamp();

/// What all results begin with.
ResultsHead headOf(std::string_view kind, const Case& setup, const std::string& command);

/// What the report's two pictures need of one snapshot: disks with the place they started from
/// (scene) and contacts with their normal force. @param rotation  of the wheel so far
ScenePicture scenePicture(const Scene& scene, const Snapshot& now, double rotation);

/// Does the work of a command that takes up what is finished in its folder. Where it cannot go on,
/// since the user interrupted it or the disk is full, what it throws says how to.
/// @returns what the work returns
/// @throws Interrupted, OutputError; what else the work throws
int resumably(const RunCommand& command, const std::function<int()>& work);

}  // namespace crossgrain::inline runs
