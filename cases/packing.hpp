#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/scene.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Disks in the cell, or spheres in space, ready to be handed to an engine at t = 0.
struct Packing {
  Disks disks;              ///< of a case in the plane
  DisksOf<3> spheres;       ///< of one in space
  double wheelAngle = 0.0;  ///< by which the wheel's disks have turned since it was built [rad]
  double wallTime = 0.0;    ///< for which the walls of an assembly have moved [s]
  std::string fixed;        ///< fingerprint of disks of its file that stand still; empty: none
  std::string hash;         ///< of all that it was made from
  bool asWritten = false;   ///< of a file: it is what writePacking() wrote, to the bit
  bool fromCache = false;
  std::string anew;  ///< why the one that was kept was not used; empty: there was none, or it was
  std::string notCached;  ///< why it could not be kept for next time; empty if it could
};

/// Its bodies of that dimension.
template <int D, typename AnyPacking>
auto& disksIn(AnyPacking& packing) {
  if constexpr (D == 2)
    return packing.disks;
  else
    return packing.spheres;
}

/// Fingerprint of everything that a prepared packing depends on, the engine that prepares it too.
/// @throws as preparerKey()
std::string packingHash(const Case& setup, int index, double dt);

/// Fingerprint of a packing itself, for one without a preparation.
std::string contentHash(const Packing& packing);

/// HDF5: datasets radius, mass, inertia (N), position, velocity (N × 2), spin (N), SI units, and
/// the attributes wheel_angle, hash and a checksum of all of it. Velocity, spin, mass and inertia
/// may be absent from a file of the user's own: then they are zero, and what the case says for the
/// radius.
void writePacking(const Packing& packing, const std::filesystem::path& file);

/// @param most  disks: more are refused
/// @throws BadInput naming the file and what it lacks
Packing readPacking(const std::filesystem::path& file, const Case& setup,
                    std::size_t most = mostDisks);

/// The packing kept in that file for that hash. Absent where there is none, and where it is another
/// packing or no longer what was written: then `why` says so.
std::optional<Packing> keptPacking(const std::filesystem::path& file, const std::string& hash,
                                   const Case& setup, std::string& why,
                                   std::size_t most = mostDisks);

/// Columns that a file of disks may leave out.
struct DiskDefaults {
  std::function<double(double radius)> mass;  ///< [kg]
  double inertiaFactor = 0.5;                 ///< q in J = q m a²
  std::size_t most = mostDisks;               ///< more in a file are refused
  double density = 0.0;                       ///< of convex bodies; 0: none [kg/m², kg/m³]
};

/// @throws likewise
template <int D = 2>
Packing readPacking(const std::filesystem::path& file, const DiskDefaults& defaults);

}  // namespace crossgrain::inline cases
