#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "adapters/audit_geometry.hpp"

namespace crossgrain {
namespace {

/// What a law makes of one contact, worked out here and nowhere else: an engine's own code is no
/// witness of itself.
struct ElasticPart {
  double force;       ///< f_el(δ) [N]
  double stiffness;   ///< f_el′(δ) [N/m]
  double tangential;  ///< k_t(δ) [N/m]
};

/// @param reducedRadius  R₁₂ [m]
ElasticPart elasticPart(const ContactLaw& law, double overlap, double reducedRadius) {
  const double depth = std::max(overlap, 0.0);
  switch (law.normal) {
    case NormalLaw::linear:
      return {law.kn * overlap, law.kn, law.kt};
    case NormalLaw::hertz: {
      const double root = std::sqrt(reducedRadius * depth);
      return {law.kn * root * depth, 1.5 * law.kn * root, law.kt * root};
    }
    case NormalLaw::polynomial:
      return {(law.kn + law.kn3 * depth) * depth * depth,
              (2.0 * law.kn + 3.0 * law.kn3 * depth) * depth, law.kt};
    case NormalLaw::rigid:
      break;
  }
  return {0.0, 0.0, 0.0};
}

double damping(Damper damper, double constant, double stiffness, double reducedMass) {
  if (damper == Damper::constant) return constant;
  if (damper == Damper::viscoelastic) return constant * stiffness;
  return constant * std::sqrt(reducedMass * stiffness);
}

/// At most, of a body's point that far from its centre [m/s²].
double acceleration(const Motion& motion, double arm) {
  if (motion.kind == Motion::Kind::rotating)
    return motion.angularVelocity * motion.angularVelocity * arm;
  if (motion.kind == Motion::Kind::oscillating)
    return motion.frequency * motion.frequency * motion.amplitude.norm();
  return 0.0;
}

constexpr double stepsOfDoubt = 1.5;

/// How far the velocities of the law may be from those shown, by body [m/s]: of its centre, and of
/// its rim by its spin. Schemes show velocities of up to a step and a half from those that dashpots
/// see; forces change them by the sum on a disk meanwhile, and hardly change in a step themselves:
/// a tenth of each, at 50 steps in a contact. Walls move as prescribed.
struct VelocityDoubt {
  std::vector<double> centre, rim;

