#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "cases/loader.hpp"
#include "studies/thesis/claims.hpp"
#include "tests/support/thesis.hpp"

/// Results of a campaign made by hand, in which all is as the thesis says; tests change one thing.
namespace crossgrain::test {

inline constexpr double pi = std::numbers::pi;
inline constexpr int worldRings = 20;

/// A case of the thesis' cell.
inline ThesisCase worldCase(const TableRow& of, const std::string& name, const std::string& family,
                            double omega = 0.1) {
  ThesisCase setup;
  setup.name = name;
  setup.families = {family};
  setup.cell = {0.1032, 0.2524, 0.00125, 0.0025,   0.006, omega,
                {},     {},     0.0037,  0.004495, of.nu, 0.0074};
  setup.cell.small = static_cast<std::size_t>(of.small);
  setup.cell.large = static_cast<std::size_t>(of.large);
  setup.label = of.nu;
  setup.kn = 352.1;
  setup.mu = 0.44;
  setup.settleRotations = 5.0;
  setup.averagedRotations = 3.0;
  return setup;
}

/// A field of one run as a function of r̃.
using Shape = std::function<double(double rTilde)>;

inline Profile profileOfShape(const std::string& method, const std::string& field,
                              const ThesisCase& setup, int rings, const Shape& shape) {
  Profile profile;
  profile.method = method;
  profile.field = field;
  const double width =
      (setup.cell.outerRadius - setup.cell.innerRadius) / rings / setup.cell.diameter;
  for (int k = 0; k < rings; ++k) {
    profile.mean.emplace_back(shape((k + 0.5) * width));
    profile.standardError.emplace_back(0.01 * std::abs(*profile.mean.back()) + 1e-12);
  }
  return profile;
}

/// Puts a field in place of what the run has of it.
inline void setField(ThesisRun& run, const ThesisCase& setup, const std::string& field,
                     const Shape& shape) {
  std::erase_if(run.run.profiles, [&](const Profile& each) {
    return each.field == field && each.method == "slicing";
  });
  run.run.profiles.push_back(profileOfShape("slicing", field, setup, worldRings, shape));
}

inline double* fieldAt(ThesisRun& run, const std::string& field, std::size_t ring) {
  for (Profile& each : run.run.profiles)
    if (each.field == field && each.method == "slicing") return &*each.mean[ring];
  ADD_FAILURE() << field;
  return nullptr;
}

inline void scaleField(ThesisRun& run, const std::string& field, double factor) {
  for (std::size_t ring = 0; ring < worldRings; ++ring) *fieldAt(run, field, ring) *= factor;
}

inline void setFit(ThesisRun& run, const std::string& name, double value) {
  std::erase_if(run.run.fits, [&](const FitRow& fit) { return fit.name == name; });
  FitRow& fit = run.run.fits.emplace_back();
  fit.name = name;
  fit.value = value;
  fit.standardError = 0.01 * std::abs(value);
}

inline void setHead(ThesisRun& run, const std::string& name, double value) {
  std::erase_if(run.run.head, [&](const HeadNumber& each) { return each.name == name; });
  run.run.head.push_back({name, "-", value, {}, {}});
}

/// Replaces the distribution by one of that density.
inline void setDistribution(ThesisRun& run, const std::string& quantity, std::optional<int> ring,
                            const std::vector<Bins>& axes,
                            const std::function<double(double, double)>& density) {
  std::erase_if(run.run.distributions, [&](const Distribution& each) {
    return each.quantity == quantity && each.ring == ring;
  });
  Distribution made{quantity, ring, axes, {}, {}, 0.0, 1000.0};
  const int rows = axes.size() > 1 ? axes[1].count : 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < axes[0].count; ++column)
      made.density.push_back(
          density(axes[0].low + (column + 0.5) * axes[0].width,
                  axes.size() > 1 ? axes[1].low + (row + 0.5) * axes[1].width : 0.0));
  run.run.distributions.push_back(made);
}

inline const std::vector<Bins> velocityAxis{{-0.5, 0.04, 50}};
inline const std::vector<Bins> jointAxes{{-0.5, 0.04, 50}, {-1.5, 0.06, 50}};
inline const std::vector<Bins> directionAxis{{-pi, pi / 18.0, 36}};

/// What a run of this case shows if the thesis is right. Runs of one case differ by 2 % or less.
ThesisRun worldRun(const ThesisCase& setup, int packing);

/// Table 3.2, the rates, and cases of another k_n, without friction and without a plate.
ThesisResults world(int packings = 3);

/// Changes runs that were made.
using Change = std::function<void(ThesisRun& run, const ThesisCase& setup)>;
void changeAll(ThesisResults& results, const Change& change);
/// One packing of each label that claims read alone or of all: 0.804's and 0.796's first.
void changeOne(ThesisResults& results, const Change& change);

inline ClaimRules shippedRules() {
  return loadClaimRules(std::filesystem::path(CROSSGRAIN_CASES) / "couette/thesis/claims.toml",
                        &claimSchema());
}

/// The row of a claim for the engine of the world, under the default interpretation.
ClaimRow rowOf(const std::vector<ClaimRow>& rows, const std::string& id,
               const std::string& interpretation = "default");

}  // namespace crossgrain::test
