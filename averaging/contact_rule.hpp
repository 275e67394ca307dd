#pragma once

#include <cstddef>

#include "adapters/snapshot.hpp"

namespace crossgrain::inline averaging {

/// Says what a contact is: a pair of disks (or disk and wall) that transmits a force, f_n ≠ 0 or
/// f_t ≠ 0, or a torque against rolling, at the instant shown, or as a mean over the interval
/// shown. So C counts what carries load, as coordination numbers of granular packings do (Agnolin
/// and Roux 2007), and σ and fabric are sums over the same set.
///
/// It is the one rule that suits all engines. Overlap is no such rule: rigid disks touch
/// at δ ≤ 0 or stay within the solver's slop, whether or not an impulse passes; and where tension
/// is cut, a pair that parts overlaps for some steps while nothing passes. A pair held together by
/// its dashpot (f_n < 0, tension allowed) does transmit, and counts. Engines list the pairs that
/// they looked at; the averaging alone decides.
template <int D>
bool transmits(const ContactsOf<D>& pairs, std::size_t k) {
  const SpinOf<D> none = noSpin<D>();
  return pairs.normalForce[k] != 0.0 || pairs.tangentialForce[k] != none ||
         (!pairs.rollingTorque.empty() && pairs.rollingTorque[k] != none);
}

}  // namespace crossgrain::inline averaging
