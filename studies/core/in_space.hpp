#pragma once

#include <memory>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// How far a sphere may leave the plane of its scene [radius of the smallest]: distances between
/// spheres are off by half its square then.
inline constexpr double leavesPlane = 1e-3;

/// The disks as spheres, J = 2/5 m a²: what an engine in space has.
Scene ofSpheres(Scene scene);

/// How a plane lies in space.
enum class PlaneFrame {
  any,  ///< along no axis; that of y and z where a scene has a box, or planes and the engine has
        ///< planes along axes alone
  flat  ///< that of x and y: what is 0 along z stays so to the bit
};

/// Runs scenes of the plane in a plane of space, where every equation is the plane's
/// (docs/dimensions.md, section 4). Snapshots are those of the plane again. Of what is declared the
/// bottom plate, the energy ledger and what a spring does in space have no meaning there.
///
/// Rounding moves spheres off their plane, and the growth of that is no fault of the engine:
/// snapshot() throws UnsupportedScene once one has left it.
/// @param engine  has scenes in space
std::unique_ptr<Engine> runInSpace(std::unique_ptr<Engine> engine,
                                   PlaneFrame frame = PlaneFrame::any);

}  // namespace crossgrain::inline studies
