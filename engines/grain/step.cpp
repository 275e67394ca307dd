#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "engines/grain/core.hpp"
#include "engines/grain/reorder.hpp"

namespace grain {
///   kick: v += a dt   drift: x += v dt   move walls   forces: a(x, v)
template <class Real>
void Core<Real>::step(bool record, bool tally) {
  known_.reset();
  if (ledger_) ledger_->beforeMotion();
  advanceDisks();
  ++steps_;
  moveWalls();
  if (steps_ % renumberingInterval == 0) renumber();
  if (outdated_) updateNeighbours();
  addForces(record || ledger_ != nullptr);
  if (ledger_) ledger_->afterForces(tally);
  if (integrator_ == Integrator::velocityVerlet) kick(static_cast<Real>(0.5 * dt_));
}

template <class Real>
void Core<Real>::advanceDisks() {
  const MotionView<Real> view = motionView();
  team_.run([&](std::size_t part) {
    reports_[part] =
        motion_(motionConstants_, view, lists_.partBegin(part), lists_.partBegin(part + 1));
  });
  outdated_ = false;
  for (const MotionReport<Real>& report : reports_)
    if (!(report.excess <= Real(0)) || !std::isfinite(report.speedSquares)) outdated_ = true;
}

template <class Real>
void Core<Real>::kick(Real dt) {
  const MotionView<Real> view = motionView();
  team_.run([&](std::size_t part) {
    kernels_.kick[law_.rotation](dt, view, lists_.partBegin(part), lists_.partBegin(part + 1));
  });
}

template <class Real>
void Core<Real>::moveWalls() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (!walls_[w].moves()) continue;
    wallPath_[w] += walls_[w].moveTo(time());
    if (walls_[w].diskCount() > 0 && !(wallPath_[w] <= lists_.allowances()[wallBegin_[w]]))
      outdated_ = true;
  }
  for (PlacedPlane& placed : placedPlanes_)
    if (walls_[placed.wall].moves()) placed.plane = walls_[placed.wall].plane(placed.member);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].moves() && !walls_[w].stoodStill())
      placeWallDisks(w, reached_[w].size(), [&reached = reached_[w]](std::size_t n) {
        return static_cast<std::size_t>(reached[n]);
      });
}

template <class Real>
void Core<Real>::updateNeighbours() {
  placeWalls(Which::moving);
  guarded([&] { lists_.update(places(), travel(), steps_ - chosenAt_, team_); });
  findReachedWallDisks();
  rememberChoice();
}

template <class Real>
std::span<const double> Core<Real>::travel() {
  travel_.resize(position_.size());
  for (std::size_t i = 0; i < moving_; ++i) {
    const Vec<Real> v = velocity_[i];
    travel_[i] = dt_ * static_cast<double>(squareRoot(v.x * v.x + v.y * v.y));
  }
  for (std::size_t w = 0; w < walls_.size(); ++w)
    std::fill(travel_.begin() + static_cast<std::ptrdiff_t>(wallBegin_[w]),
              travel_.begin() + static_cast<std::ptrdiff_t>(wallBegin_[w + 1]),
              walls_[w].moves() ? dt_ * walls_[w].speed() : 0.0);
  return travel_;
}

template <class Real>
void Core<Real>::rememberChoice() {
  checkPlanes();
  positionsAtListBuild_.assign(position_.begin(),
                               position_.begin() + static_cast<std::ptrdiff_t>(moving_));
  allowanceSquare_.resize(moving_);
  for (std::size_t i = 0; i < moving_; ++i) {
    const double sure = 0.999 * lists_.allowances()[i];  // single precision does not see the rest
    allowanceSquare_[i] = static_cast<Real>(sure * sure);
  }
  wallPath_.assign(walls_.size(), 0.0);
  chosenAt_ = steps_;
  outdated_ = false;
  sampled_ = false;
}

