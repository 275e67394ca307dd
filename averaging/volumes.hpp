#pragma once

#include "adapters/vec2.hpp"

namespace crossgrain::inline averaging {

/// Parts of the unit sphere about the origin, as fractions of its volume 4π/3.

/// Below z: ¾(z − z³/3) + ½, z clamped to [−1, 1] (∫ π(1 − z²) dz). Exact.
double fractionBelow(double z);

/// Between two corners. Exact where at most one direction is cut; else the exact area that a slice
/// has in common with a rectangle (quadrantArea()), integrated over slices to 1e-8.
double fractionWithin(const Vec3& low, const Vec3& high);

/// Inside the cylinder of radius R about an axis along z at distance s from the centre, between low
/// and high: commonArea() of slices, integrated to 1e-8 [lengths in radii]. Its closed form needs
/// elliptic integrals.
double fractionInCylinder(double s, double R, double low, double high);

}  // namespace crossgrain::inline averaging
