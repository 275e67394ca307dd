#pragma once

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::inline runs {

/// What the report's two pictures need of one snapshot: disks with the place they started from
/// (scene) and contacts with their normal force. @param rotation  of the wheel so far
ScenePicture scenePicture(const Scene& scene, const Snapshot& now, double rotation);

}  // namespace crossgrain::inline runs
