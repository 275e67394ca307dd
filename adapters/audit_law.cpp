#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/law_options.hpp"
#include "adapters/near_pairs.hpp"

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

/// A range of forces where the law has a memory that nobody shows.
struct Attraction {
  double least, most;    ///< that is added to f_el [N]
  double stiffness;      ///< |its derivative| [N/m]
  double pullOff = 0.0;  ///< F_po [N]
};

/// @param reach  a_i + a_j, at a plane 0 [m]
Attraction attraction(const ContactLaw& law, double overlap, double radius, double reach) {
  using std::numbers::pi;
  const double elastic = elasticPart(law, overlap, radius).force;
  switch (law.cohesion) {
    case CohesionLaw::area: {
      const double round = 2.0 * pi * radius;  // A′(0)
      double area = round * overlap;
      if (law.conventions.cohesionArea == CohesionArea::twiceBetweenDisks && reach > 0.0)
        area *= 2.0;
      if (law.conventions.cohesionArea == CohesionArea::lens) {
        // The lens of two spheres: π h² with h² = a_i² − x², x from the centre of i to its plane.
        const double a =
            reach > 0.0 ? 0.5 * (reach + std::sqrt(std::max(reach * (reach - 4.0 * radius), 0.0)))
                        : radius;
        const double d = reach - overlap, b = reach - a;
        const double x = reach > 0.0 ? (d * d + a * a - b * b) / (2.0 * d) : radius - overlap;
        area = pi * (a * a - x * x);
      }
      return {-law.kc * area, -law.kc * area, 2.0 * law.kc * round};
    }
    case CohesionLaw::dmt: {
      const double pull = 2.0 * pi * law.w * radius;
      return {-pull, -pull, 0.0, pull};
    }
    case CohesionLaw::jkr: {
      // F/F_po = x³ − 2 x^1.5, δ R/a_p² = x² − 4/3 √x, x = a/a_p, by bisection.
      const double width = std::cbrt(1.5 * pi * law.w * radius * radius / law.kn);
      const double wanted = overlap * radius / (width * width), pull = 1.5 * pi * law.w * radius;
      double low = 1.0 / std::cbrt(9.0), high = 2.0 + 2.0 * std::sqrt(std::max(wanted, 0.0));
      for (int k = 0; k < 100; ++k) {
        const double x = 0.5 * (low + high);
        (x * x - 4.0 / 3.0 * std::sqrt(x) < wanted ? low : high) = x;
      }
      const double force = pull * (low * low * low - 2.0 * std::pow(low, 1.5)) - elastic;
      // dF/dδ; it has no bound at the end of the branch.
      const double slope = 2.0 * low - 2.0 / 3.0 / std::sqrt(low);
      const double stiffness = pull * (3.0 * low * low - 3.0 * std::sqrt(low)) /
                               std::max(slope, 1e-3) * radius / (width * width);
      return {force, force, std::abs(stiffness), pull};
    }
    case CohesionLaw::elastoPlastic: {  // between loading, beyond δ* with kUnload, and the pull
      const double depth = std::max(overlap, 0.0), most = law.kUnload - law.kn;
      const double beyond = law.plasticDepth > 0.0
                                ? most * depth - law.kUnload * law.plasticDepth * 2.0 * radius
                                : 0.0;
      return {-(law.kc + law.kn) * depth, std::max(beyond, 0.0), law.kUnload + law.kc};
    }
    case CohesionLaw::none:
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
template <int D>
double acceleration(const MotionOf<D>& motion, double arm) {
  if (motion.kind == MotionKind::rotating)
    return sizeOf(motion.angularVelocity) * sizeOf(motion.angularVelocity) * arm;
  if (motion.kind == MotionKind::oscillating)
    return motion.frequency * motion.frequency * motion.amplitude.norm();
  return 0.0;
}

/// m₁₂, of a wall that of i [kg].
template <int D>
double reducedMass(const SceneOf<D>& scene, std::size_t i, std::size_t j) {
  const double mass = scene.disks.mass[i];
  return j < scene.disks.size() ? mass * scene.disks.mass[j] / (mass + scene.disks.mass[j]) : mass;
}

/// The law of that pair with the options of `law`, as the engine runs them.
template <int D>
ContactLaw ownLaw(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j,
                  const ContactLaw& law) {
  if (!basis.scene->materials) return law;
  ContactLaw own = basis.scene->lawOf(i, j);
  for (const LawOption& option : lawOptions()) option.set(own, option.get(law));
  return own;
}

/// Pairs by their first: each has few, whose list is looked through faster than a tree.
class ListedPairs {
 public:
  template <int D>
  ListedPairs(const ContactsOf<D>& contacts, std::size_t bodies)
      : begin_(bodies + 1), second_(contacts.size()) {
    for (const std::int32_t i : contacts.i) ++begin_[static_cast<std::size_t>(i) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      second_[next[static_cast<std::size_t>(contacts.i[k])]++] = contacts.j[k];
  }
  bool contains(std::size_t i, std::size_t j) const {
    const auto at = [&](std::size_t k) {
      return second_.begin() + static_cast<std::ptrdiff_t>(begin_[k]);
    };
    return std::find(at(i), at(i + 1), static_cast<std::int32_t>(j)) != at(i + 1);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::int32_t> second_;
};

constexpr double stepsOfDoubt = 1.5;

/// How far the velocities of the law may be from those shown, by body [m/s]: of its centre, and of
/// its rim by its spin. Schemes show velocities of up to a step and a half from those that dashpots
/// see; forces change them by the sum on a disk meanwhile, and each force by a tenth, at 50 steps
/// in a contact, or by what the overlap changed, where a pull leaves little of a large force. But a
/// dashpot's force and a bond's begin and end with a jump: what began or ended meanwhile counts as
/// a whole. Walls move as prescribed.
template <int D>
struct VelocityDoubt {
  std::vector<double> centre, rim;

  VelocityDoubt(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                const ContactPlacesOf<D>& places, const ContactLaw& law)
      : centre(basis.scene->idCount()), rim(centre.size()), lapse_(stepsOfDoubt * basis.dt) {
    constexpr double change = 0.1;
    const SceneOf<D>& scene = *basis.scene;
    const ContactsOf<D>& contacts = *snapshot.contacts;
    std::vector<VecOf<D>> sum(centre.size(), VecOf<D>::Zero());
    std::vector<double> sizes(centre.size()), changes(centre.size());
    const ListedPairs shown(contacts, centre.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto i = static_cast<std::size_t>(contacts.i[k]);
      const auto j = static_cast<std::size_t>(contacts.j[k]);
      const VecOf<D> force = contacts.force(k);
      const double size = force.norm();
      const bool began = isWithin(contacts.overlap[k], size, places, basis, i, j);
      const double much =
          began ? size
                : std::max(change * size, changeWithin(ownLaw(basis, i, j, law),
                                                       contacts.overlap[k], places, basis, i, j));
      for (const auto& [id, sign] : {std::pair(i, 1.0), {j, -1.0}}) {
        sum[id] += sign * force;
        sizes[id] += size;
        changes[id] += much;
      }
    }
    const auto addEnded = [&](std::size_t i, std::size_t j) {
      if (shown.contains(i, j)) return;
      const double last = lastForce(ownLaw(basis, i, j, law), places, basis, i, j);
      for (const std::size_t id : {i, j}) changes[id] += last;
    };
    const std::size_t disks = scene.disks.size(), round = basis.radius.size();
    if (std::ranges::all_of(places.position,
                            [](const VecOf<D>& place) { return place.allFinite(); }))
      nearPairs<D>(places.position, basis.radius, disks, scene.box, addEnded);
    for (std::size_t p = 0; p < places.planes.size(); ++p)
      for (std::size_t i = 0; i < disks && places.planes[p].known; ++i) addEnded(i, round + p);

    double plate = 0.0;
    if constexpr (D == 2)
      if (scene.bottom) plate = scene.bottom->mu * scene.bottom->gravity;
    for (std::size_t i = 0; i < disks; ++i) {
      const double radius = scene.disks.radius[i], mass = scene.disks.mass[i];
      centre[i] = lapse_ * ((sum[i].norm() + changes[i]) / mass + scene.gravity.norm() + plate);
      rim[i] = lapse_ * sizes[i] * radius * radius / scene.disks.inertia[i];
    }
  }

 private:
  /// Whether two cover that way within the lapse, at the speed that they have or had before a force
  /// of that size changed it.
  bool isWithin(double way, double force, const ContactPlacesOf<D>& places,
                const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const {
    const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
    const double speed = relative.norm() + lapse_ * force / reducedMass(*basis.scene, i, j);
    return way >= 0.0 && way <= lapse_ * speed;
  }

  /// By how much the lapse changes an elastic force and a pull [N].
  double changeWithin(const ContactLaw& law, double overlap, const ContactPlacesOf<D>& places,
                      const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const {
    const double radius = reducedRadius<D>(basis, i, j);
    const double reach = j < basis.radius.size() ? basis.radius[i] + basis.radius[j] : 0.0;
    const VecOf<D> relative = places.velocity[i] - velocityOfSecond<D>(places, basis, i, j);
    return (elasticPart(law, overlap, radius).stiffness +
            attraction(law, overlap, radius, reach).stiffness) *
           relative.norm() * lapse_;
  }

  /// At most, of a contact of the two that ended within the lapse, 0 if none can have [N].
  double lastForce(const ContactLaw& law, const ContactPlacesOf<D>& places,
                   const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const {
    const PairPlaceOf<D> place = pairPlace<D>(places, basis, i, j);
    const double radius = reducedRadius<D>(basis, i, j);
    const double separating =
        (places.velocity[i] - velocityOfSecond<D>(places, basis, i, j)).dot(place.normal);
    const double reach = j < basis.radius.size() ? basis.radius[i] + basis.radius[j] : 0.0;
    const double mass = reducedMass(*basis.scene, i, j);
    const bool pulls = law.conventions.tension == Tension::allow;
    const double dashpot =
        pulls ? damping(law.damper, law.gn, elasticPart(law, 0.0, radius).stiffness, mass) : 0.0;
    double last = dashpot * std::max(separating, 0.0);
    if (law.coheres()) last += attraction(law, 0.0, radius, reach).pullOff;
    last *= 1.0 + law.mu;
    const double gap = -place.overlap - bondReach(law, radius);
    return isWithin(gap + place.uncertain, last, places, basis, i, j) ? last : 0.0;
  }

  double lapse_;
};

/// Everything about one contact that its forces are compared with.
struct ContactKinematics {
  double overlap;        ///< δ worked out from places [m]
  double uncertain;      ///< how far that may be off [m]
  double radius;         ///< R₁₂ [m]
  double reach;          ///< a_i + a_j, at a plane 0 [m]
  double smallerRadius;  ///< [m]
  double mass;           ///< m₁₂ [kg]
  double approach;       ///< v_n as shown [m/s]
  double slip;           ///< at most, |v_t| [m/s]
  double doubt;          ///< of v_n [m/s]
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
  const double own = basis.radius[i];
  touch.reach = j < round ? own + basis.radius[j] : 0.0;
  touch.smallerRadius = j < round ? std::min(own, basis.radius[j]) : own;
  touch.radius = reducedRadius<D>(basis, i, j);
  touch.elastic = elasticPart(law, touch.overlap, touch.radius);
  touch.pull = attraction(law, touch.overlap, touch.radius, touch.reach);
  touch.mass = reducedMass(scene, i, j);
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
  const double gn = damping(law.damper, law.gn, elastic.stiffness, touch.mass);
  const auto forceAt = [&](double attractive) {
    const double body = elastic.force + attractive, force = body - gn * touch.approach;
    return law.conventions.tension == Tension::cut ? std::max(force, std::min(body, 0.0)) : force;
  };
  const double least = forceAt(pull.least), most = forceAt(pull.most);
  // Change of the force over the overlap's uncertainty: Hertz' slope at δ = 0 is 0.
  const auto elasticAt = [&](double change) {
    return elasticPart(law, touch.overlap + change, touch.radius);
  };
  const ElasticPart deeper = elasticAt(touch.uncertain);
  const double unsure =
      std::max(deeper.force - elastic.force, elastic.force - elasticAt(-touch.uncertain).force);
  const double unsureDamping = damping(law.damper, law.gn, deeper.stiffness, touch.mass) - gn;
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

/// What stands for f_n in the bounds of sliding and rolling, at most [N].
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
    bound +=
        damping(law.damper, law.gt, elastic.tangential, touch.mass) * (touch.slip + touch.doubt);
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
  double length = touch.radius;
  if (how.rollingLength == RollingLength::twiceEffective) length *= 2.0;
  if (how.rollingLength == RollingLength::smallerRadius) length = touch.smallerRadius;
  if (how.rollingLength == RollingLength::meanRadius)
    length = touch.reach > 0.0 ? 0.5 * touch.reach : touch.radius;
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
