#pragma once

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

}  // namespace crossgrain::inline averaging
