#pragma once

#include "cases/case.hpp"

namespace crossgrain {

/// Global volume fraction ν̄ = Σ π a² / (π (R_o² − R_i²)) of the disks without the wall disks, which
/// is how the numbers of the thesis' table 3.2 come out. @pre a couette case without particles.file
double volumeFraction(const Case& c);

}  // namespace crossgrain
