#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "adapters/audit_geometry.hpp"
#include "adapters/near_pairs.hpp"

namespace crossgrain {
namespace {

constexpr double meansOverSteps = 1.5;  // a mean over more belongs to no positions

/// Checks of ids, pairs and normals, which need no positions.
template <int D>
std::string listFault(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis,
                      const ContactsByFirst& byFirst) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double square = contacts.normal[k].squaredNorm();
    // Normals are rounded where they are made, whatever the coordinates are: 10⁻⁵ is ten times the
    // error of single precision, and too small to matter to a stress.
    if (!(std::abs(square - 1.0) <= 2e-5))
      return fmt::format("{}: its normal has length {:.6g}, not 1",
                         contactName(contacts, k, *basis.scene), std::sqrt(square));
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    if (byFirst.count(contacts, i, static_cast<std::size_t>(contacts.j[k])) > 1)
      return fmt::format("{} is listed twice", contactName(contacts, k, *basis.scene));
  }
  return {};
}

/// Forces that can be: f_t is across the normal, and no force moves the mass of all disks together
/// by a hundred times the scene's extent within a step. Stable soft contacts move a disk of mass m
/// by f dt²/m ≤ 4 δ, impulses by what the fastest cover.
template <int D>
std::string forceFault(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis) {
  const double most =
      100.0 * basis.mass * (basis.extent + basis.fastest * basis.dt) / (basis.dt * basis.dt);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto name = [&] { return contactName(contacts, k, *basis.scene); };
    const double along = contacts.normalForce[k], across = sizeOf(contacts.tangentialForce[k]);
    if constexpr (D == 3) {
      // Of schemes that show f_t across the normal of a step before; 10⁻⁵ of f_n is single
      // precision's. Of contacts that just touch all of f_t may be what roundings of velocities,
      // ε v, leave: no dashpot makes more of these than ε m v/dt.
      const double lengthwise = contacts.tangentialForce[k].dot(contacts.normal[k]);
      const double kick = basis.dt > 0.0 ? basis.mass * basis.fastest / basis.dt : 0.0;
      const double rounded = std::numeric_limits<double>::epsilon() * kick;
      if (!(std::abs(lengthwise) <= 1e-2 * across + 1e-5 * std::abs(along) + rounded))
        return fmt::format("{}: {:.3g} N of its tangential force of {:.3g} N are along the normal",
                           name(), lengthwise, across);
    }
    if (basis.dt > 0.0 && !(std::abs(along) + across <= most))
      return fmt::format("{}: a force of {:.3g} N would throw all {} out of the scene in a step",
                         name(), std::max(std::abs(along), across),
                         basis.scene->shapes.empty() ? "disks" : "bodies");
  }
  return {};
}

template <int D>
std::string idsFault(const ContactsOf<D>& contacts, const SceneOf<D>& scene) {
  const auto disks = static_cast<std::int64_t>(scene.disks.size());
  const auto all = static_cast<std::int64_t>(scene.idCount());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::int64_t i = contacts.i[k], j = contacts.j[k];
    if (i < 0 || i >= disks || j <= i || j >= all)
      return fmt::format(
          "contact {} is of {} and {}: the first must be one of {} {}, the second "
          "a later id below {}",
          k, i, j, disks, scene.shapes.empty() ? "disks" : "bodies", all);
  }
  return {};
}

/// Of the pairs listed, as they are placed [m].
template <int D>
double deepestOverlap(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis,
                      const ContactPlacesOf<D>& places) {
  const std::size_t round = basis.radius.size();
  double deepest = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= round && !places.planes[j - round].known) continue;
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    deepest = std::max(deepest, pairPlace(places, basis, i, j).overlap);
  }
  return deepest;
}

/// Each contact that is listed, where its two are.
template <int D>
std::string placeFault(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis,
                       const ContactPlacesOf<D>& places) {
  const std::size_t round = basis.radius.size();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto i = static_cast<std::size_t>(contacts.i[k]);
    const auto j = static_cast<std::size_t>(contacts.j[k]);
    if (j >= round && !places.planes[j - round].known) continue;
    const PairPlaceOf<D> place = pairPlace(places, basis, i, j);
    if (!(std::abs(contacts.overlap[k] - place.overlap) <= place.uncertain))
      return fmt::format("{}: overlaps by {:.6g} m, from the positions by {:.6g} m",
                         contactName(contacts, k, *basis.scene), contacts.overlap[k],
                         place.overlap);
    const double turned = (contacts.normal[k] - place.normal).norm();
    if (!(turned * place.distance <= place.uncertain + 1e-5 * place.distance))
      return fmt::format("{}: its normal is ({:.4f}), from the positions ({:.4f})",
                         contactName(contacts, k, *basis.scene),
                         fmt::join(contacts.normal[k], ", "), fmt::join(place.normal, ", "));
    const bool pushes =
        contacts.normalForce[k] != 0.0 || contacts.tangentialForce[k] != noSpin<D>();
    if (pushes && place.overlap < -place.uncertain - bondRange(basis.scene->lawOf(i, j),
                                                               pairOf(basis, i, j).reducedRadius()))
      return fmt::format("{}: a force of {:.3g} N passes a gap of {:.3g} m",
                         contactName(contacts, k, *basis.scene), contacts.normalForce[k],
                         -place.overlap);
  }
  return {};
}

