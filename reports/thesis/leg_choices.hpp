#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/thesis.hpp"

/// What a ladder's legs may differ in beside the numbers of their disks.
namespace crossgrain::reports {

struct LegSettings {
  double spacing = 0.0;      ///< of the walls' disks [m]
  double smallRadius = 0.0;  ///< [m]
  double largeMass = 0.0;    ///< [kg]; 0: the leg's case does not say
  double omega = 0.0;        ///< of the wheel [rad/s]
  double kn = 0.0;           ///< [N/m]
  double mu = 0.0;           ///< [-]
  bool bottomFriction = true;
};

/// @throws BadInput where the leg's case is not TOML
LegSettings settingsOf(const ThesisLeg& leg);

/// Lengths and masses are typed in, so that only rounding is to be forgiven.
bool sameSetting(double a, double b);
/// k_n, µ and the plate.
bool sameLaw(const LegSettings& a, const LegSettings& b);

/// What the thesis leaves open, as the families of legs name it.
struct OpenChoice {
  const char* key;  ///< "spacing"
  const char* words;
  double LegSettings::*value;
  double unit;
  const char* unitName;
};
inline constexpr OpenChoice openChoices[] = {
    {"spacing", "wall spacing", &LegSettings::spacing, 1e-3, "mm"},
    {"mass", "large mass", &LegSettings::largeMass, 1e-3, "g"},
    {"radius", "small radius", &LegSettings::smallRadius, 1e-3, "mm"}};

/// "wall spacing 7 mm"
std::string wordsOf(const OpenChoice& open, const LegSettings& of);
/// "Ω = 0.1 /s"
std::string wordsOfRate(const LegSettings& of);

/// Whether they are the same but for that choice, if one is given, and the rate, if it may differ.
bool sameBut(const OpenChoice* but, bool anyRate, const LegSettings& a, const LegSettings& b);

bool isOf(const ThesisLeg& leg, std::string_view family);

/// That all are held against: the first leg of the family "packings"; where there is none, the
/// first. Null without legs.
const ThesisLeg* referenceLeg(const ThesisResults& results);

}  // namespace crossgrain::reports
