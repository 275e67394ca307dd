#pragma once

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Global volume fraction ν̄ = Σ π a² / (π (R_o² − R_i²)): the whole area of the disks, without the
/// wall disks, over the ring between the circles on which the wall disks' centres lie. So the
/// numbers of the thesis' table 3.2 come out. @pre a couette case without particles.file
double volumeFraction(const Case& c);

/// How many disks have a volume fraction, before rounding. @param largeFraction  by number, 0 … 1
double diskNumber(const Cell& cell, const Particles& particles, double fraction,
                  double largeFraction);

/// Numbers of large and small disks that come nearest to a volume fraction: the large ones by their
/// share, then small ones for what is left. @param largeFraction  by number, 0 … 1
void setNumbers(const Cell& cell, Particles& particles, double fraction, double largeFraction);

}  // namespace crossgrain::inline cases
