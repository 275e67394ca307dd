#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engines/grain/kernels.hpp"
#include "engines/grain/real.hpp"

namespace grain {

/// Where all disks are, moving ones first [m].
struct Places {
  std::span<const Vec<double>> position;
  std::span<const double> radius;
  std::span<const Vec<float>> origin;  ///< of each disk's local coordinates; empty: one origin
};

/// Two disks that overlap more than they may, or whose centres coincide.
struct TooDeep {
  std::size_t i, j;
};

/// Memory of pairs: springs of sliding and of rolling, and what their law does besides.
struct PairSprings {
  bool sliding = false, rolling = false, memory = false, rest = false;

  bool any() const { return sliding || rolling || memory; }  // no rest without a memory
};

/// The same on its way from one list to the next.
struct KeptSpring {
  std::int32_t i, j;
  double spring;        ///< ξ
  double angle;         ///< θ
  double memory = 0.0;  ///< as of contactForce()
  double rest = 0.0;    ///< likewise
};

/// ξ does not change with the order of the two disks: n and s turn round, v_t as well; but θ of j
/// against i is the opposite of θ of i against j.
inline void swapDisks(KeptSpring& kept) {
  std::swap(kept.i, kept.j);
  kept.angle = -kept.angle;
}

/// Pairs in ascending (i, j) on two levels: those with surfaces nearer than the skin when they were
/// collected, and of these the ones that their disks' allowances may bring together. A step works
/// through the near pairs only.
template <class Real>
struct PairList {
  std::vector<std::int32_t> farI, farJ;
  std::vector<Real> farSpring, farAngle, farMemory, farRest;
  std::size_t count = 0;  ///< near pairs; the arrays below have room for all far ones
  std::vector<std::int32_t> i, j;
  std::vector<std::uint32_t> far;  ///< a near pair's place among the far ones
  Array<Real> radiusI, radiusJ;    ///< beside the pair, as they last for as long as it does [m]
  Array<Real> spring, angle, memory, rest;
  Array<Vec<Real>> shift;  ///< origin of i − origin of j, of local coordinates
  // The last step's results, where asked for.
  Array<Real> normal, tangential, sliding, rolling, rollingSlides;
  Array<Vec<Real>> force;
  Array<Real> leverI, leverJ;    ///< forces for two threads to add
  std::vector<KeptSpring> kept;  ///< in ascending (i, j)

  void clear();
  void append(std::int32_t diskI, std::int32_t diskJ);

  /// The near springs back to the far list.
  void storeSprings(PairSprings springs);
  /// Keeps the far list's springs for the next one, and takes them up there: both lists are in one
  /// order, so that one walk through both finds every pair.
  void carry(PairSprings springs);
  void takeKept(PairSprings springs);

  /// @param maxOverlap  of any pair, in units of the smaller radius; it may be infinite
  /// @param range  how far apart bodies may be in contact [m]
  /// @returns how many of the near pairs touch
  /// @throws TooDeep
  std::size_t chooseNear(const Places& now, std::span<const double> allowance, double maxOverlap,
                         PairSprings springs, double range);

  TooDeep firstDeep(const Places& now, double maxOverlap) const;

  PairView<Real> view(AddTo addTo, bool record, bool rotation, bool rolls);
};

}  // namespace grain
