// Distributions of velocity, spin and contact directions: C11, C14.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "runs/thesis/claims_judges.hpp"
#include "runs/thesis/claims_rings.hpp"

namespace crossgrain::inline runs {
namespace {

constexpr double pi = std::numbers::pi;

const Distribution* distributionOf(const LegRun& at, std::string_view quantity,
                                   std::optional<int> ring) {
  for (const Distribution& each : at.run->run.distributions)
    if (each.quantity == quantity && each.ring == ring) return &each;
  return nullptr;
}

double middleOf(const Bins& bins, std::size_t k) {
  return bins.low + (static_cast<double>(k) + 0.5) * bins.width;
}

/// Mean density over the cells that a window holds; absent where it holds none.
using Window = std::function<bool(double velocity, double spin)>;
std::optional<double> densityIn(const Distribution* joint, const Window& window) {
  if (!joint || joint->axes.size() != 2) return std::nullopt;
  const auto across = static_cast<std::size_t>(joint->axes[0].count);
  double sum = 0.0, cells = 0.0;
  for (std::size_t cell = 0; cell < joint->density.size(); ++cell) {
    if (!window(middleOf(joint->axes[0], cell % across), middleOf(joint->axes[1], cell / across)))
      continue;
    sum += joint->density[cell];
    cells += 1.0;
  }
  return over(sum, cells);
}

/// Mean density of one axis over the bins between two values.
std::optional<double> densityBetween(const Distribution* one, double from, double to) {
  if (!one || one->axes.size() != 1) return std::nullopt;
  double sum = 0.0, bins = 0.0;
  for (std::size_t k = 0; k < one->density.size(); ++k) {
    const double middle = middleOf(one->axes[0], k);
    if (middle < from || middle > to) continue;
    sum += one->density[k];
    bins += 1.0;
  }
  return over(sum, bins);
}

const Distribution* jointOf(const LegRun& at) {
  return distributionOf(at, "azimuthal_velocity_and_spin", {});
}

/// Density near one v_φ/(ΩR_i) of the first ring over that of a window before it.
RunFigure peakOver(RingSpan peak, RingSpan before) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    const Distribution* const velocity = distributionOf(at, "azimuthal_velocity", 0);
    return over(densityBetween(velocity, peak.from, peak.to),
                densityBetween(velocity, before.from, before.to));
  };
}

/// Contact directions of a ring relative to uniform, opposite ones taken together.
class Directions {
 public:
  Directions(const LegRun& at, std::optional<std::size_t> ring)
      : found_(ring ? distributionOf(at, "contact_direction", static_cast<int>(*ring)) : nullptr) {}

  std::optional<double> near(double angle, double window) const {
    if (!found_) return std::nullopt;
    double sum = 0.0, bins = 0.0;
    for (std::size_t k = 0; k < found_->density.size(); ++k) {
      const double off = middleOf(found_->axes[0], k) - angle;
      if (std::abs(off - pi * std::round(off / pi)) > window) continue;
      sum += 2.0 * pi * found_->density[k];
      bins += 1.0;
    }
    return over(sum, bins);
  }

  /// Root mean square distance from uniform.
  std::optional<double> anisotropy() const {
    if (!found_ || found_->density.empty()) return std::nullopt;
    const std::size_t bins = found_->density.size(), half = bins / 2;
    double squares = 0.0;
    for (std::size_t k = 0; k < bins; ++k) {
      const double both = pi * (found_->density[k] + found_->density[(k + half) % bins]);
      squares += (both - 1.0) * (both - 1.0);
    }
    return std::sqrt(squares / static_cast<double>(bins));
  }

 private:
  const Distribution* found_;
};

std::optional<double> meanOfBoth(std::optional<double> a, std::optional<double> b) {
  if (!a || !b) return std::nullopt;
  return 0.5 * (*a + *b);
}

/// In the rings at the wheel and 2 d out (figures 7.9 a and b).
RunFigure inBandNear(double angle, double window) {
  return [=](const LegRun& at) -> std::optional<Measured> {
    return meanOfBoth(Directions(at, ringNear(at, 0.5)).near(angle, window),
                      Directions(at, ringNear(at, 2.5)).near(angle, window));
  };
}

Directions outermost(const LegRun& at) {
  const std::size_t rings = ringCount(at);
  return Directions(at, rings > 0 ? std::optional(rings - 1) : std::nullopt);
}

}  // namespace

void judgeJointDistribution(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.upward();
  const double restV = scope.number("rest_velocity"), restS = scope.number("rest_spin");
  const double half = scope.number("ridge_half_width"), off = scope.number("ridge_off");
  const auto within = [=](double v, double s, double times) {
    return std::abs(v) <= times * restV && std::abs(s) <= times * restS;
  };
  const Window rest = [=](double v, double s) { return within(v, s, 1.0); };
  const Window beside = [=](double v, double s) { return within(v, s, 3.0) && !within(v, s, 1.0); };
  // Away from rest and up to the wheel's own speed.
  const auto stripe = [=](double v, double distance) {
    return v > 2.0 * restV && v < 1.0 && std::abs(distance) <= half;
  };
  const Window ridge = [=](double v, double s) { return stripe(v, v - 1.0 - s); };
  const Window besideRidge = [=](double v, double s) {
    return stripe(v, std::abs(v - 1.0 - s) - off);
  };
  evidence.mean("rest", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(densityIn(jointOf(at), rest), densityIn(jointOf(at), beside));
  });
  evidence.mean("ridge", set, [=](const LegRun& at) -> std::optional<Measured> {
    return over(densityIn(jointOf(at), ridge), densityIn(jointOf(at), besideRidge));
  });
  // The window is the same in all runs: its density goes as its share.
  evidence.trend("rest_with_density", set, [=](const LegRun& at) -> std::optional<Measured> {
    return densityIn(jointOf(at), rest);
  });
  evidence.mean("second_peak", set, peakOver({0.42, 0.58}, {0.18, 0.34}));
  evidence.mean("peak_at_one", set, peakOver({0.94, 1.06}, {0.78, 0.90}));
}

void judgeContactDirections(const ClaimScope& scope, Evidence& evidence) {
  const RunSet set = scope.at(scope.number("label"));
  const double window = scope.number("window");
  evidence.mean("tangential", set, inBandNear(pi / 2.0, window));
  evidence.mean("shear_side", set, inBandNear(pi / 6.0, window));
  evidence.mean("other_side", set, inBandNear(5.0 * pi / 6.0, window));
  evidence.mean("homogeneous", set, [](const LegRun& at) -> std::optional<Measured> {
    return over(meanOfBoth(Directions(at, ringNear(at, 8.0)).anisotropy(),
                           Directions(at, ringNear(at, 12.0)).anisotropy()),
                Directions(at, ringNear(at, 0.5)).anisotropy());
  });
  evidence.mean("outer_lattice", set, [=](const LegRun& at) -> std::optional<Measured> {
    const Directions outer = outermost(at);
    std::optional<double> least;
    for (const double angle : {-pi / 6.0, pi / 6.0, pi / 2.0}) {
      const auto density = outer.near(angle, window);
      if (!density) return std::nullopt;
      least = std::min(least.value_or(*density), *density);
    }
    return least;
  });
  evidence.mean("outer_symmetry", set, [=](const LegRun& at) -> std::optional<Measured> {
    const Directions outer = outermost(at);
    return over(outer.near(-pi / 6.0, window), outer.near(pi / 6.0, window));
  });
}

}  // namespace crossgrain::inline runs
