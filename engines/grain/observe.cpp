#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

namespace grain {

template <class Real>
double Core<Real>::x(std::size_t number) const {
  if (number >= moving_) return wallDisk(number).x;
  const auto i = static_cast<std::size_t>(indexOfId_[number]);
  return (origin_.empty() ? 0.0 : static_cast<double>(origin_[i].x)) +
         static_cast<double>(position_[i].x);
}

template <class Real>
double Core<Real>::y(std::size_t number) const {
  if (number >= moving_) return wallDisk(number).y;
  const auto i = static_cast<std::size_t>(indexOfId_[number]);
  return (origin_.empty() ? 0.0 : static_cast<double>(origin_[i].y)) +
         static_cast<double>(position_[i].y);
}

/// Of a wall disk.
template <class Real>
std::size_t Core<Real>::wallOf(std::size_t number) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(wallBegin_, number) -
                                  wallBegin_.begin()) -
         1;
}

template <class Real>
WallPoint Core<Real>::wallDisk(std::size_t number) const {
  const std::size_t w = wallOf(number);
  return walls_[w].disk(number - wallBegin_[w]);
}

template <class Real>
double Core<Real>::velocityX(std::size_t number) const {
  const auto i = static_cast<std::size_t>(indexOfId_[number]);
  return static_cast<double>(velocity_[i].x) +
         halfKick_ * static_cast<double>(force_[i].x * inverseMass_[i]);
}

template <class Real>
double Core<Real>::velocityY(std::size_t number) const {
  const auto i = static_cast<std::size_t>(indexOfId_[number]);
  return static_cast<double>(velocity_[i].y) +
         halfKick_ * static_cast<double>(force_[i].y * inverseMass_[i]);
}

template <class Real>
double Core<Real>::spin(std::size_t number) const {
  const auto i = static_cast<std::size_t>(indexOfId_[number]);
  return static_cast<double>(spin_[i]) +
         halfKick_ * static_cast<double>(torque_[i] * inverseInertia_[i]);
}

template <class Real>
const std::vector<Contact>& Core<Real>::contacts() const {
  if (!known_) {
    if (!recorded_) throw std::logic_error("the last step did not record its contacts");
    std::vector<Contact> contacts =
        law_.normal == NormalLaw::rigid ? impactContacts() : softContacts();
    std::ranges::sort(contacts, [](const Contact& a, const Contact& b) {
      return std::tie(a.i, a.j) < std::tie(b.i, b.j);
    });
    known_ = std::move(contacts);
  }
  return *known_;
}

template <class Real>
GRAIN_INLINE std::optional<Contact> Core<Real>::touching(const PairList<Real>& list,
                                                         std::size_t k) const {
  const auto i = static_cast<std::size_t>(list.i[k]);
  const auto j = static_cast<std::size_t>(list.j[k]);
  // The kernel's own arithmetic: the same bits.
  Vec<Real> d = position_[i] - position_[j];
  if (!list.shift.empty()) d += list.shift[k];
  const Real reach = radius_[i] + radius_[j];
  const Real distance2 = d.x * d.x + d.y * d.y;
  if (!isContact(list, k, distance2 < reach * reach)) return std::nullopt;
  const Real distance = squareRoot(distance2);
  const Real inverse = Real(1) / distance;
  return contactOf(list, k, {d.x * inverse, d.y * inverse}, reach - distance);
}

template <class Real>
GRAIN_INLINE std::optional<Contact> Core<Real>::touching(std::size_t plane, std::size_t i) const {
  const PlacedPlane& placed = placedPlanes_[plane];
  if (law_.cohesion == CohesionLaw::jkr ? !(placed.memory[i] > Real(0))
                                        : !(placed.overlap[i] > Real(0)))
    return std::nullopt;
  return Contact{static_cast<std::int32_t>(i),
                 static_cast<std::int32_t>(position_.size() + plane),
                 placed.plane.nx,
                 placed.plane.ny,
                 static_cast<double>(placed.overlap[i]),
                 static_cast<double>(placed.normal[i]),
                 static_cast<double>(placed.tangential[i]),
                 placed.spring.empty() ? 0.0 : static_cast<double>(placed.spring[i]),
                 placed.sliding[i] != Real(0),
                 rolls() ? static_cast<double>(placed.rolling[i]) : 0.0,
                 placed.angle.empty() ? 0.0 : static_cast<double>(placed.angle[i]),
                 rolls() && placed.rollingSlides[i] != Real(0),
                 placed.memory.empty() ? 0.0 : static_cast<double>(placed.memory[i])};
}

