#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// A scene beside itself: all of its bodies `copies` times, at multiples of one length along
/// periodic directions, whose box grows with them, else along directions that no gravity and no
/// wall lies across. Copies along a periodic direction are in the state of the scene itself to the
/// bit; those along another one stand a diameter of the largest body apart. Directions are chosen
/// so that the whole stays as compact as its number of copies allows.
/// @throws UnsupportedScene that names what stands in the way of every direction
template <int D>
SceneOf<D> besideItself(const SceneOf<D>& scene, std::size_t copies);

/// A case's flow with about `bodies` moving bodies, at least its own: a cell blown up
/// (scaled_cell.hpp), any other scene beside itself.
/// @param state  of the flow, which copies begin from
/// @param folder, progress  as of scaledPacking()
/// @throws UnsupportedScene with the reason of a scene that cannot be made larger
template <int D>
SceneOf<D> largerFlow(const Case& setup, const Packing& state, double dt, std::size_t bodies,
                      const std::filesystem::path& folder,
                      const std::function<void(double)>& progress);

}  // namespace crossgrain::inline cases