/// Contacts of scenes with convex bodies: each acts at a point, the mean of points in both bodies
/// and so in both, as they are convex. It may be outside by what the two move in a step and a half,
/// by what solvers move overlapping bodies apart, and by a skin as engines have around bodies and
/// by which points that they keep from step to step slide off a face (of PhysX up to a twentieth).
template <int D>
std::string pointFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                       const ContactPlacesOf<D>& places) {
  constexpr double skin = 0.1, steps = 1.5;  // of a body's reach
  const SceneOf<D>& scene = *basis.scene;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  if (contacts.size() > 0 && contacts.point.empty()) return "its contacts have no points";
  double deepest = 0.0;
  for (const double overlap : contacts.overlap) deepest = std::max(deepest, overlap);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const VecOf<D>& point = contacts.point[k];
    const auto check = [&](std::size_t id, double gap, double reach, double speed) {
      const double allowed =
          skin * reach + steps * basis.dt * speed + 2.0 * deepest + places.rounding;
      if (gap <= allowed) return std::string();
      return fmt::format("{}: its point is {:.3g} m outside of {}", contactName(contacts, k, scene),
                         gap, nameOfId(scene, id));
    };
    std::string why;
    for (const std::int32_t each : {contacts.i[k], contacts.j[k]}) {
      const auto id = static_cast<std::size_t>(each);
      if (!why.empty()) return why;
      if (id >= basis.radius.size()) {  // a plane, or a cylinder
        const PlacedPlaneOf<D>& wall = places.planes[id - basis.radius.size()];
        const PlaneOf<D> plane = wall.under(point);
        if (wall.known)
          why = check(id, (point - plane.point).dot(plane.normal), scene.disks.radius.front(),
                      memberVelocity<D>(wall.motion, point).norm());
        continue;
      }
      VecOf<D> place = places.position[id];
      if (scene.box) place = point + scene.box->nearest(place - point);
      double spinning = 0.0, gap = (point - place).norm() - basis.radius[id];
      if (id < scene.disks.size() && snapshot.spin) spinning = sizeOf((*snapshot.spin)[id]);
      if (id < scene.disks.size() && scene.isConvex(id)) {
        const double small = 1e-6 * basis.radius[id];
        const ShapeOf<D> mark = roundShape<D>(small);
        gap = small - overlapOf<D>({&mark, point},
                                   PlacedBody<D>(scene, id, place, (*snapshot.turn)[id]).get());
      }
      why = check(id, gap, basis.radius[id],
                  places.velocity[id].norm() + spinning * basis.radius[id]);
    }
    if (!why.empty()) return why;
  }
  return {};
}

/// Pairs that overlap and that a result file may leave out of its list (contactFault()).
template <int D>
class ListGaps {
 public:
  ListGaps(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis,
           const ContactPlacesOf<D>& places)
      : basis_(basis), places_(places) {
    constexpr double ofMedian = 0.1;
    std::vector<double> listed;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      if (contacts.overlap[k] > 0.0) listed.push_back(contacts.overlap[k]);
      const auto i = static_cast<std::size_t>(contacts.i[k]);
      const auto j = static_cast<std::size_t>(contacts.j[k]);
      if (j >= basis.radius.size() && !places.planes[j - basis.radius.size()].known) continue;
      const double placed = pairPlace(places, basis, i, j).overlap;
      off_ = std::max({off_, std::abs(contacts.overlap[k] - placed),
                       contacts.normalForce[k] > 0.0 ? -placed : 0.0});
    }
    if (listed.empty()) return;
    const auto middle = listed.begin() + static_cast<std::ptrdiff_t>(listed.size() / 2);
    std::ranges::nth_element(listed, middle);
    shallow_ = ofMedian * *middle;
  }

  /// @param place  of a pair that is not listed
  bool contains(const PairPlaceOf<D>& place, std::size_t i, std::size_t j) const {
    constexpr double digits = 1e-5;  // of velocities
    const VecOf<D> relative = places_.velocity[i] - velocityOfSecond(places_, basis_, i, j);
    const double parting = relative.dot(place.normal);
    const double unsure = digits * (places_.velocity[i].norm() + relative.norm());
    // A list of the step before has no pair that met since.
    const double met = std::max(unsure - parting, 0.0) * basis_.shownPlaces->step;
    const double open = std::min(place.uncertain, uncertain(place, i, j));
    if (place.overlap <= std::max({off_, shallow_, open}) + met) return true;
    return !pushesForSure(basis_, i, j, place.overlap, std::max(parting + unsure, 0.0));
  }

 private:
  const ShownPlaces& shown() const { return *basis_.shownPlaces; }

  /// By how much the overlap may be off, as the last digits of places and radii leave it open [m].
  /// Planes are the case's, to six digits. Of wall disks and over periodic sides `rounding` stays.
  double uncertain(const PairPlaceOf<D>& place, std::size_t i, std::size_t j) const {
    constexpr double sixDigits = 1e-6;
    const double later = place.uncertain - places_.rounding;  // of another time
    const std::size_t round = basis_.radius.size();
    if (j >= round) {
      const VecOf<D> point = places_.planes[j - round].under(places_.position[i]).point;
      return later + halves(place.normal, i) + sixDigits * point.norm();
    }
    const VecOf<D> apart = places_.position[i] - places_.position[j];
    const bool acrossSides =
        (apart - place.distance * place.normal).norm() > sixDigits * place.distance;
    if (j >= basis_.scene->disks.size() || acrossSides) return place.uncertain;
    return later + halves(place.normal, i) + halves(place.normal, j);
  }

  /// Of a disk's place along the normal and of its radius [m].
  double halves(const VecOf<D>& normal, std::size_t i) const {
    double sum = half(basis_.radius[i], shown().radius);
    for (int axis = 0; axis < D; ++axis)
      sum += std::abs(normal[axis]) * half(places_.position[i][axis], shown().position);
    return sum;
  }

  /// Half of the last place.
  double half(double value, const LastDigit& last) const {
    const double size = std::abs(value) / shown().unit;
    const double power = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size))) : 0.0;
    return std::max(0.5 * shown().unit * std::max(last.place, power * last.relative),
                    shown().binary * std::abs(value));
  }

  const AuditBasisOf<D>& basis_;
  const ContactPlacesOf<D>& places_;
  double off_ = 0.0;      ///< by which the overlaps of the listed are [m]
  double shallow_ = 0.0;  ///< [m]
};

