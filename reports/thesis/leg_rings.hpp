#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/common/figure.hpp"
#include "results/thesis.hpp"

/// Ring averages of the thesis' runs, as its figures need them.
namespace crossgrain::reports {

enum class RingWidth { ofCase, finest };

/// One run's averages over rings. The results must outlive it.
struct RingView {
  const ThesisLeg* leg = nullptr;
  const ThesisRun* run = nullptr;
  const std::vector<Profile>* profiles = nullptr;
  std::string method;
  RingPlaces places;
};

/// A packing of Table 3.2 by its ν̄, the first of equal ones; null if it was not run.
const ThesisLeg* packingLeg(const ThesisResults& results, double label);
/// All of them, by rising ν̄.
std::vector<const ThesisLeg*> packingLegs(const ThesisResults& results);

/// Engines that have finished runs, in the order of the runs: the reference first.
std::vector<std::string> enginesWithRuns(const ThesisResults& results);

/// An engine's finished runs of a leg, a packing each.
std::vector<const ThesisRun*> finishedRuns(const ThesisResults& results, const ThesisLeg& leg,
                                           std::string_view engine);
/// Absent if it has no averages. @param method  empty: the first one of the run
std::optional<RingView> ringViewOf(const ThesisLeg& leg, const ThesisRun& run,
                                   RingWidth width = RingWidth::ofCase,
                                   std::string_view method = "");
std::vector<RingView> ringViews(const ThesisResults& results, const ThesisLeg& leg,
                                std::string_view engine, RingWidth width = RingWidth::ofCase,
                                std::string_view method = "");

/// A number for each ring: scale · field · ∏ times/over.
struct Quantity {
  std::string
      field;  ///< of profiles.csv, or r_m, r_tilde, r_over_inner, xi = (r − R_i)/(R_o − R_i)
  std::string over = {};
  std::vector<std::string> times = {};
  double (*scale)(const ThesisLeg&) = nullptr;  ///< null: 1
  bool magnitude = false;                       ///< its size, without the sign
};

Numbers valuesIn(const RingView& view, const Quantity& quantity);

/// The mean over packings against that of x, ring by ring; bars over packings, or within the run of
/// a single packing where the quantity is a field but for its scale.
std::vector<Point> meanPoints(const std::vector<RingView>& views, const Quantity& x,
                              const Quantity& y);

/// Mean of a number per run, with sd/√P from two runs on. Absent without a number.
struct MeanOfRuns {
  std::optional<double> mean, error;
};
MeanOfRuns meanOfRuns(const std::vector<std::optional<double>>& values);

}  // namespace crossgrain::reports
