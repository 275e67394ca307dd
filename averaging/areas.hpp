#pragma once

#include <vector>

#include "adapters/vec2.hpp"

namespace crossgrain::inline averaging {

/// Area common to a disk of radius a at distance r from the origin and the disk of radius R about
/// the origin [m²]. Exact closed form, in half-angles of the triangle (r, a, R) so that it keeps
/// its relative accuracy near tangency and for R ≫ a.
double commonArea(double r, double a, double R);

/// Area of that disk on the near side of a straight line at distance R from the origin [m²]
/// (a² (φ − sin φ cos φ), cos φ = (r − R)/a clamped to [−1, 1]; Lätzel 2003, Eq. 5.4).
double straightCutArea(double r, double a, double R);

/// Area of the unit disk about the origin in the quadrant x ≤ X, y ≤ Y [-].
double quadrantArea(double X, double Y);

/// The same three of a convex polygon, whose vertices are counter-clockwise, exact [m²]: all of it;
/// common to the disk of radius R about the origin, side by side a triangle of the origin or a
/// sector; and in the quadrant, clipped side by side (Sutherland and Hodgman 1974).
double areaOf(const std::vector<Vec2>& outline);
double commonArea(const std::vector<Vec2>& outline, double R);
double quadrantArea(const std::vector<Vec2>& outline, const Vec2& corner);

}  // namespace crossgrain::inline averaging