  VelocityDoubt(const Snapshot& snapshot, const AuditBasis& basis)
      : centre(basis.radius.size() + basis.scene->planeCount()), rim(centre.size()) {
    constexpr double change = 0.1;
    const Scene& scene = *basis.scene;
    const Contacts& contacts = *snapshot.contacts;
    std::vector<Vec2> sum(centre.size(), Vec2::Zero());
    std::vector<double> sizes(centre.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Vec2 force = contacts.force(k);
      for (const auto& [id, sign] : {std::pair(contacts.i[k], 1.0), {contacts.j[k], -1.0}}) {
        sum[static_cast<std::size_t>(id)] += sign * force;
        sizes[static_cast<std::size_t>(id)] += force.norm();
      }
    }
    const double plate = scene.bottom ? scene.bottom->mu * scene.bottom->gravity : 0.0;
    for (std::size_t i = 0; i < scene.disks.size(); ++i) {
      const double radius = scene.disks.radius[i], mass = scene.disks.mass[i];
      const double lapse = stepsOfDoubt * basis.dt;
      centre[i] =
          lapse * ((sum[i].norm() + change * sizes[i]) / mass + scene.gravity.norm() + plate);
      rim[i] = lapse * sizes[i] * radius * radius / scene.disks.inertia[i];
    }
  }
};

/// Everything about one contact that its forces are compared with.
struct ContactKinematics {
  PairPlace place;
  double radius;    ///< R₁₂ [m]
  double mass;      ///< m₁₂ [kg]
  double approach;  ///< v_n as shown [m/s]
  double slip;      ///< at most, |v_t| [m/s]
  double doubt;     ///< of v_n [m/s]
};

ContactKinematics kinematicsOf(const Snapshot& snapshot, const AuditBasis& basis,
                               const ContactPlaces& places, const VelocityDoubt& doubts,
                               std::size_t k) {
  const Scene& scene = *basis.scene;
  const Contacts& contacts = *snapshot.contacts;
  const auto i = static_cast<std::size_t>(contacts.i[k]);
  const auto j = static_cast<std::size_t>(contacts.j[k]);
  const std::size_t disks = scene.disks.size(), round = basis.radius.size();
  ContactKinematics touch{};
  touch.place = pairPlace(places, basis, i, j);
  const double own = basis.radius[i];
  touch.radius = j < round ? own * basis.radius[j] / (own + basis.radius[j]) : own;
  const double mass = scene.disks.mass[i];
  touch.mass = j < disks ? mass * scene.disks.mass[j] / (mass + scene.disks.mass[j]) : mass;
  const Vec2 relative = places.velocity[i] - velocityOfSecond(places, basis, i, j);
  touch.approach = relative.dot(contacts.normal[k]);
  const auto rimSpeed = [&](std::size_t id) {
    return snapshot.spin && id < disks ? std::abs((*snapshot.spin)[id]) * basis.radius[id] : 0.0;
  };
  touch.slip = relative.norm() + rimSpeed(i) + rimSpeed(j) + doubts.rim[i] + doubts.rim[j];
  if (j >= disks && j < round) touch.slip += basis.fastest;  // rims of wall disks
  touch.doubt = doubts.centre[i] + doubts.centre[j];
  if (j >= round) {
    const PlacedPlane& wall = places.planes[j - round];
    const Vec2 arm = footOn(wall.plane, places.position[i]) - wall.motion.centre;
    touch.doubt += stepsOfDoubt * basis.dt * acceleration(wall.body->motion, arm.norm());
  }
  return touch;
}

std::string normalFault(double found, const ContactLaw& law, const ContactKinematics& touch,
                        double relative) {
  const ElasticPart elastic = elasticPart(law, touch.place.overlap, touch.radius);
  const double gn = damping(law.damper, law.gn, elastic.stiffness, touch.mass);
  double force = elastic.force - gn * touch.approach;
  if (law.conventions.tension == Tension::cut) force = std::max(force, 0.0);
  const double allowed = relative * (std::abs(elastic.force) + gn * std::abs(touch.approach)) +
                         elastic.stiffness * touch.place.uncertain + gn * touch.doubt;
  if (std::abs(found - force) <= allowed) return {};
  return fmt::format(
      "f_n is {:.6g} N, by the law {:.6g} N from an overlap of {:.3g} m (to within "
      "{:.2g} N)",
      found, force, touch.place.overlap, allowed);
}

std::string tangentialFault(double normal, double found, const ContactLaw& law,
                            const ContactKinematics& touch, double relative) {
  const bool friction = law.tangential != TangentialLaw::none && law.mu > 0.0;
  const bool anyway = law.conventions.coulombBound != CoulombBound::compression;
  double bound = !friction ? 0.0 : law.mu * (anyway ? std::abs(normal) : std::max(normal, 0.0));
  const ElasticPart elastic = elasticPart(law, touch.place.overlap, touch.radius);
  if (friction && law.tangential == TangentialLaw::springDashpot &&
      law.conventions.dashpot == Dashpot::outside)
    bound +=
        damping(law.damper, law.gt, elastic.tangential, touch.mass) * (touch.slip + touch.doubt);
  const double allowed =
      bound * (1.0 + relative) + relative * (std::abs(elastic.force) + std::abs(normal));
  if (std::abs(found) <= allowed) return {};
  return fmt::format("|f_t| is {:.6g} N, the law allows {:.6g} N at f_n = {:.6g} N",
                     std::abs(found), bound, normal);
}

}  // namespace

std::string lawFault(const Snapshot& snapshot, const AuditBasis& basis, const ContactLaw& law) {
  if (!snapshot.contacts || snapshot.contactInterval > 1.5 * basis.dt) return {};
  const Contacts& contacts = *snapshot.contacts;
  const ContactPlaces places = contactPlaces(snapshot, basis);
  const VelocityDoubt doubts(snapshot, basis);
  const double relative = basis.rounding > 1e-8 ? 1e-5 : 1e-9;  // of forces, by precision
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double fn = contacts.normalForce[k], ft = contacts.tangentialForce[k];
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= basis.radius.size() && !places.planes[j - basis.radius.size()].known) continue;
    std::string why;
    if (!law.soft()) {
      if (fn < 0.0) why = fmt::format("f_n is {:.6g} N: rigid disks do not pull", fn);
    } else {
      const ContactKinematics touch = kinematicsOf(snapshot, basis, places, doubts, k);
      why = normalFault(fn, law, touch, relative);
      if (why.empty()) why = tangentialFault(fn, ft, law, touch, relative);
    }
    if (!why.empty()) return fmt::format("{}: {}", contactName(contacts, k, *basis.scene), why);
  }
  return {};
}

}  // namespace crossgrain
