#pragma once

#include <string>
#include <string_view>

#include "adapters/scene.hpp"
#include "averaging/rings.hpp"
#include "cases/case.hpp"
#include "results/flow_frame.hpp"

namespace crossgrain::inline studies {

RingPlaces placesOf(const Rings& rings);

/// Of the case's bins: of slabs the coordinate along which they lie, and of a grid none.
RingPlaces placesOf(const Case& setup);

/// What results say of a Couette case whatever is done with it.
/// @param radii  of the disks of one packing [m]
FlowFrame couetteFrame(std::string_view kind, const Case& setup, const std::string& command,
                       const std::vector<double>& radii);

}  // namespace crossgrain::inline studies
