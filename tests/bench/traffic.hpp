#pragma once

#include "engines/grain/simulation.hpp"

namespace crossgrain::bench {

/// Bytes that one step without new lists moves between core and memory when nothing of it fits a
/// cache: every array once per pass over it, read and write counted apart, the read that a write
/// brings about not counted, as in the stream test. Partners of a disk are taken to be in cache:
/// disks are near each other in memory if they are in space.
struct Traffic {
  double perDisk = 0.0, perPair = 0.0;  ///< [byte]; pairs are the near ones

  double perStep(double disks, double pairs) const { return perDisk * disks + perPair * pairs; }
};

/// The model for the step of engines/grain, pass by pass: `setup` says which arrays there are.
inline Traffic stepTraffic(const grain::Setup& setup) {
  const bool single = setup.precision == grain::Precision::float32;
  const double real = single ? 4.0 : 8.0;
  const bool spins = setup.law.friction() && setup.rotation;
  const bool velocities = setup.law.friction() || setup.law.gn > 0.0;
  const bool predict = setup.law.damping == grain::Damping::predicted &&
                       setup.integrator != grain::Integrator::semiImplicitEuler;
  Traffic traffic;
  const auto disk = [&](int reads, int writes) { traffic.perDisk += real * (reads + writes); };

  disk(10, 6);                          // motion: x, v, f, 1/m, x chosen, allowance → x, v, f
  if (predict) disk(0, 2);              //         → u
  if (spins) disk(3, predict ? 3 : 2);  //         ω, M, 1/J → ω, M, u_ω
  if (setup.bottom) disk(4, 2);         //         plate: m, a, ξ_b → ξ_b
  disk(5, 2);                           // pairs: x, a, f → f
  if (velocities) disk(2, 0);           //        u
  if (spins) disk(2, 1);                //        u_ω, M → M
  traffic.perPair += 8;                 //        i, j
  if (setup.law.springs()) traffic.perPair += 2 * real;  // ξ → ξ
  if (single) traffic.perPair += 8;                      //        origin of i − origin of j
  return traffic;
}

}  // namespace crossgrain::bench