/// Pairs that overlap and are not listed.
template <int D>
std::string incompleteReason(const ContactsOf<D>& contacts, const AuditBasisOf<D>& basis,
                             const ContactPlacesOf<D>& places, const ContactsByFirst& byFirst) {
  const std::size_t disks = basis.scene->disks.size(), round = basis.radius.size();
  std::string why;
  std::optional<ListGaps<D>> gaps;
  if (basis.shownPlaces) gaps.emplace(contacts, basis, places);
  const auto require = [&](std::size_t i, std::size_t j) {
    const PairPlaceOf<D> place = pairPlace(places, basis, i, j);
    if (place.overlap <= 0.0 || (!gaps && place.overlap <= place.uncertain)) return;
    if (byFirst.count(contacts, i, j) > 0 || (gaps && gaps->contains(place, i, j))) return;
    why = fmt::format("no contact of {} with {}, which overlap by {:.3g} m",
                      nameOfId(*basis.scene, i), nameOfId(*basis.scene, j), place.overlap);
  };
  const auto& box = basis.scene->box;
  nearPairs<D>(places.position, basis.radius, disks, box, [&](std::size_t i, std::size_t j) {
    const double reach = basis.radius[i] + basis.radius[j];
    VecOf<D> apart = places.position[i] - places.position[j];
    if (box) apart = box->nearest(apart);
    if (apart.squaredNorm() >= reach * reach) return;
    if (why.empty()) require(i, j);
  });
  for (std::size_t p = 0; p < places.planes.size() && why.empty(); ++p)
    if (places.planes[p].known)
      for (std::size_t i = 0; i < disks && why.empty(); ++i) require(i, round + p);
  return why;
}

}  // namespace

template <int D>
std::string contactFault(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis) {
  if (!snapshot.contacts) return {};
  const ContactsOf<D>& contacts = *snapshot.contacts;
  if (std::string why = idsFault(contacts, *basis.scene); !why.empty()) return why;
  const ContactsByFirst byFirst(contacts, basis.scene->disks.size());
  if (std::string why = listFault(contacts, basis, byFirst); !why.empty()) return why;
  if (snapshot.contactInterval > meansOverSteps * basis.dt) return {};
  if (std::string why = forceFault(contacts, basis); !why.empty()) return why;
  if (!basis.byOverlap && !(basis.dt > 0.0)) return {};  // moved on, by an unknown way
  ContactPlacesOf<D> places = contactPlaces(snapshot, basis);
  if (!basis.scene->shapes.empty()) return pointFault(snapshot, basis, places);
  // Both disks of a pair may have been moved out of others that deep.
  if (!basis.byOverlap) places.rounding += 2.0 * deepestOverlap(contacts, basis, places);
  if (std::string why = placeFault(contacts, basis, places); !why.empty()) return why;
  return basis.byOverlap && snapshot.contactInterval == 0.0
             ? incompleteReason(contacts, basis, places, byFirst)
             : std::string();
}
template std::string contactFault<2>(const Snapshot&, const AuditBasis&);
template std::string contactFault<3>(const SpaceSnapshot&, const AuditBasisOf<3>&);

}  // namespace crossgrain
