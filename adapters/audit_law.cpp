#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "adapters/audit_forces.hpp"

namespace crossgrain {
namespace {

/// At most, of a body's point that far from its centre [m/s²].
template <int D>
double acceleration(const MotionOf<D>& motion, double arm) {
  if (motion.kind == MotionKind::rotating)
    return sizeOf(motion.angularVelocity) * sizeOf(motion.angularVelocity) * arm;
  if (motion.kind == MotionKind::oscillating)
    return motion.frequency * motion.frequency * motion.amplitude.norm();
  return 0.0;
}

/// Everything about one contact that its forces are compared with.
struct ContactKinematics {
  double overlap;    ///< δ worked out from places [m]
  double uncertain;  ///< how far that may be off [m]
  CollidingPair pair;
  double approach;  ///< v_n as shown [m/s]
  double slip;      ///< at most, |v_t| [m/s]
  double doubt;     ///< of v_n [m/s]
  ElasticPart elastic;
  Attraction pull;
};

template <int D>
ContactKinematics kinematicsOf(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                               const ContactPlacesOf<D>& places, const VelocityDoubt<D>& doubts,
                               std::size_t k, const ContactLaw& law) {
  const SceneOf<D>& scene = *basis.scene;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const auto i = static_cast<std::size_t>(contacts.i[k]);
  const auto j = static_cast<std::size_t>(contacts.j[k]);
  const std::size_t disks = scene.disks.size(), round = basis.radius.size();
  ContactKinematics touch{};
  const PairPlaceOf<D> place = pairPlace<D>(places, basis, i, j);
  touch.overlap = place.overlap;
  touch.uncertain = place.uncertain;
  if (basis.shownOverlaps && contacts.overlap[k] > 0.0) {
    touch.overlap = contacts.overlap[k];
    touch.uncertain = std::min(
        touch.uncertain,
        std::max(basis.shownOverlaps->relative * touch.overlap, basis.shownOverlaps->place));
  }
  touch.pair = pairOf(basis, i, j);
  touch.elastic = elasticPart(law, touch.pair, touch.overlap);
  touch.pull = attraction(law, touch.pair, touch.overlap);
  const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
  touch.approach = relative.dot(contacts.normal[k]);
  const auto rimSpeed = [&](std::size_t id) {
    return snapshot.spin && id < disks ? sizeOf((*snapshot.spin)[id]) * basis.radius[id] : 0.0;
  };
  touch.slip = relative.norm() + rimSpeed(i) + rimSpeed(j) + doubts.rim[i] + doubts.rim[j];
  if (j >= disks && j < round) touch.slip += basis.fastest;  // rims of wall disks
  touch.doubt = doubts.centre[i] + doubts.centre[j];
  if (j >= round) {
    const PlacedPlaneOf<D>& wall = places.planes[j - round];
    const VecOf<D>& at = places.position[i];
    const VecOf<D> arm = footOn<D>(wall.under(at), at) - wall.motion.centre;
    touch.doubt += stepsOfDoubt * basis.dt * acceleration<D>(wall.body->motion, arm.norm());
  }
  return touch;
}

std::string normalFault(double found, const ContactLaw& law, const ContactKinematics& touch,
                        double relative) {
  const ElasticPart& elastic = touch.elastic;
  const Attraction& pull = touch.pull;
  const double gn = dampingOf(law.damper, law.gn, elastic.stiffness, touch.pair.reducedMass());
  const auto forceAt = [&](double attractive) {
    const double body = elastic.force + attractive, force = body - gn * touch.approach;
    return law.conventions.tension == Tension::cut ? std::max(force, std::min(body, 0.0)) : force;
  };
  const double least = forceAt(pull.least), most = forceAt(pull.most);
  // Change of the force over the overlap's uncertainty: Hertz' slope at δ = 0 is 0.
  const auto elasticAt = [&](double change) {
    return elasticPart(law, touch.pair, touch.overlap + change);
  };
  const ElasticPart deeper = elasticAt(touch.uncertain);
  const double unsure =
      std::max(deeper.force - elastic.force, elastic.force - elasticAt(-touch.uncertain).force);
  const double unsureDamping =
      dampingOf(law.damper, law.gn, deeper.stiffness, touch.pair.reducedMass()) - gn;
  const double allowed =
      relative * (std::abs(elastic.force) + std::abs(pull.least) + gn * std::abs(touch.approach)) +
      unsure + std::abs(unsureDamping * touch.approach) + pull.stiffness * touch.uncertain +
      gn * touch.doubt;
  if (found >= least - allowed && found <= most + allowed) return {};
  return fmt::format(
      "f_n is {:.6g} N, by the law {:.6g} N from an overlap of {:.3g} m (to within "
      "{:.2g} N)",
      found, found < least ? least : most, touch.overlap, allowed);
}

/// Largest possible load in the bounds of sliding and rolling, f_n without cohesion [N].
double loadOf(double normal, const ContactLaw& law, const ContactKinematics& touch) {
  if (!law.coheres() || law.conventions.cohesionLoad == CohesionLoad::net) return normal;
  const Attraction& pull = touch.pull;
  if (law.conventions.cohesionLoad == CohesionLoad::magnitudePlusPullOff)
    return std::abs(normal) + pull.pullOff;
  if (law.conventions.cohesionLoad == CohesionLoad::plusTwicePullOff ||
      law.conventions.cohesionLoad == CohesionLoad::netWithoutDashpot) {
    const double body = touch.elastic.force + pull.most;
    const bool plus = law.conventions.cohesionLoad == CohesionLoad::plusTwicePullOff;
    return plus ? body + 2.0 * pull.pullOff : body;
  }
  // An elasto-plastic contact keeps its load; where it pulls, the pull is left out.
  return law.cohesion == CohesionLaw::elastoPlastic
             ? std::max(normal, 0.0) + std::max(-pull.least, 0.0)
             : normal - pull.most;
}

std::string tangentialFault(double normal, double found, const ContactLaw& law,
                            const ContactKinematics& touch, double relative) {
  const bool friction = law.friction();
  const bool anyway = law.conventions.coulombBound != CoulombBound::compression;
  const double load = loadOf(normal, law, touch);
  double bound = !friction ? 0.0 : law.mu * (anyway ? std::abs(load) : std::max(load, 0.0));
  const ElasticPart& elastic = touch.elastic;
  if (friction && law.tangential == TangentialLaw::springDashpot &&
      law.conventions.dashpot == Dashpot::outside)
    bound += dampingOf(law.damper, law.gt, elastic.tangential, touch.pair.reducedMass()) *
             (touch.slip + touch.doubt);
  double allowed =
      bound * (1.0 + relative) + relative * (std::abs(elastic.force) + std::abs(normal));
  if (friction && law.coheres())  // what an uncertain overlap leaves open of the pull
    allowed += law.mu * touch.pull.stiffness * touch.uncertain;
  if (found <= allowed) return {};
  return fmt::format("|f_t| is {:.6g} N, the law allows {:.6g} N at f_n = {:.6g} N", found, bound,
                     normal);
}

/// Of laws that limit the torque: constant, and a spring that holds its dashpot to the bound too.
std::string rollingFault(double normal, double found, const ContactLaw& law,
                         const ContactKinematics& touch, double relative) {
  const LawConventions& how = law.conventions;
  const bool limited = law.rolling == RollingLaw::constantTorque ||
                       (law.rolling == RollingLaw::spring &&
                        (law.gr == 0.0 || how.rollingDashpot == Dashpot::inside));
  if (law.rolls() && !limited) return {};
  const double length = rollingLength(law, touch.pair);
  const ElasticPart& elastic = touch.elastic;
  const double load = loadOf(normal, law, touch);
  const double most = how.rollingLoad == RollingLoad::elastic     ? elastic.force
                      : how.rollingLoad == RollingLoad::magnitude ? std::abs(load)
                                                                  : std::max(load, 0.0);
  if (how.rollingLoad == RollingLoad::whileCompressed && most <= 0.0) return {};
  const double bound = law.rolls() ? law.muR * length * most : 0.0;
  const double unsure = (elastic.stiffness + touch.pull.stiffness) * touch.uncertain;
  const double allowed =
      bound * (1.0 + relative) + law.muR * length * (relative * std::abs(normal) + unsure);
  if (found <= allowed) return {};
  return fmt::format("the torque against rolling is {:.6g} N m, the law allows {:.6g} N m", found,
                     bound);
}

/// Forces of another unit are all off by the same power of ten: the median of f_n over that of the
/// law shows it, as dashpots on the whole do not.
template <int D>
std::string hintOfUnit(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                       const ContactPlacesOf<D>& places, const VelocityDoubt<D>& doubts,
                       const ContactLaw& ofAll) {
  const ContactsOf<D>& contacts = *snapshot.contacts;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= basis.radius.size() && !places.planes[j - basis.radius.size()].known) continue;
    const ContactLaw law = ownLaw(basis, i, j, ofAll);
    if (!law.soft()) continue;
    const ContactKinematics touch = kinematicsOf(snapshot, basis, places, doubts, k, law);
    const double byLaw = touch.elastic.force + touch.pull.most;
    if (byLaw > 10.0 * touch.elastic.stiffness * touch.uncertain)
      ratios.push_back(contacts.normalForce[k] / byLaw);
  }
  if (ratios.empty()) return {};
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  const double power = std::round(std::log10(*middle));
  constexpr double within = 0.1;  // of a power of ten: what dashpots leave of the median
  if (!(std::abs(*middle / std::pow(10.0, power) - 1.0) <= within) || power == 0.0) return {};
  return fmt::format(
      "; most normal forces are {:g} times those of the law: are they in another unit?",
      std::pow(10.0, power));
}

}  // namespace

