#pragma once

// Rigid contacts in place of a scene's law: a friction coefficient, and a restitution for each
// pair.

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "crossgrain_worker.hpp"

namespace crossgrain_worker {

constexpr double pi = 3.14159265358979323846;

class RigidLaw {
 public:
  RigidLaw() = default;
  /// @throws Unsupported for laws whose restitution depends on speed
  explicit RigidLaw(const Json& law) {
    const std::string normal = law.at("normal");
    soft_ = normal == "linear";
    if (!soft_ && normal != "rigid")
      throw Unsupported(
          "has rigid contacts, normal = \"rigid\"; they can stand for normal = \"linear\", whose "
          "restitution is the same at every speed");
    gn_ = law.at("gn");
    if (soft_ && gn_ > 0.0 && law.at("damper") != "constant")
      throw Unsupported("can stand in for a linear law with damper = \"constant\" only");
    en_ = law.at("en");
    if (!soft_ && law.at("et0") != 0.0)
      throw Unsupported("has no tangential restitution, so it needs et0 = 0");
    kn_ = law.at("kn");
    cut_ = law.at("tension") == "cut";
    if (law.value("rolling", "none") == "constant_torque") {
      rolling_ = law.at("mu_r");
      rollingLength_ = law.value("rolling_length", "effective");
    }
    friction_ = soft_ && law.at("tangential") == "none" ? 0.0 : law.at("mu").get<double>();
  }

  bool soft() const { return soft_; }
  double friction() const { return friction_; }
  /// µ_r, of M = −µ_r L N sign(ω_r); of any other law that resists rolling 0.
  double rolling() const { return rolling_; }
  /// L of two radii, a plane's being infinite [m].
  double rollingLength(double a, double b) const {
    const double effective = std::isinf(b) ? a : a * b / (a + b);
    if (rollingLength_ == "twice_effective") return 2.0 * effective;
    if (rollingLength_ == "effective" || std::isinf(b)) return effective;
    return rollingLength_ == "mean_radius" ? 0.5 * (a + b) : std::fmin(a, b);
  }
  bool damps() const { return soft_ ? gn_ > 0.0 : en_ < 1.0; }

  /// @param inverseMass  1/m₁ + 1/m₂, a wall's being 0 [1/kg]
  ///
  /// Of f = k_n δ − γ_n v_n: exp(−β t_c), β = γ_n/(2 m₁₂), ω² = k_n/m₁₂ − β². The contact ends when
  /// the bodies part, ω t_c = π, or, where tension is cut, when the force does (Schwager and
  /// Pöschel, Granular Matter 9 (2007) 465).
  double restitution(double inverseMass) const {
    if (!soft_) return en_;
    const double beta = 0.5 * gn_ * inverseMass, squared = kn_ * inverseMass - beta * beta;
    if (!(squared > 0.0))
      throw Unsupported("has rigid contacts, which stand for no law that is overdamped");
    const double omega = std::sqrt(squared);
    const double phase = cut_ ? std::atan2(2.0 * beta * omega, beta * beta - squared) : pi;
    return std::exp(-beta * phase / omega);
  }

 private:
  bool soft_ = false, cut_ = false;
  double kn_ = 0.0, gn_ = 0.0, en_ = 1.0, friction_ = 0.0, rolling_ = 0.0;
  std::string rollingLength_;
};

}  // namespace crossgrain_worker
