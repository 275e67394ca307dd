#include "tests/conformance/expected_skips.hpp"

#include <array>

namespace crossgrain::test {

std::span<const ExpectedSkip> expectedSkips() {
  static constexpr std::array table = {
      ExpectedSkip{"yade", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"lammps", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"lammps", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
      ExpectedSkip{"lammps", "ShrinkingWallStops", "oscillating, not radial as wall is"},
      ExpectedSkip{"grain-as-lammps", "FollowsItsPeerByHertzLaw",
                   "its peer has another normal law"},
      ExpectedSkip{"box2d-impulse", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"box2d-impulse", "ShrinkingWallPushes", "has rigid walls only"},
      ExpectedSkip{"box2d-impulse", "ShrinkingWallStops", "has rigid walls only"},
      ExpectedSkip{"box2d-impulse", "SlidingFlagsMarkTheBound", "has no sliding flags"},
      ExpectedSkip{"box2d-penalty", "ShrinkingWallPushes", "has rigid walls only"},
      ExpectedSkip{"box2d-penalty", "ShrinkingWallStops", "has rigid walls only"},
      ExpectedSkip{"grain-stiff", "FollowsItsPeerThroughACollision",
                   "its peer has another normal law"},
      ExpectedSkip{"grain-stiff", "FollowsItsPeerThroughAHeap", "its peer has another normal law"},
      ExpectedSkip{"grain-stiff", "FollowsItsPeerOnAPlane", "its peer has another normal law"},
      ExpectedSkip{"grain-stiff", "FollowsItsPeerByHertzLaw", "its peer has another normal law"},
      ExpectedSkip{"grain-as-box2d-penalty", "FollowsItsPeerByHertzLaw",
                   "its peer has another normal law"},
      ExpectedSkip{"grain-as-box2d-impulse", "FollowsItsPeerByHertzLaw",
                   "its peer has another normal law"},
      ExpectedSkip{"grain-as-box2d-impulse", "FollowsItsPeerThroughAHeap",
                   "lets contacts collide one by one"},
  };
  return table;
}

}  // namespace crossgrain::test