template <class Real>
void Core<Real>::addForces(bool record) {
  recorded_ = record;
  const auto begin = std::chrono::steady_clock::now();
  if (law_.normal == NormalLaw::rigid)
    addImpacts();
  else
    addSoftForces(record);
  if (!std::exchange(sampled_, true))  // one step in some measures for the lists what a pair costs
    lists_.pairsTook(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

/// Contacts add to the disks' forces in one order, whatever the number of threads: those with
/// disks of lower parts, those inside the part, those with disks of higher parts, walls, planes.
/// That is the order of one list of all pairs, since parts are consecutive.
template <class Real>
void Core<Real>::addSoftForces(bool record) {
  if (record) makeRoomForRecords();
  if (lists_.parts() > 1) {
    team_.run([&](std::size_t part) { touching_[part] = addPairs(part, Sort::across, record); });
  } else {
    touching_[0] = 0;
  }
  team_.run([&](std::size_t part) {
    addFromLowerParts(part);
    touching_[part] += addPairs(part, Sort::inside, record);
    addFromHigherParts(part);
    touching_[part] += addPairs(part, Sort::walls, record);
    for (PlacedPlane& placed : placedPlanes_)
      touching_[part] += planes_(law_, contactView(), planeView(placed, record),
                                 lists_.partBegin(part), lists_.partBegin(part + 1));
  });
  for (const std::size_t touching : touching_) contactEvaluations_ += touching;
}

template <class Real>
std::size_t Core<Real>::addPairs(std::size_t part, Sort sort, bool record) {
  constexpr AddTo addTo[] = {AddTo::both, AddTo::none, AddTo::first};
  const auto pairs = lists_.list(part, sort)
                         .view(addTo[static_cast<std::size_t>(sort)], record, law_.rotation,
                               law_.rolling != RollingLaw::none);
  return contacts_(law_, contactView(), pairs);
}

template <class Real>
void Core<Real>::addFromLowerParts(std::size_t part) {
  const auto begin = static_cast<std::int32_t>(lists_.partBegin(part));
  const auto end = static_cast<std::int32_t>(lists_.partBegin(part + 1));
  for (std::size_t lower = 0; lower < part; ++lower) {
    const PairList<Real>& list = lists_.list(lower, Sort::across);
    for (std::size_t k = 0; k < list.count; ++k) {
      if (list.j[k] < begin || list.j[k] >= end) continue;
      const auto j = static_cast<std::size_t>(list.j[k]);
      force_[j] -= list.force[k];
      if (law_.rotation) torque_[j] -= list.leverJ[k];
    }
  }
}

template <class Real>
void Core<Real>::addFromHigherParts(std::size_t part) {
  const PairList<Real>& list = lists_.list(part, Sort::across);
  for (std::size_t k = 0; k < list.count; ++k) {
    const auto i = static_cast<std::size_t>(list.i[k]);
    force_[i] += list.force[k];
    if (law_.rotation) torque_[i] -= list.leverI[k];
  }
}

/// Gives disks numbers anew by their place in space, so that neighbours are near in memory.
template <class Real>
void Core<Real>::renumber() {
  placeWalls(Which::all);
  const Places now = places();
  const double largest = now.radius.empty() ? 1.0 : *std::ranges::max_element(now.radius);
  guarded([&] { requireFinite(now); });
  renumberingGrid_.sort(now.position.first(moving_), 2.0 * largest);
  const std::span<const std::int32_t> order = renumberingGrid_.sorted();

  newPlace_.resize(moving_);
  for (std::size_t place = 0; place < moving_; ++place)
    newPlace_[static_cast<std::size_t>(order[place])] = static_cast<std::int32_t>(place);
  forDiskArrays([&](auto& array) {
    if (!array.empty()) reorder(array, order, scratch_);
  });
  reorder(idAtIndex_, order, scratch_);
  for (std::size_t place = 0; place < moving_; ++place)
    indexOfId_[static_cast<std::size_t>(idAtIndex_[place])] = static_cast<std::int32_t>(place);
  localise();
  guarded([&] { lists_.renumber(newPlace_, places(), travel(), team_); });
  if (ledger_) ledger_->renumber(order, newPlace_, scratch_);
  findReachedWallDisks();
  rememberChoice();
}

/// In single precision coordinates count from the corner of a square of a few diameters, so that an
/// overlap of 1e-7 m is not lost in a position of 0.1 m. Corners are exact, and so is the change
/// from one to another.
template <class Real>
void Core<Real>::localise() {
  if (origin_.empty()) return;
  const auto move = [this](Real& local, Real& origin) {
    const Real shift = std::floor(local / square_) * square_;
    local -= shift;
    origin += shift;
  };
  for (std::size_t i = 0; i < moving_; ++i) {
    move(position_[i].x, origin_[i].x);
    move(position_[i].y, origin_[i].y);
  }
  const auto square = static_cast<double>(square_);
  for (std::size_t w = 0; w < walls_.size(); ++w)
    for (std::size_t k = 0; k < walls_[w].diskCount(); ++k) {
      const WallPoint point = walls_[w].disk(k);
      origin_[wallBegin_[w] + k] = {static_cast<Real>(std::floor(point.x / square) * square),
                                    static_cast<Real>(std::floor(point.y / square) * square)};
    }
  placeWalls(Which::all);
}

/// @param member  of 0 … count − 1: which disk of the wall
template <class Real>
template <class Member>
void Core<Real>::placeWallDisks(std::size_t w, std::size_t count, Member&& member) {
  const WallPose pose = walls_[w].pose();  // a copy, which nothing that is stored here can change
  const std::vector<WallOffset>& offsets = walls_[w].offsets();
  Array<Vec<Real>>& velocity = dashpotVelocity_.empty() ? velocity_ : dashpotVelocity_;
  Array<Real>& spin = dashpotVelocity_.empty() ? spin_ : seenSpin_;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t k = member(n);
    const std::size_t i = wallBegin_[w] + k;
    const WallPoint point = pose.at(offsets[k]);
    const Vec<Real> origin = origin_.empty() ? Vec<Real>{} : origin_[i];
    position_[i] = {static_cast<Real>(point.x - static_cast<double>(origin.x)),
                    static_cast<Real>(point.y - static_cast<double>(origin.y))};
    velocity[i] = {static_cast<Real>(point.vx), static_cast<Real>(point.vy)};
    if (law_.rotation) spin[i] = static_cast<Real>(pose.now.spin);
  }
}

template <class Real>
void Core<Real>::placeWalls(Which which) {
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (which == Which::all || walls_[w].moves())
      placeWallDisks(w, walls_[w].diskCount(), std::identity());
}

/// A wall's disks that no disk can touch before the lists are made anew need not be moved.
template <class Real>
void Core<Real>::findReachedWallDisks() {
  isReached_.assign(position_.size() - moving_, false);
  for (std::size_t part = 0; part < lists_.parts(); ++part)
    for (const std::int32_t j : lists_.list(part, Sort::walls).farJ)
      isReached_[static_cast<std::size_t>(j) - moving_] = true;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    reached_[w].clear();
    for (std::size_t k = 0; k < walls_[w].diskCount(); ++k)
      if (isReached_[wallBegin_[w] - moving_ + k])
        reached_[w].push_back(static_cast<std::int32_t>(k));
  }
}

}  // namespace grain
