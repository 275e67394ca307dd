#pragma once

#include <optional>
#include <span>

namespace crossgrain::inline averaging {

/// Whether a packing of that ν̄ carries.
struct LoadState {
  double nu = 0.0;
  bool carries = false;
};

struct TransitionDensity {
  double nu = 0.0;  ///< at which half of the packings carry
  double standardError = 0.0;
};

/// ν̄ at which half of the packings carry, by logistic regression with Jeffreys' prior (Firth 1993:
/// finite where the two kinds do not overlap), its error by linearisation. Absent where all carry
/// or none does, where more do at low ν̄, and where the half lies further outside of the points than
/// `beyond`.
std::optional<TransitionDensity> transitionDensity(std::span<const LoadState> packings,
                                                   double beyond);

}  // namespace crossgrain::inline averaging
