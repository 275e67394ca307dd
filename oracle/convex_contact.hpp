#pragma once

#include "adapters/scene.hpp"
#include "oracle/collision_end.hpp"
#include "oracle/convex_impact.hpp"

namespace crossgrain::inline oracle {

/// The point of a body that is farthest along a direction.
template <int D>
struct CornerOf {
  VecOf<D> arm;  ///< from the centre of mass, laboratory frame [m]
  double next;   ///< how much less far the next corner or end is, 0 of a face or an edge [m]
};
template <int D>
CornerOf<D> cornerTowards(const ShapeOf<D>& shape, const TurnOf<D>& turn,
                          const VecOf<D>& direction);

/// A body as it is in a scene, about to be hit at the end of an arm.
template <int D>
ConvexImpactBody<D> impactBody(const DisksOf<D>& bodies, std::size_t i, const VecOf<D>& arm);

/// Numbers of a collision of bodies of any shape at one point. e_n and Ψ_f are of that point,
/// where both bodies had it before; centrePsi and ConvexEnd::centreNormal of the centres of mass.
/// @param start  its normal is x, and Ψ is along y
/// @param velocity, spin  after it
template <int D>
CollisionEnd convexEnd(const ConvexImpactStart<D>& start, const std::array<VecOf<D>, 2>& velocity,
                       const std::array<SpinOf<D>, 2>& spin);

}  // namespace crossgrain::inline oracle
