#pragma once

#include "engines/grain/simulation.hpp"

namespace crossgrain::bench {

/// Bytes that one step without a rebuild moves between core and memory when nothing of it fits a
/// cache: every array once per pass over it, read and write counted apart, the read that a write
/// brings about not counted, as in the stream test. Partners of a disk are taken to be in cache:
/// disks are near each other in memory if they are in space.
struct Traffic {
  double perDisk = 0.0, perPair = 0.0, perContact = 0.0;  ///< [byte]

  double perStep(double disks, double pairs, double contacts) const {
    return perDisk * disks + perPair * pairs + perContact * contacts;
  }
};

/// The model for the step of engines/grain, pass by pass: `setup` says which arrays there are.
inline Traffic stepTraffic(const grain::Setup& setup) {
  const double real = setup.precision == grain::Precision::float64 ? 8.0 : 4.0;
  const bool spins = setup.law.friction() && setup.rotation;
  const bool springs =
      setup.law.friction() && (setup.law.tangential == grain::Tangential::spring ||
                               setup.law.tangential == grain::Tangential::springDashpot);
  Traffic traffic;
  const auto disk = [&](int reads, int writes) { traffic.perDisk += real * (reads + writes); };

  disk(5, 2);                                // kick: v, f, 1/m → v
  if (spins) disk(3, 1);                     //       ω, M, 1/J → ω
  disk(4, 2);                                // drift: x, v → x
  disk(5, 2);                                // predict: v, f, 1/m → u
  if (spins) disk(3, 1);                     //          ω, M, 1/J → u_ω
  disk(4, 0);                                // outdated: x, x at the last rebuild
  disk(0, 2);                                // clear f
  if (spins) disk(0, 1);                     //       M
  disk(8, 2);                                // pairs: x, u, a, 1/m, f → f
  if (spins) disk(3, 1);                     //        u_ω, 1/J, M → M
  traffic.perDisk += 8;                      //        where its row begins
  traffic.perPair += 4;                      //        partner
  if (springs) traffic.perPair += 2 * real;  // ξ → ξ
  traffic.perContact += sizeof(grain::Contact);
  if (setup.bottom) {
    disk(8, 4);             // plate: m, a, u, ξ_b, f → ξ_b, f
    if (spins) disk(2, 1);  //        u_ω, M → M
  }
  return traffic;
}

}  // namespace crossgrain::bench