template <class Real>
std::vector<Contact> Core<Real>::softContacts() const {
  std::vector<Contact> contacts;
  forContactsByPlace([&](Contact contact) {
    contact.i = idAtIndex_[static_cast<std::size_t>(contact.i)];
    if (static_cast<std::size_t>(contact.j) < moving_)
      contact.j = idAtIndex_[static_cast<std::size_t>(contact.j)];
    contacts.push_back(fromLower(contact));
  });
  return contacts;
}

/// The sum over the wall's contacts, each with the opposite force and, for a wall disk, with the
/// torque about that disk's own centre that the law gives it; against rolling, too.
template <class Real>
WallLoad Core<Real>::wallLoad(std::size_t w) const {
  WallLoad load;
  const WallState& wall = walls_[w].state();
  for (const Contact& contact : contacts()) {
    const auto j = static_cast<std::size_t>(contact.j);
    const bool plane = j >= position_.size();
    if (plane ? placedPlanes_[j - position_.size()].wall != w
              : j < wallBegin_[w] || j >= wallBegin_[w + 1])
      continue;
    const auto i = static_cast<std::size_t>(contact.i);
    const double forceX = contact.normalForce * contact.nx - contact.tangentialForce * contact.ny;
    const double forceY = contact.normalForce * contact.ny + contact.tangentialForce * contact.nx;
    double armX, armY;
    if (plane) {
      const double own = ownRadius(contact);
      const double reach = planePoint(law_, own, own - contact.overlap);
      armX = x(i) - reach * contact.nx - wall.x;
      armY = y(i) - reach * contact.ny - wall.y;
    } else {
      const WallPoint centre = wallDisk(j);
      armX = centre.x - wall.x;
      armY = centre.y - wall.y;
      if (law_.rotation) {
        const auto radius = static_cast<double>(radius_[j]);
        const auto other = static_cast<double>(radius_[static_cast<std::size_t>(indexOfId_[i])]);
        load.torque -= armOf(law_.lever, radius, other, contact.overlap) * contact.tangentialForce;
      }
    }
    load.fx -= forceX;
    load.fy -= forceY;
    load.torque -= armX * forceY - armY * forceX + contact.rollingTorque;
  }
  return load;
}

template <class Real>
double Core<Real>::kineticEnergy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < moving_; ++i) {
    const double vx = velocityX(i);
    const double vy = velocityY(i);
    energy += 0.5 * mass_[i] * (vx * vx + vy * vy);
    if (rotates()) energy += 0.5 * inertia_[i] * spin(i) * spin(i);
  }
  return energy;
}

template <class Real>
double Core<Real>::ownRadius(const Contact& contact) const {
  return static_cast<double>(
      radius_[static_cast<std::size_t>(indexOfId_[static_cast<std::size_t>(contact.i)])]);
}

/// R₁₂ of places; of a plane's partner its own radius.
template <class Real>
Real Core<Real>::pairRadius(std::size_t i, std::size_t j) const {
  const Real own = radius_[i];
  if (j >= diskCount()) return own;
  return own * radius_[j] / (own + radius_[j]);
}

template <class Real>
RollingMotion<Real> Core<Real>::rollingLengths(const Contact& contact) const {
  const auto j = static_cast<std::size_t>(contact.j);
  return rollingMotion(law_, radius_[static_cast<std::size_t>(contact.i)],
                       j < diskCount() ? radius_[j] : Real(0), Real(0));
}

template <class Real>
ContactMotion<Real> Core<Real>::geometryOf(const Contact& contact) const {
  const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
  ContactMotion<Real> motion{};
  motion.overlap = static_cast<Real>(contact.overlap);
  motion.radius = pairRadius(i, j);
  motion.reach = j < diskCount() ? radius_[i] + radius_[j] : Real(0);
  return motion;
}

/// From numbers to places.
template <class Real>
Contact Core<Real>::byPlace(Contact contact) const {
  contact.i = static_cast<std::int32_t>(placeOf(contact.i));
  contact.j = static_cast<std::int32_t>(placeOf(contact.j));
  return contact;
}

template <class Real>
double Core<Real>::elasticEnergy() const {
  double energy = 0.0;
  for (const Contact& numbered : contacts()) {
    const Contact contact = byPlace(numbered);
    const ContactMotion<Real> motion = geometryOf(contact);
    const GeneralLaw<Real>& law = lawOf(contact);
    energy += static_cast<double>(storedEnergy(law, motion, static_cast<Real>(contact.spring)));
    if (law_.cohesion != CohesionLaw::none)
      energy += static_cast<double>(bodyEnergy(law, motion, static_cast<Real>(contact.memory)) -
                                    storedEnergy(law, motion, Real(0)));
    if (law_.rolling == RollingLaw::spring)
      energy += 0.5 * static_cast<double>(law.kr * rollingLengths(contact).square) * contact.angle *
                contact.angle;
  }
  return energy;
}

}  // namespace grain
