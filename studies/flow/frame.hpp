#pragma once

#include <span>
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

/// Description of a case in all results.
/// @param radii  of one packing's disks
FlowFrame flowFrame(std::string_view kind, const Case& setup, const std::string& command,
                    std::span<const double> radii);

template <int D>
FlowFrame flowFrame(std::string_view kind, const Case& setup, const std::string& command,
                    const DisksOf<D>& disks) {
  return flowFrame(kind, setup, command, disks.radius);
}

}  // namespace crossgrain::inline studies
