#include <algorithm>
#include <tuple>
#include <utility>

#include "engines/grain/contact_force.hpp"
#include "engines/grain/core.hpp"

// A step of rigid disks: which ones touch, and their impulses as forces of that one step.

namespace grain {

/// Disks have the velocities of the step that led here, and the coming kick; walls likewise: means
/// over the two steps, so that what rests on a wall that speeds up is held as it is under gravity.
template <class Real>
void Core<Real>::addImpacts() {
  impactBodies_.clear();
  for (std::size_t i = 0; i < moving_; ++i) {
    const double kick = dt_ * static_cast<double>(inverseMass_[i]);
    ImpactBody body{.vx = velocity_[i].x,
                    .vy = velocity_[i].y,
                    .kickX = kick * static_cast<double>(force_[i].x),
                    .kickY = kick * static_cast<double>(force_[i].y),
                    .inverseMass = inverseMass_[i]};
    if (law_.rotation) {
      body.spin = spin_[i];
      body.kickSpin = dt_ * static_cast<double>(torque_[i]) * inverseInertia_[i];
      body.inverseInertia = inverseInertia_[i];
    }
    impactBodies_.push_back(body);
  }
  for (MovingWall& wall : walls_) {
    wall.lookAhead(time() + dt_);
    for (const WallOffset& offset : wall.offsets()) impactBodies_.push_back(wallBody(wall, offset));
  }
  impacts_.clear();
  findPairImpacts();
  // One order, whatever the lists and the number of threads.
  std::ranges::sort(impacts_, [](const Impact& a, const Impact& b) {
    return std::tie(a.i, a.j) < std::tie(b.i, b.j);
  });
  for (std::size_t p = 0; p < placedPlanes_.size(); ++p) findPlaneImpacts(p);

  if (!solveImpacts(impactLaw_, impactBodies_, impacts_)) ++unfinishedImpacts_;
  contactEvaluations_ += impacts_.size();
  for (const Impact& impact : impacts_) addImpulse(impact);
}

template <class Real>
ImpactBody Core<Real>::wallBody(const MovingWall& wall, const WallOffset& offset) const {
  const auto [before, after] = wall.meanVelocities(offset);
  ImpactBody body{.vx = before.vx,
                  .vy = before.vy,
                  .kickX = after.vx - before.vx,
                  .kickY = after.vy - before.vy};
  if (law_.rotation) {
    body.spin = before.spin;
    body.kickSpin = after.spin - before.spin;
  }
  return body;
}

template <class Real>
void Core<Real>::findPairImpacts() {
  for (std::size_t part = 0; part < lists_.parts(); ++part)
    for (const Sort sort : sorts) {
      const PairList<Real>& list = lists_.list(part, sort);
      for (std::size_t k = 0; k < list.count; ++k) {
        const auto i = static_cast<std::size_t>(list.i[k]);
        const auto j = static_cast<std::size_t>(list.j[k]);
        Vec<Real> d = position_[i] - position_[j];
        if (!list.shift.empty()) d += list.shift[k];
        const double x = d.x, y = d.y;
        const double reach = static_cast<double>(radius_[i]) + static_cast<double>(radius_[j]);
        const double distance2 = x * x + y * y;
        if (!(distance2 < reach * reach)) continue;
        const double distance = squareRoot(distance2);
        Impact impact{
            .i = i, .j = j, .nx = x / distance, .ny = y / distance, .overlap = reach - distance};
        const auto radiusI = static_cast<double>(radius_[i]);
        const auto radiusJ = static_cast<double>(radius_[j]);
        impact.leverI = armOf(law_.lever, radiusI, radiusJ, impact.overlap);
        impact.leverJ = armOf(law_.lever, radiusJ, radiusI, impact.overlap);
        impact.armI = armOf(law_.velocityLever, radiusI, radiusJ, impact.overlap);
        impact.armJ = armOf(law_.velocityLever, radiusJ, radiusI, impact.overlap);
        if (!laws_.empty()) impact.law = &impactLaws_[pairOf(i, j)];
        impacts_.push_back(impact);
      }
    }
}

/// A plane's points move each in its own way, so each contact has a body of its own.
template <class Real>
void Core<Real>::findPlaneImpacts(std::size_t p) {
  const PlacedPlane& placed = placedPlanes_[p];
  const Plane& plane = placed.plane;
  const MovingWall& wall = walls_[placed.wall];
  for (std::size_t i = 0; i < moving_; ++i) {
    Vec<double> origin{0.0, 0.0};
    if constexpr (hasLocalCoordinates<Real>)
      origin = {static_cast<double>(origin_[i].x), static_cast<double>(origin_[i].y)};
    const double dx = origin.x - plane.x + static_cast<double>(position_[i].x);
    const double dy = origin.y - plane.y + static_cast<double>(position_[i].y);
    const double height = dx * plane.nx + dy * plane.ny;
    const auto radius = static_cast<double>(radius_[i]);
    if (!(height < radius)) continue;
    const double reach = planePoint(law_, radius, height);
    const double armX = plane.x + dx - reach * plane.nx - wall.state().x;
    const double armY = plane.y + dy - reach * plane.ny - wall.state().y;
    Impact impact{.i = i,
                  .j = impactBodies_.size(),
                  .nx = plane.nx,
                  .ny = plane.ny,
                  .overlap = radius - height};
    impact.leverI = planeArmOf(law_.lever, law_.planeLever, radius, height);
    impact.armI = planeArmOf(law_.velocityLever, law_.planeLever, radius, height);
    impact.plane = static_cast<std::int32_t>(p);
    if (!laws_.empty()) impact.law = &impactLaws_[pairOf(i, position_.size() + p)];
    impactBodies_.push_back(wallBody(wall, wall.offsetOf(armX, armY)));
    impacts_.push_back(impact);
  }
}

template <class Real>
void Core<Real>::addImpulse(const Impact& impact) {
  const double fx = (impact.normal * impact.nx - impact.tangential * impact.ny) / dt_;
  const double fy = (impact.normal * impact.ny + impact.tangential * impact.nx) / dt_;
  const Vec<Real> force{static_cast<Real>(fx), static_cast<Real>(fy)};
  const double turning = impact.tangential / dt_;
  force_[impact.i] += force;
  if (law_.rotation) torque_[impact.i] -= static_cast<Real>(impact.leverI * turning);
  if (impact.j >= moving_) return;
  force_[impact.j] -= force;
  if (law_.rotation) torque_[impact.j] -= static_cast<Real>(impact.leverJ * turning);
}

/// Impulses over dt, the forces of the step.
template <class Real>
std::vector<Contact> Core<Real>::impactContacts() const {
  std::vector<Contact> contacts;
  for (const Impact& impact : impacts_) {
    Contact contact{idAtIndex_[impact.i],
                    impact.plane >= 0 ? static_cast<std::int32_t>(position_.size()) + impact.plane
                    : impact.j < moving_ ? idAtIndex_[impact.j]
                                         : static_cast<std::int32_t>(impact.j),
                    impact.nx,
                    impact.ny,
                    impact.overlap,
                    impact.normal / dt_,
                    impact.tangential / dt_,
                    0.0,
                    impact.slid};
    contacts.push_back(fromLower(contact));
  }
  return contacts;
}

}  // namespace grain
