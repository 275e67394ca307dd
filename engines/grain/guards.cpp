#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "engines/grain/core.hpp"

// Guards end a run rather than go on with numbers that mean nothing.

namespace grain {

template <class Real>
void Core<Real>::reportNotFinite(const NotFinite& found) const {
  const auto number =
      found.disk < moving_ ? static_cast<std::size_t>(idAtIndex_[found.disk]) : found.disk;
  throw std::runtime_error("the position of disk " + std::to_string(number) + " is not finite");
}

template <class Real>
void Core<Real>::reportTooDeep(const TooDeep& found) const {
  const bool wall = found.j >= moving_;
  const auto partner = wall ? found.j : static_cast<std::size_t>(idAtIndex_[found.j]);
  const auto number = static_cast<std::size_t>(idAtIndex_[found.i]);
  if (!wall && partner < number) reportTooDeep(TooDeep{found.j, found.i});
  const auto a = static_cast<double>(radius_[found.i]), b = static_cast<double>(radius_[found.j]);
  const double distance = std::hypot(x(number) - x(partner), y(number) - y(partner));
  reportTooDeep(
      found.i, (wall ? "wall disk " : "disk ") + std::to_string(wall ? partner - moving_ : partner),
      a + b - distance, std::min(a, b));
}

/// A plane has no far side: a disk whose centre is behind it is in it.
template <class Real>
void Core<Real>::checkPlanes() {
  for (std::size_t p = 0; p < placedPlanes_.size(); ++p) {
    const Plane& plane = placedPlanes_[p].plane;
    for (std::size_t place = 0; place < moving_; ++place) {
      const auto number = static_cast<std::size_t>(idAtIndex_[place]);
      const auto radius = static_cast<double>(radius_[place]);
      const double overlap =
          radius - (x(number) - plane.x) * plane.nx - (y(number) - plane.y) * plane.ny;
      if (overlap > maxOverlap_ * radius)
        reportTooDeep(place, "plane " + std::to_string(p), overlap, radius);
    }
  }
}

template <class Real>
void Core<Real>::reportTooDeep(std::size_t place, const std::string& partner, double overlap,
                               double radius) const {
  const auto number = static_cast<std::size_t>(idAtIndex_[place]);
  std::ostringstream text;
  text.precision(4);
  text << "disk " << number << " and " << partner << " overlap by " << overlap << " m, "
       << overlap / radius << " of the smaller radius, at (" << x(number) << ", " << y(number)
       << ") m, t = " << time() << " s";
  if (std::isfinite(maxOverlap_))
    text << "; the limit is " << maxOverlap_;
  else
    text << ": their centres coincide";
  throw std::runtime_error(text.str());
}

}  // namespace grain
