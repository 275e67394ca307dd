#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/engine.hpp"
#include "adapters/files/frame.hpp"
#include "adapters/scene.hpp"

/// Units and axes of other programs' files, and conditions on their particles.
namespace crossgrain::files {

/// @throws BadInput naming the frame
[[noreturn]] void fail(const FileFrame& frame, const std::string& what);

/// Units, start and axes, which no file contains: [engines.NAME] of a case.
struct FileUnits {
  double length = 1.0, time = 1.0, mass = 1.0;  ///< of the file's units [m], [s], [kg]
  double dt = 0.0;              ///< time step of files that count steps [file's time]; 0: not said
  double start = 0.0;           ///< when the case's t = 0 is [file's time]
  double contactsBehind = 0.0;  ///< steps by which contacts are older than positions [dt]
  /// In the plane: of the file's x, y, z, that are x and y of the scene. In space they are its own.
  int axes[3] = {0, 1, 2};
  double turn = 1.0;  ///< in the plane: z of the scene along the third axis (1) or against it (−1)
  int dimension = 2;  ///< of the case: 3 in space

  double force() const { return mass * length / (time * time); }  ///< of the file's units [N]
  int third() const { return 3 - axes[0] - axes[1]; }

  /// A vector of the file along the scene's axes, in the file's units.
  template <int D>
  VecOf<D> along(const Vec3& v) const {
    if constexpr (D == 2)
      return {v[axes[0]], v[axes[1]]};
    else
      return v;
  }
  /// A spin or torque of the file likewise.
  template <int D>
  SpinOf<D> about(const Vec3& v) const {
    if constexpr (D == 2)
      return turn * v[third()];
    else
      return v;
  }
};

/// The settings of a format's files, with its own defaults; in space none is of a plane.
std::vector<SettingSpec> fileSettings(std::string_view format, int dimension);
/// @param settings  of fileSettings(); what is missing has its default  @throws BadInput
FileUnits fileUnits(std::string_view format, const Settings& settings);

/// The box of a case as a file would have it.
template <int D>
FileBox boxInFiles(const BoxOf<D>& box, const FileUnits& units);

/// Of the missing components of vectors the first that the case needs: in space all three are, in
/// the plane those along its axes, of spins and torques the one across it. Null: none.
const MissingComponent* neededComponent(const std::vector<MissingComponent>& missing,
                                        const FileUnits& units, bool axial);

/// Places and velocities have the components that the case needs, each array that is there is of
/// all particles. In the plane: nothing lies beside the others, moves out of it or spins about an
/// axis in it. A direction that the file has periodic is that of the case's box, and as long; or
/// nothing reaches over its edge.
/// @throws BadInput naming the frame and the condition that fails
template <int D>
void checkParticles(const FileFrame& frame, const FileUnits& units,
                    const std::optional<BoxOf<D>>& box);

/// The last digit that numbers were written with: as a part of the number, where all have as many
/// digits, and its place, where all have as many decimals.
LastDigit lastDigitOf(const std::vector<double>& numbers);

/// Relative rounding of coordinates: twice the last digit of files that write five to eight of
/// them, as half of all coordinates then use the last two; else single precision's. Round numbers
/// of a lattice are no sign of it.
double roundingOf(const std::vector<Vec3>& position, const FileUnits& units);

/// How exactly particles say which of them overlap; absent where their digits do not show it.
std::optional<ShownPlaces> shownPlacesOf(const FileParticles& particles, const FileUnits& units);

}  // namespace crossgrain::files
