#pragma once

#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain {

/// Names of the cell's two bodies.
inline constexpr const char* wheelName = "wheel";
inline constexpr const char* ringName = "ring";

/// The Couette cell filled with a packing: the wheel (turning with Ω about the origin) and the ring
/// (at rest) are rigid bodies of wall disks with centres on R_i and R_o, as many as fit at the
/// spacing wanted. Where the case blocks rotation, the packing's spins are dropped.
Scene couetteScene(const Case& setup, const Packing& packing, double dt);

/// The wall disks of one wall: centres on `radius`, turned by `angle`.
WallBody wallRing(const char* name, const Cell& cell, double radius, double angle);

/// Disks of the case without a place yet: small ones first, then large ones.
Disks diskKinds(const Particles& particles);

/// The same evenly spread over the cell, as seeds are over a sunflower's head (Vogel 1979): a scene
/// for engines to be asked about, not to be run, as neighbours may overlap.
Disks spreadDisks(const Case& setup);

/// A start that an engine cannot be blamed for: no two disks overlap by more than
/// max_overlap · small radius, no two centres coincide, all are finite.
/// Where `cell` is given, they also lie between its walls.
/// @throws BadInput naming the disks
void checkStart(const Scene& scene, const Particles& particles, const std::string& where,
                const Cell* cell = nullptr);

}  // namespace crossgrain
