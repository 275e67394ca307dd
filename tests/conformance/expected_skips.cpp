#include "tests/conformance/expected_skips.hpp"

#include <array>

namespace crossgrain::test {

std::span<const ExpectedSkip> expectedSkips() {
  static constexpr std::array table = {
      ExpectedSkip{"yade", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"yade", "SlantingPlaneDoesNotYield", "has planes along an axis only"},
      ExpectedSkip{"yade", "TurningPlanePushes", "oscillating, not rotating as those of plane are"},
      ExpectedSkip{"lammps", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"lammps", "SlantingPlaneDoesNotYield", "has planes along an axis only"},
      ExpectedSkip{"lammps", "TurningPlanePushes", "fixed, not rotating as those of plane are"},
      ExpectedSkip{"lammps", "PlaneComesFromAfar", "fixed, not translating as those of plane are"},
      ExpectedSkip{"lammps", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
      ExpectedSkip{"lammps", "ShrinkingWallStops", "oscillating, not radial as wall is"},
      ExpectedSkip{"grain-as-lammps", "FollowsItsPeerByHertzLaw",
                   "between disks alone, not at planes"},
      ExpectedSkip{"box2d-impulse", "BottomPlateBrakesADisk", "has no bottom_friction"},
      ExpectedSkip{"box2d-impulse", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
      ExpectedSkip{"box2d-impulse", "ShrinkingWallStops", "oscillating, not radial as wall is"},
      ExpectedSkip{"box2d-impulse", "SlidingFlagsMarkTheBound", "has no sliding flags"},
      ExpectedSkip{"box2d-impulse", "SpringsHoldWhileAnotherFalls", "has no linear law"},
      ExpectedSkip{"grain-as-box2d-impulse", "SpringsHoldWhileAnotherFalls", "has no linear law"},
      ExpectedSkip{"box2d-penalty", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
      ExpectedSkip{"box2d-penalty", "ShrinkingWallStops", "oscillating, not radial as wall is"},
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
      ExpectedSkip{"grain", "ConventionsAreThoseDeclared", "is the in-house engine"},
      ExpectedSkip{"grain-as-yade", "ConventionsAreThoseDeclared", "is the in-house engine"},
      ExpectedSkip{"grain-as-lammps", "ConventionsAreThoseDeclared", "is the in-house engine"},
      ExpectedSkip{"grain-as-box2d-penalty", "ConventionsAreThoseDeclared",
                   "is the in-house engine"},
      ExpectedSkip{"grain-as-box2d-impulse", "ConventionsAreThoseDeclared",
                   "is the in-house engine"},
      ExpectedSkip{"grain-stiff", "ConventionsAreThoseDeclared", "is the in-house engine"},
      ExpectedSkip{"box2d-impulse", "ConventionsAreThoseDeclared", "no convention of a soft law"},
  };
  return table;
}

}  // namespace crossgrain::test
