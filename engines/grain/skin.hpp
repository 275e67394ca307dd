#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

namespace grain {

struct PairCounts {
  std::size_t touching = 0, near = 0, far = 0;
};

/// How far the two levels of the Verlet lists reach, tuned to the costs that the run measures.
///
/// Near pairs are chosen for a horizon of K steps, at a cost R, and each costs W a step. Gaps pile
/// up near zero: the number n of pairs that are near without touching grows about as K^0.3. So
///   C(K) = R/K + W n(K)  is least where  K = R/(0.3 W n).
/// A rebuild costs B and a step takes up v of the skin s, in which there are n' far pairs per
/// length, each at a cost r = R per far pair when near ones are chosen:
///   C(s) = B v/s + r n' s/K  is least where  s = √(B v K/(r n')).
/// Times differ from run to run; results depend neither on the horizon nor on the skin.
class Skin {
 public:
  /// @param skin  fixed [m]; 0: tuned, beginning with three tenths of the radius
  Skin(double skin, double smallestRadius);

  double skin() const { return skin_; }
  double horizon() const { return horizon_; }  ///< K [steps]
  std::size_t rebuilds() const { return rebuilds_; }
  std::size_t refreshes() const { return refreshes_; }

  void beginUpdate(std::size_t stepsSince);
  /// From here on the tuned skin holds.
  void beginRebuild();
  void endRebuild();
  void endRefresh(const PairCounts& pairs);
  void pairsTook(double seconds, std::size_t pairs);

  /// How far each body may be from where near pairs were chosen: what it would travel within the
  /// horizon, with room for it to become faster. A quarter of the skin is the most that a list just
  /// built could grant. @param travel  of each in a step [m]
  void allow(std::span<const double> travel, std::vector<double>& allowance) const;

  /// @param used  of the skin since the rebuild [m]
  void tune(const PairCounts& pairs, double used);

 private:
  using Clock = std::chrono::steady_clock;

  bool fixed_;
  double radius_;
  double skin_, nextSkin_;
  double horizon_ = 8.0;
  std::size_t rebuilds_ = 0, refreshes_ = 0, stepsSinceRebuild_ = 0;
  Clock::time_point began_{};
  double rebuildTime_ = 0.0, refreshTime_ = 0.0, pairTime_ = 0.0;
};

}  // namespace grain
