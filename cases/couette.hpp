#pragma once

#include "cases/case.hpp"
#include "cases/packing.hpp"

namespace crossgrain::inline cases {

/// Names of the cell's two bodies.
inline constexpr const char* wheelName = "wheel";
inline constexpr const char* ringName = "ring";

/// The Couette cell filled with a packing: the wheel (turning with Ω about the origin) and the ring
/// (at rest) are rigid bodies of wall disks with centres on R_i and R_o, evenly spread. Where the
/// case blocks rotation, the packing's spins are dropped.
Scene couetteScene(const Case& setup, const Packing& packing, double dt);

/// Seconds of one rotation of the wheel.
double rotationTime(const Case& setup);

/// How many disks the wall of that radius has: 2π·radius/wall_spacing, rounded to the nearest, so
/// that the real spacing is as near the wanted one as whole numbers allow. Wheel:
/// `cell.innerRadius`, ring: `cell.outerRadius`.
int wallDiskCount(const Cell& cell, double radius);

/// The width of the holes in that wall, 2·dilation·radius·sin(π/count) − 2·wall_radius: a disk of
/// that diameter or a smaller one slips through [m]; negative where wall disks overlap. With the
/// ring at dilation·R_o, as while a packing is prepared, it has the same disks.
double wallHole(const Cell& cell, double radius, double dilation = 1.0);

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
/// @param lines  of the file `where` that disks and wall disks were read from, by id; 0 or missing:
///               nobody knows
/// @throws BadInput naming the disks
void checkStart(const Scene& scene, const Particles& particles, const std::string& where,
                const Cell* cell = nullptr, std::span<const int> lines = {});

}  // namespace crossgrain::inline cases
