#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "averaging/profiles.hpp"
#include "averaging/rings.hpp"

/// The state that a sheared cell is in. Means over runs in different regimes are means of
/// different things, so this is asked first.
namespace crossgrain::inline averaging {

/// Where the wheel's rotation is taken up, as fractions of Ω: 1 = slip + shear + what is left
/// between the outermost layer and the ring. The layers at the walls are the disks whose centres
/// are within a diameter of the walls' centres; a layer turns with the mean of its disks' v_φ/r.
struct WheelMotion {
  double slip = 0.0;   ///< 1 − ω₁/Ω, between the wheel and the layer on it
  double shear = 0.0;  ///< (ω₁ − ω_B)/Ω, among the disks
};

/// Absent where a layer is empty. @param cell  its walls and its d are taken, its rings are not
std::optional<WheelMotion> wheelMotion(const Scene& scene, const Snapshot& snapshot,
                                       const Rings& cell, double omega);

/// I = γ̇ d √(ρ/p) in the innermost two rings (GDR MiDi 2004), with γ̇ = |∂v_φ/∂r − v_φ/r| and p =
/// (σ_rr + σ_φφ)/2 of the first. Absent where p is not positive.
/// @param profiles  of one method  @param density  ρ of a disk [kg/m³]
std::optional<double> inertialNumber(const Rings& rings, std::span<const Profile> profiles,
                                     double density);

/// - flowing: disks touch for long, and layers pass one another.
/// - blocked: the wheel slips over disks that keep their neighbours (or turns all of them as one
///   piece): it moves, and the packing is not sheared.
/// - collisional: no lasting network of contacts leads from the wheel outward; what stress there is
///   comes from impacts and goes with Ω².
enum class Regime { flowing, blocked, collisional };
constexpr auto namesOf(Regime) {
  return std::array<std::string_view, 3>{"flowing", "blocked", "collisional"};
}

/// "flowing", "blocked", "collisional"
constexpr std::string_view toString(Regime regime) {
  return namesOf(regime)[static_cast<std::size_t>(regime)];
}

/// Above it a disk is hit before it has found its place under the pressure: contacts become brief
/// and binary. GDR MiDi (2004), da Cruz et al. (2005) and Forterre & Pouliquen (2008) put the end
/// of dense flow at I of about 0.1, in two dimensions as well.
inline constexpr double collisionalInertialNumber = 0.1;

/// A wheel that touches less than one disk at a time is without any for part of the time, so that
/// nothing leads outward from it (Lätzel 2003, chapter 6: the wheel loses contact below the
/// critical volume fraction).
inline constexpr double fewestWheelContacts = 1.0;

/// Below it the wheel goes ten times as far as the layers shift against each other. A band that
/// shears takes up about a third of the wheel's rotation (v_φ of the first layer is 0.4 to 0.8 of
/// the rim's, and decays within two diameters), elastic play and rattlers in their cages nearly
/// nothing: between the two there is a decade, and 0.1 is in it.
inline constexpr double leastShear = 0.1;

/// Means over the averaged time. Absent is what the run has no data for.
struct RegimeFigures {
  std::optional<double> wheelContacts;    ///< of the wheel's disks with others, at a time
  std::optional<WheelMotion> motion;      ///< see WheelMotion
  std::optional<double> inertialNumber;   ///< see inertialNumber()
  std::optional<double> blockedFraction;  ///< see blockedFraction()
};

/// A regime and what it was read from, in words.
struct RegimeVerdict {
  std::optional<Regime> regime;  ///< absent: the run does not show enough
  std::string reason;
};

/// In this order: collisional (by contacts, then by I), blocked, flowing.
RegimeVerdict regimeOf(const RegimeFigures& figures);

/// The share of time in which the packing stood still: of windows of so many samples, those whose
/// mean shear is below leastShear. Absent without a whole window.
/// @param shear  WheelMotion::shear at equidistant times
std::optional<double> blockedFraction(std::span<const double> shear, std::size_t window);

}  // namespace crossgrain::inline averaging
