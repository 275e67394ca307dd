#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/thesis.hpp"

/// A campaign's runs as claims and figures read them: which runs there are, in what their cases
/// differ, and numbers ring by ring. Fields are those of a run's first method, as verdicts are.
namespace crossgrain::inline results {

/// A run with its case. The results must outlive it.
struct CaseRun {
  const ThesisCase* setup = nullptr;
  const ThesisRun* run = nullptr;
};

bool isOf(const ThesisCase& setup, std::string_view family);
/// Cases of Table 3.2, by rising ν̄.
std::vector<const ThesisCase*> packingCases(const ThesisResults& results);
/// The first of them with that ν̄; null if there is none.
const ThesisCase* packingCase(const ThesisResults& results, double label);
/// What all are compared with: the first case of the family "packings"; where there is none, the
/// first. Null without cases.
const ThesisCase* referenceCase(const ThesisResults& results);

/// Engines that have finished runs, in the order of the runs: the reference first.
std::vector<std::string> enginesWithRuns(const ThesisResults& results);
/// An engine's finished runs of a case, a packing each.
std::vector<CaseRun> finishedRuns(const ThesisResults& results, const ThesisCase& setup,
                                  std::string_view engine);
/// For each packing the run that followed it for longest. One seed gives one packing of so many
/// disks, whatever case shows it: all runs must be of one interpretation and rate.
std::vector<CaseRun> longestOfEachPacking(const std::vector<CaseRun>& runs);

/// What a sweep's cases may differ in beside the numbers of their disks.
struct CaseSettings {
  double spacing = 0.0;      ///< of the walls' disks [m]
  double smallRadius = 0.0;  ///< [m]
  double largeMass = 0.0;    ///< [kg]; 0: the case does not say
  double omega = 0.0;        ///< of the wheel [rad/s]
  double kn = 0.0;           ///< [N/m]
  double mu = 0.0;           ///< [-]
  bool bottomFriction = true;
};
/// @throws BadInput where the case is not TOML
CaseSettings settingsOf(const ThesisCase& setup);
/// Lengths and masses are typed in, so that only rounding is to be forgiven.
bool sameSetting(double a, double b);
/// k_n, µ and the plate.
bool sameLaw(const CaseSettings& a, const CaseSettings& b);

/// What the thesis leaves open, as the families of cases name it.
struct OpenChoice {
  const char *key, *label;  ///< "spacing", "wall spacing"
  double CaseSettings::*value;
  double unit;
  const char* unitName;
};
inline constexpr OpenChoice openChoices[] = {
    {"spacing", "wall spacing", &CaseSettings::spacing, 1e-3, "mm"},
    {"mass", "large mass", &CaseSettings::largeMass, 1e-3, "g"},
    {"radius", "small radius", &CaseSettings::smallRadius, 1e-3, "mm"}};

/// "wall spacing 7 mm"
std::string describe(const OpenChoice& open, const CaseSettings& of);
/// "Ω = 0.1 /s"
std::string describeRate(const CaseSettings& of);
/// Whether they are the same but for that choice, if one is given, and the rate, if it may differ.
bool sameBut(const OpenChoice* but, bool anyRate, const CaseSettings& a, const CaseSettings& b);

/// The span in which that rotation ends; null where the history does not reach so far.
const ThesisSpan* spanAt(const ThesisRun& run, double rotation);
/// A parameter that was fitted to the run; null where it could not be.
const FitRow* fitOf(const ThesisRun& run, std::string_view name);
std::optional<double> fittedIn(const ThesisRun& run, std::string_view name);

/// Rings whose centres lie in from ≤ r̃ < to.
struct RingSpan {
  double from = 0.0, to = std::numeric_limits<double>::infinity();
};

/// A ring that has a number.
struct RingValue {
  std::size_t ring = 0;
  double r = 0.0, rTilde = 0.0;  ///< of its centre; [m], [-]
  double value = 0.0;
};

/// B; 0 without profiles.
std::size_t ringCount(const CaseRun& at);
/// The ring whose centre is next to an r̃; absent without profiles.
std::optional<std::size_t> ringNear(const CaseRun& at, double rTilde);
/// So many rings, equally wide from the wheel to the outer ring, without a number.
std::vector<RingValue> ringPlaces(const CouetteCell& cell, std::size_t count);
/// The rings of a profile, that are equally wide from the wheel to the outer ring; none of null.
std::vector<RingValue> ringsOf(const CouetteCell& cell, const Profile* profile);
/// The rings that have the field; none where the run lacks it.
std::vector<RingValue> ringsOf(const CaseRun& at, std::string_view field, RingSpan span = {});
/// One field over another, ring by ring where both are there and the latter is not 0.
std::vector<RingValue> ratiosOf(const CaseRun& at, std::string_view field, std::string_view by,
                                RingSpan span = {});
std::optional<double> meanOf(const std::vector<RingValue>& rings);
std::optional<double> medianOf(const std::vector<RingValue>& rings);

/// From which ring on the shear resistance is said to diverge. Places are r̃ of rings' centres.
struct DivergenceRule {
  double bandTo = 5.0;  ///< G/tr F of 0 ≤ r̃ < bandTo has the median that counts as proportional
  double from = 1.0, to = 16.0;  ///< examined: from ≤ r̃ < to
  double factor = 2.0;           ///< above so many medians
};
/// tr F of the ring from which on, to the last that is examined, G/tr F is above the factor times
/// its median in the band. Absent where the last ring is not; rings whose G is not positive count
/// nowhere.
std::optional<double> traceOfDivergence(const CaseRun& at, const DivergenceRule& rule);

/// Ψ_f against Ψ_i under one tangential law, and the e_n that its asymptote has.
struct LawSweep {
  struct Point {
    double psi, after;  ///< Ψ_i, Ψ_f
  };
  std::vector<Point> points;
  double en = 0.0;

  double lowest() const;  ///< Ψ_f; of a sweep with points
};
using LawSweeps = std::map<std::string, LawSweep>;  ///< by the law's name in case files

/// An engine's sweeps of the variants of that tension, "allow" or "cut", each at the time step next
/// to so many steps per contact; those that finished.
LawSweeps lawSweeps(const CollideResults& collisions, const std::string& engine,
                    const std::string& tension, double steps);
/// µ of the collisions' law; 0 where no variant says it.
double lawFriction(const CollideResults& collisions);

}  // namespace crossgrain::inline results
