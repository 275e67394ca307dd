#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "averaging/rings.hpp"

namespace crossgrain {

/// How a disk is shared out among the bins.
enum class WeightMethod {
  slicing,      ///< exact area fraction, from the circle–circle intersection
  straightCut,  ///< area fraction with the rings' edges taken as straight (Lätzel 2003, Eq. 5.4)
  centre        ///< all to the bin that holds the centre (Lätzel 2003, Eq. 5.3)
};

/// The name used in case files and CSV: "slicing", "straight_cut", "centre".
std::string_view toString(WeightMethod method);

/// @throws std::invalid_argument saying which names there are
WeightMethod weightMethod(std::string_view name);

/// Fractions w of one disk in consecutive bins; they add up to 1 over all bins, overflow included.
/// Meant to be used again for the next disk: its memory is kept.
struct BinWeights {
  int first = 0;                 ///< bin of fraction[0]
  std::vector<double> fraction;  ///< of the bins first, first + 1, … [-]
};

/// The weights of a disk of radius a [m] whose centre is at distance r [m] from the origin.
void binWeights(const Rings& rings, WeightMethod method, double r, double a, BinWeights& weights);

/// Area common to a disk of radius a at distance r from the origin and the disk of radius R about
/// the origin [m²]. Exact closed form, in half-angles of the triangle (r, a, R) so that it keeps
/// its relative accuracy near tangency and for R ≫ a.
double commonArea(double r, double a, double R);

/// Area of that disk on the near side of a straight line at distance R from the origin [m²]
/// (a² (φ − sin φ cos φ), cos φ = (r − R)/a clamped to [−1, 1]; Lätzel 2003, Eq. 5.4).
double straightCutArea(double r, double a, double R);

}  // namespace crossgrain
