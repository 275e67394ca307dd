#include "cases/scene_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace crossgrain::inline cases {
namespace {

/// The size of a vector, of components whose squares may have no room in a double.
double sizeOf(double x) {
  return std::abs(x);
}
template <typename Vector>
double sizeOf(const Vector& x) {
  return x.stableNorm();
}

template <int D>
class NumberCheck {
 public:
  explicit NumberCheck(const SceneOf<D>& scene) : scene_(scene) {
    diameter_ = 2.0 * std::ranges::min(scene.disks.radius);
  }

  std::string fault() {
    checkPlaces();
    for (std::size_t i = 0; why_.empty() && i < scene_.disks.size(); ++i) checkDisk(i);
    for (const WallBodyOf<D>& body : scene_.bodies)
      if (why_.empty()) checkMotion(body);
    const double g = sizeOf(scene_.gravity);
    checkStep(g * scene_.dt * scene_.dt, [&] { return fmt::format("gravity of {:g} m/s²", g); });
    return why_;
  }

 private:
  using Name = std::function<std::string()>;

  static constexpr int farthest = 10, farthestInStep = 4;  ///< 10^k smallest diameters

  static constexpr const char* kind = D == 2 ? "disk" : "sphere";

  void checkPlace(const VecOf<D>& place, const Name& who) {
    const double reach = std::pow(10.0, farthest) * diameter_;
    for (int k = 0; why_.empty() && k < D; ++k)
      if (!(std::abs(place[k]) <= reach))
        why_ = fmt::format(
            ": {} is at {} = {:.4g} m: beyond {:.4g} m, 10^{} diameters of the smallest {}, no "
            "number resolves a contact",
            who(), "xyz"[k], place[k], reach, farthest, kind);
  }

  void checkPlaces() {
    std::size_t id = 0;
    const auto look = [&](const std::vector<VecOf<D>>& places) {
      for (const VecOf<D>& place : places) {
        checkPlace(place, [&] { return nameOfId(scene_, id); });
        ++id;
      }
    };
    look(scene_.disks.position);
    for (const WallBodyOf<D>& body : scene_.bodies) look(body.diskPosition);
    for (const WallBodyOf<D>& body : scene_.bodies) {
      for (const PlaneOf<D>& plane : body.planes)
        checkPlace(plane.point, [] { return "a plane's point"; });
      if constexpr (D == 3)
        for (const Cylinder& cylinder : body.cylinders)
          checkPlace(cylinder.point, [] { return "the point of a cylinder"; });
    }
    for (int k = 0; scene_.box && k < D; ++k) {
      if (!scene_.box->periodic[static_cast<std::size_t>(k)]) continue;
      for (const VecOf<D>& corner : {scene_.box->low, scene_.box->high})
        checkPlace(VecOf<D>::Unit(k) * corner[k], [] { return "a side of the periodic box"; });
    }
  }

  /// @param way  that something goes in a step [m]
  void checkStep(double way, const Name& what) {
    const double most = std::pow(10.0, farthestInStep) * diameter_;
    if (!why_.empty() || way <= most) return;
    why_ = fmt::format(
        ": {} is a way of {:.4g} m in a step of {:.3g} s: beyond {:.4g} m, 10^{} diameters of the "
        "smallest {}, nothing is met on it",
        what(), way, scene_.dt, most, farthestInStep, kind);
  }

  void checkDisk(std::size_t i) {
    const DisksOf<D>& disks = scene_.disks;
    const Name name = [&] { return nameOfId(scene_, i); };
    const auto weighs = [&](double value, const char* what, const char* unit) {
      if (why_.empty() && !std::isnormal(value))
        why_ = fmt::format(": the {} of {} is {:g} {}: no number holds it and its reciprocal", what,
                           name(), value, unit);
    };
    const double mass = disks.mass[i], inertia = disks.inertia[i];
    const double radius = disks.radius[i];
    weighs(radius * radius * radius, "cube of the radius", "m³");
    weighs(mass, "mass", "kg");
    weighs(inertia, "moment of inertia", "kg m²");
    const double v = sizeOf(disks.velocity[i]), spin = sizeOf(disks.spin[i]);
    checkStep(v * scene_.dt,
              [&] { return fmt::format("a velocity of {:g} m/s of {}", v, name()); });
    checkStep(spin * radius * scene_.dt,
              [&] { return fmt::format("a spin of {:g} rad/s of {}", spin, name()); });
    const ContactLaw& law = scene_.law;
    if (law.tangential == TangentialLaw::coulomb && law.normal == NormalLaw::linear)
      checkStep(law.mu * law.kn * v * std::pow(scene_.dt, 3) / mass,  // µ k_n δ dt²/m, δ = |v| dt
                [&] { return fmt::format("friction of µ = {:g} on {}", law.mu, name()); });
    energy_ += 0.5 * mass * v * v + 0.5 * inertia * spin * spin;
    if (why_.empty() && !std::isfinite(energy_))
      why_ = fmt::format(": no number holds the kinetic energy of {}", name());
  }

  void checkMotion(const WallBodyOf<D>& body) {
    const MotionOf<D>& motion = body.motion;
    const double fastest =
        std::max({sizeOf(motion.velocity), sizeOf(motion.amplitude) * std::abs(motion.frequency),
                  std::abs(motion.radialVelocity)});
    checkStep(fastest * scene_.dt,
              [&] { return fmt::format("a velocity of {:g} m/s of {}", fastest, body.name); });
    const double spin = sizeOf(motion.angularVelocity);
    for (const VecOf<D>& place : body.diskPosition)
      checkStep(spin * (place - body.centre).norm() * scene_.dt,
                [&] { return fmt::format("a spin of {:g} rad/s of {}", spin, body.name); });
  }

  const SceneOf<D>& scene_;
  double diameter_ = 0.0;  ///< of the smallest disk [m]
  double energy_ = 0.0;    ///< of disks, up to now [J]
  std::string why_;
};

}  // namespace

template <int D>
std::string beyondNumbers(const SceneOf<D>& scene) {
  return scene.disks.size() == 0 ? std::string() : NumberCheck<D>(scene).fault();
}
template std::string beyondNumbers<2>(const Scene&);
template std::string beyondNumbers<3>(const SpaceScene&);

}  // namespace crossgrain::inline cases