template <int D>
std::string lawFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                     const ContactLaw& ofAll) {
  if (!snapshot.contacts || snapshot.contactInterval > 1.5 * basis.dt) return {};
  const ContactsOf<D>& contacts = *snapshot.contacts;
  const ContactPlacesOf<D> places = contactPlaces<D>(snapshot, basis);
  const VelocityDoubt<D> doubts(snapshot, basis, places, ofAll);
  const double relative = basis.rounding > 1e-8 ? 1e-5 : 1e-9;  // of forces, by precision
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double fn = contacts.normalForce[k], ft = sizeOf(contacts.tangentialForce[k]);
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= basis.radius.size() && !places.planes[j - basis.radius.size()].known) continue;
    const ContactLaw law = ownLaw(basis, i, j, ofAll);
    std::string why;
    if (!law.soft()) {
      if (fn < 0.0) why = fmt::format("f_n is {:.6g} N: rigid disks do not pull", fn);
    } else {
      const ContactKinematics touch = kinematicsOf(snapshot, basis, places, doubts, k, law);
      why = normalFault(fn, law, touch, relative);
      if (why.empty()) why = tangentialFault(fn, ft, law, touch, relative);
      if (why.empty() && !contacts.rollingTorque.empty())
        why = rollingFault(fn, sizeOf(contacts.rollingTorque[k]), law, touch, relative);
    }
    if (!why.empty())
      return fmt::format("{}: {}{}", contactName(contacts, k, *basis.scene), why,
                         hintOfUnit(snapshot, basis, places, doubts, ofAll));
  }
  return {};
}
template std::string lawFault(const Snapshot&, const AuditBasis&, const ContactLaw&);
template std::string lawFault(const SpaceSnapshot&, const AuditBasisOf<3>&, const ContactLaw&);

}  // namespace crossgrain
