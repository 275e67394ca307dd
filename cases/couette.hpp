#pragma once

#include <span>
#include <string_view>

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

/// The region and endpoints of a cell that has been read: the rings between its walls, and those of
/// endpointTable() that have a margin.
void setFlowOfCell(Case& c);

/// Seconds of one rotation of the wheel.
double rotationTime(const Case& setup);

/// Number of disks in the wall of that radius: 2π·radius/wall_spacing, rounded to the nearest, so
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
/// to query engines about, not to be run, as neighbours may overlap.
Disks spreadDisks(const Case& setup);

/// Checks that a start is sound: no two disks overlap by more than max_overlap · small radius, no
/// two centres coincide, all are finite. Where `cell` is given, they also lie between its walls.
/// @param lines  of the file `where` that disks and wall disks were read from, by id; 0 or missing:
///               unknown
/// @throws BadInput naming the disks
template <int D>
void checkStart(const SceneOf<D>& scene, const Particles& particles, const std::string& where,
                const Cell* cell = nullptr, std::span<const int> lines = {});

/// Global volume fraction ν̄ = Σ π a² / (π (R_o² − R_i²)): the whole area of the disks, without the
/// wall disks, over the ring between the circles on which the wall disks' centres lie. So the
/// numbers of the thesis' table 3.2 come out. @pre a couette case without particles.file
double volumeFraction(const Case& c);

/// Number of disks with that volume fraction, before rounding. @param largeFraction  by number, 0 …
/// 1
double diskNumber(const Cell& cell, const Particles& particles, double fraction,
                  double largeFraction);

/// Numbers of large and small disks that come nearest to a volume fraction: the large ones by their
/// share, then small ones for what is left. @param largeFraction  by number, 0 … 1
void setNumbers(const Cell& cell, Particles& particles, double fraction, double largeFraction);

/// A quantity of a Couette case itself. What a case file gives as a share of one still fits where
/// the case is extended to another wheel, rate or disk.
struct Scale {
  std::string_view name;     ///< as in the case file
  std::string_view unit;     ///< as fields of profiles.csv have it
  std::string_view meaning;  ///< in symbols
  double (*of)(const Case& setup);
};

std::span<const Scale> scales();

/// A share of a scale, rounded to two digits: a margin is a choice, and further digits would claim
/// more.
double fractionOf(const Scale& scale, double share, const Case& setup);

}  // namespace crossgrain::inline cases
