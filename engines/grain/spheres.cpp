#include "engines/grain/spheres.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "engines/grain/fingerprint.hpp"
#include "engines/grain/kernels.hpp"
#include "engines/grain/pair_lists.hpp"
#include "engines/grain/reorder.hpp"

namespace grain {
namespace {

using Vector = Vec3<double>;

/// For messages: std::to_string() has all digits of 1e300 and none of 1e-9.
std::string shortText(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void demand(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

/// The fastest that a law has.
template <class Bodies>
SpaceContactKernel<Bodies> kernelOf(const SpaceContactKernels<Bodies>& all,
                                    const GeneralLaw<double>& law, const SpheresSetup& setup) {
  const auto variant = contactVariant(law);
  if (variant && !setup.generalKernels && spaceConventions(setup.law) == SpaceConventions{})
    if (const auto own = kernelOf(all.own, *variant)) return own;
  return all.general;
}

bool pushesMoreThanPairs(const SpheresSetup& setup) {
  return !isZero(setup.gravity) || std::ranges::any_of(setup.walls, [](const SpaceWall& w) {
    return !w.planes.empty() || !w.cylinders.empty();
  });
}

/// Of each two materials; none where all bodies are of one.
std::vector<GeneralLaw<double>> lawsOf(const SpheresSetup& setup) {
  std::vector<GeneralLaw<double>> laws;
  if (setup.materials)
    for (const ContactLaw& law : setup.materials->laws)
      laws.push_back(generalLaw<double>(lawOfPair(law), setup.dt, setup.rotation));
  return laws;
}

double rangeOf(const GeneralLaw<double>& law, const std::vector<GeneralLaw<double>>& laws,
               const std::vector<double>& radius) {
  if (law.cohesion != CohesionLaw::jkr || radius.empty()) return 0.0;
  const double largest = *std::ranges::max_element(radius);
  if (laws.empty()) return jkrRange(law, largest);  // of a wall, the farthest
  double range = 0.0;
  for (const GeneralLaw<double>& each : laws) range = std::max(range, jkrRange(each, largest));
  return range;
}

}  // namespace

Spheres::Spheres(SpheresSetup setup)
    : setup_(std::move(setup)),
      fingerprint_(fingerprint(setup_)),
      law_(generalLaw<double>(setup_.law, setup_.dt, setup_.rotation)),
      laws_(lawsOf(setup_)),
      kernels_(kernels<double>().space),
      range_(rangeOf(law_, laws_, setup_.radius)),
      everyone_(pushesMoreThanPairs(setup_)),
      shares_(partCount(setup_.threads, setup_.mass.size())),
      lists_(
          setup_.mass.size(), shares_.size(), setup_.box.value_or(SpaceBox{}),
          Skin(setup_.skin, setup_.radius.empty() ? 1.0 : *std::ranges::min_element(setup_.radius)),
          range_, SpaceRecords(law_), kernels_),
      team_(std::make_unique<ThreadTeam>(shares_.size())) {
  demand(setup_.dt > 0.0, "the time step must be > 0 s");
  demand(setup_.law.normal != NormalLaw::rigid, "spheres have no impulses");
  pairKernel_ = kernelOf(laws_.empty() ? kernels_.pairs : kernels_.materialPairs, law_, setup_);
  planeKernel_ = kernelOf(kernels_.planes, law_, setup_);
  placeSpheres();
  moveWalls();
  updateNeighbours();
  renumber();
  // At t = 0 the velocities are given: nothing is predicted, and no damping is implicit.
  addForcesAfter(0.0);
  if (setup_.law.conventions.integrator == Integrator::positionVerlet) {
    halfKick_ = 0.5 * setup_.dt;  // from here on velocities live half a step before positions
    kick(-halfKick_);
  }
}

void Spheres::addForcesAfter(double halfStep) {
  const double usual = law_.halfStep;
  forLaws([halfStep](GeneralLaw<double>& law) { law.halfStep = halfStep; });
  addForces();
  forLaws([usual](GeneralLaw<double>& law) { law.halfStep = usual; });
}

void Spheres::placeSpheres() {
  const SpaceRecords records(law_);
  const bool predicts = dampingVelocity(setup_.law) == DampingVelocity::predicted;
  for (std::size_t i = 0; i < size(); ++i) {
    position_.push_back(quadOf(setup_.position[i], setup_.radius[i]));
    velocity_.push_back(quadOf(setup_.velocity[i]));
    if (law_.rotation) spin_.push_back(quadOf(setup_.spin[i]));
    idAtIndex_.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const SpaceWall& wall = setup_.walls[w];
    wallBegin_.push_back(position_.size());
    wallNow_.push_back(wall.motion(0.0));
    wallCentre_.push_back(wallNow_[w].centre);
    double arm = 0.0;
    for (std::size_t k = 0; k < wall.radius.size(); ++k) {
      position_.push_back(quadOf(wall.position[k], wall.radius[k]));
      wallArms_.push_back(quadOf(wall.position[k] - wallCentre_[w], wall.radius[k]));
      arm = std::max(arm, length(vectorOf(wallArms_.back())));
    }
    wallReach_.push_back(arm);
    for (std::size_t member = 0; member < wall.planes.size(); ++member)
      planes_.push_back({w, member, 0.0, {}, {}, SpaceContacts(records)});
  }
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    for (const SpaceWall::Cylinder& each : setup_.walls[w].cylinders)
      planes_.push_back({w, 0, each.radius, each.point, each.axis, SpaceContacts(records)});
  for (PlacedPlane& plane : planes_) {
    plane.contacts.resize(size());
    plane.touches.resize(size());
  }
  wallBegin_.push_back(position_.size());
  wallPath_.resize(setup_.walls.size());
  wallSteady_.resize(setup_.walls.size());
  for (auto* array : {&velocity_, &force_}) array->resize(position_.size());
  inverseMass_.resize(position_.size());
  if (law_.rotation) {
    for (auto* array : {&spin_, &torque_}) array->resize(position_.size());
    inverseInertia_.resize(position_.size());
  }
  mass_.resize(size());
  if (setup_.materials) {
    material_.resize(size());
    for (std::size_t w = 0; w < setup_.walls.size(); ++w)
      material_.insert(material_.end(), setup_.walls[w].radius.size(), setup_.materials->ofWall[w]);
    for (const PlacedPlane& plane : planes_)
      material_.push_back(setup_.materials->ofWall[plane.wall]);
  }
  indexOfId_.resize(size());
  activeList_.resize(size());
  mark_.assign(position_.size(), 2);
  if (predicts) {
    seenVelocity_ = velocity_;
    seenSpin_ = spin_;
  }
  followNumbers();
  beginForces();
}

/// Rebuilds all that follows from which sphere is where.
void Spheres::followNumbers() {
  for (std::size_t part = 0; part < shares_.size(); ++part)
    shares_[part].active = {activeList_.data() + lists_.partBegin(part), 0, mark_.data()};
  together([&](Share& share, std::size_t i, std::size_t end) {
    for (; i < end; ++i)
      if (mark_[i] != 0) share.active.list[share.active.count++] = static_cast<std::int32_t>(i);
  });
  for (std::size_t i = 0; i < size(); ++i) {
    const auto id = static_cast<std::size_t>(idAtIndex_[i]);
    indexOfId_[id] = static_cast<std::int32_t>(i);
    mass_[i] = setup_.mass[id];
    inverseMass_[i] = 1.0 / setup_.mass[id];
    if (law_.rotation) inverseInertia_[i] = 1.0 / setup_.inertia[id];
    if (setup_.materials) material_[i] = setup_.materials->ofDisk[id];
  }
}

/// Gives spheres numbers anew by their place, so that neighbours are near in memory.
void Spheres::renumber() {
  SpaceCells cells(setup_.box.value_or(SpaceBox{}));
  const double largest = setup_.radius.empty() ? 1.0 : *std::ranges::max_element(setup_.radius);
  cells.sort(std::span(position_).first(size()), 2.0 * largest);
  const std::span<const std::int32_t> order = cells.sorted();
  std::vector<std::byte> scratch;
  forState([&](auto& array) { reorder(array, order, scratch); });
  for (auto* array : {&seenVelocity_, &seenSpin_})
    if (!array->empty()) reorder(*array, order, scratch);
  followNumbers();
  std::vector<std::int32_t> newNumber(size());
  for (std::size_t i = 0; i < size(); ++i)
    newNumber[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
  list([&] { lists_.renumber(newNumber, position_, travel_, *team_); });
}

/// With gravity; the motion kernel does so in every step.
void Spheres::beginForces() {
  for (std::size_t i = 0; i < position_.size(); ++i) {
    force_[i] = i < size() ? quadOf(mass_[i] * setup_.gravity) : Quad{};
    if (law_.rotation) torque_[i] = {};
  }
}

Vector Spheres::velocity(std::size_t id) const {
  const std::size_t i = indexOf(id);
  return vectorOf(velocity_[i]) + (halfKick_ * inverseMass_[i]) * vectorOf(force_[i]);
}

Vector Spheres::spin(std::size_t id) const {
  if (!law_.rotation) return {};
  const std::size_t i = indexOf(id);
  return vectorOf(spin_[i]) + (halfKick_ * inverseInertia_[i]) * vectorOf(torque_[i]);
}

void Spheres::advance(std::uint64_t steps) {
  for (; steps > 0; --steps) {
    asked_ = steps == 1;
    team_->step([this] { step(); });
  }
}

void Spheres::kick(double dt) {
  together([&](Share& share, std::size_t, std::size_t) {
    for (std::size_t k = 0; k < share.active.count; ++k) {
      const auto i = static_cast<std::size_t>(share.active.list[k]);
      add(velocity_[i], vectorOf(force_[i]), dt * inverseMass_[i]);
      if (law_.rotation) add(spin_[i], vectorOf(torque_[i]), dt * inverseInertia_[i]);
    }
  });
}

SpaceMotionView Spheres::motionView(const ActiveSpheres& active) {
  return {position_.data(),
          velocity_.data(),
          law_.rotation ? spin_.data() : nullptr,
          seenVelocity_.empty() ? nullptr : seenVelocity_.data(),
          seenSpin_.empty() ? nullptr : seenSpin_.data(),
          force_.data(),
          torque_.data(),
          inverseMass_.data(),
          inverseInertia_.data(),
          mass_.data(),
          chosen_.data(),
          allowance_.data(),
          active,
          everyone_};
}

void Spheres::step() {
  const double dt = setup_.dt;
  const bool verlet = setup_.law.conventions.integrator == Integrator::velocityVerlet;
  const SpaceMotionConstants constants{verlet ? 0.5 * dt : dt, dt, 0.5 * dt, setup_.gravity};
  together([&](Share& share, std::size_t begin, std::size_t end) {
    share.moved = kernels_.motion(constants, motionView(share.active), begin, end);
    share.active.count = share.moved.active;
  });
  ++steps_;
  const auto now = static_cast<double>(steps_);
  outdated_ = false;
  for (const Share& share : shares_) {
    freeUntil_ = std::min(freeUntil_, now + std::floor(share.moved.freeSteps));
    if (!(share.moved.excess <= 0.0) || !std::isfinite(share.moved.squares)) outdated_ = true;
  }
  if (now > freeUntil_) outdated_ = true;
  moveWalls();
  if (outdated_) updateNeighbours();
  if (steps_ % renumberingInterval == 0) renumber();
  addForces();
  if (verlet) kick(0.5 * dt);
}

void Spheres::updateNeighbours() {
  list([&] { lists_.update(position_, travel_, steps_ - chosenAt_, *team_); });
}

/// Lists pairs: all spheres of walls are where they belong, and afterwards those in no pair are
/// left behind.
void Spheres::list(const std::function<void()>& pairs) {
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    for (std::size_t i = wallBegin_[w]; i < wallBegin_[w + 1]; ++i) placeWallSphere(w, i, false);
  findTravel();
  try {
    pairs();
  } catch (const NotFinite& lost) {
    throw std::runtime_error("the position of sphere " +
                             std::to_string(idOf(static_cast<std::int32_t>(lost.disk))) +
                             " is not finite at t = " + shortText(time()) + " s");
  }
  rememberChoice();
}

void Spheres::findTravel() {
  travel_.resize(position_.size());
  for (std::size_t i = 0; i < size(); ++i) travel_[i] = setup_.dt * length(vectorOf(velocity_[i]));
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    std::fill(
        travel_.begin() + static_cast<std::ptrdiff_t>(wallBegin_[w]),
        travel_.begin() + static_cast<std::ptrdiff_t>(wallBegin_[w + 1]),
        setup_.dt * (length(wallNow_[w].velocity) + wallReach_[w] * length(wallNow_[w].spin)));
}

void Spheres::rememberChoice() {
  chosen_ = position_;
  allowance_.assign(lists_.allowances().begin(), lists_.allowances().end());
  double steps = 1e9;
  for (std::size_t i = 0; i < allowance_.size(); ++i) {
    allowance_[i] *= 0.999;  // of sums of steps
    if (mark_[i] == 0 && allowance_[i] < steps * travel_[i]) steps = allowance_[i] / travel_[i];
  }
  freeUntil_ = static_cast<double>(steps_) + std::floor(steps);
  wallPath_.assign(setup_.walls.size(), 0.0);
  reached_.clear();
  lists_.forNear([&](const SpacePairs& pairs) {
    for (std::size_t p = 0; p < pairs.count; ++p)
      if (static_cast<std::size_t>(pairs.j[p]) >= size()) reached_.push_back(pairs.j[p]);
  });
  std::ranges::sort(reached_);
  reached_.erase(std::unique(reached_.begin(), reached_.end()), reached_.end());
  chosenAt_ = steps_;
  outdated_ = sampled_ = false;
}

SpaceView Spheres::view(const ActiveSpheres& active) {
  return {position_.data(),
          seenVelocities().data(),
          seenSpins().data(),
          inverseMass_.data(),
          inverseInertia_.data(),
          force_.data(),
          torque_.data(),
          active,
          material_.empty() ? nullptr : material_.data(),
          laws_.empty() ? nullptr : laws_.data(),
          setup_.materials ? static_cast<std::int32_t>(setup_.materials->count) : 0};
}

/// Contacts add to the spheres' forces in one order, whatever the number of threads: those with
/// spheres of lower parts, those inside the part, those with spheres of higher parts, planes. That
/// is the order of one list of all pairs, since parts are consecutive.
void Spheres::addForces() {
  for (Share& share : shares_) {
    share.touching = 0;
    share.deep = false;
  }
  const auto begin = std::chrono::steady_clock::now();
  if (shares_.size() > 1)
    team_->run(
        [&](std::size_t part) { addContacts(shares_[part], pairKernel_, lists_.across(part)); });
  team_->run([&](std::size_t part) {
    addFromLowerParts(part);
    addContacts(shares_[part], pairKernel_, lists_.inside(part));
    addFromHigherParts(part);
  });
  std::size_t touching = 0;
  for (const Share& share : shares_) touching += share.touching;
  if (!std::exchange(sampled_, true))  // one step in some measures for the lists what a pair costs
    lists_.pairsTook(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), touching);
  evaluations_ += touching;
  if (!planes_.empty())
    together([&](Share& share, std::size_t first, std::size_t end) {
      share.touching = 0;
      for (std::size_t p = 0; p < planes_.size(); ++p)
        addContacts(share, planeKernel_, viewOf(p, first, end));
    });
  for (const Share& share : shares_) {
    if (!planes_.empty()) evaluations_ += share.touching;
    if (share.deep) reportDeep();
  }
}

void Spheres::addContacts(Share& share, const auto& kernel, const auto& bodies) {
  auto asked = bodies;
  if (!asked_) asked.contacts = bodies.contacts.withoutResults();
  const double most = setup_.maxOverlap > 0.0 ? setup_.maxOverlap : 1e300;
  const SpaceReport report =
      kernel(law_, spaceConventions(setup_.law), view(share.active), asked, range_, most);
  share.active.count = report.active;
  share.touching += report.touching;
  share.deep |= report.deep;
}

void Spheres::addFromLowerParts(std::size_t part) {
  ActiveSpheres& active = shares_[part].active;
  for (std::size_t lower = 0; lower < part; ++lower) {
    const SpacePairs pairs = lists_.across(lower);
    for (std::size_t p = 0; p < pairs.count; ++p) {
      const auto j = static_cast<std::size_t>(pairs.j[p]);
      if (pairs.touches[p] == 0 || j < lists_.partBegin(part) || !lists_.isUpTo(part, j)) continue;
      active.push(j);
      force_[j] -= pairs.pushes[p].force;
      if (law_.rotation) torque_[j] += pairs.pushes[p].torqueJ;
    }
  }
}

void Spheres::addFromHigherParts(std::size_t part) {
  ActiveSpheres& active = shares_[part].active;
  const SpacePairs pairs = lists_.across(part);
  for (std::size_t p = 0; p < pairs.count; ++p) {
    if (pairs.touches[p] == 0) continue;
    const auto i = static_cast<std::size_t>(pairs.i[p]);
    active.push(i);
    force_[i] += pairs.pushes[p].force;
    if (law_.rotation) torque_[i] += pairs.pushes[p].torqueI;
  }
}

std::string Spheres::nameOfPlane(std::size_t p) const {
  const auto first = std::ranges::find_if(planes_, &PlacedPlane::isCylinder) - planes_.begin();
  const auto flat = static_cast<std::size_t>(first);
  return p < flat ? "plane " + std::to_string(p) : "cylinder " + std::to_string(p - flat);
}

void Spheres::reportDeep() {
  for (const SpaceContact& contact : contacts()) {
    const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
    double smallest = setup_.radius[i];
    if (j < position_.size()) smallest = std::min(smallest, position_[indexOf(j)].w);
    if (contact.overlap <= setup_.maxOverlap * smallest) continue;
    const std::string partner = j < size()             ? "sphere " + std::to_string(j)
                                : j < position_.size() ? "wall sphere " + std::to_string(j - size())
                                                       : nameOfPlane(j - position_.size());
    throw std::runtime_error("sphere " + std::to_string(i) + " and " + partner + " overlap by " +
                             shortText(contact.overlap / smallest) +
                             " of the smaller radius at t = " + shortText(time()) + " s");
  }
  throw std::runtime_error("two spheres have no distance at t = " + shortText(time()) + " s");
}

std::vector<SpaceContact> Spheres::contacts() {
  std::vector<SpaceContact> found;
  const auto add = [&](std::int32_t i, std::size_t j, const Vector& normal,
                       const SpaceResult& result) {
    std::int32_t a = idOf(i), b = idOf(static_cast<std::int32_t>(j));
    double sign = 1.0;
    if (b < a) {
      std::swap(a, b);
      sign = -1.0;
    }
    found.push_back({a, b, sign * normal, result.overlap, result.normal, sign * result.tangential,
                     sign * result.rolling, result.sliding > 0.0});
  };
  lists_.forNear([&](const SpacePairs& pairs) {
    for (std::size_t p = 0; p < pairs.count; ++p)
      if (pairs.touches[p] != 0)
        add(pairs.i[p], static_cast<std::size_t>(pairs.j[p]), vectorOf(pairs.contacts.touch[p]),
            pairs.contacts.result(p));
  });
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const SpaceContactView contacts = planes_[p].contacts.view();
    for (std::size_t i = 0; i < size(); ++i)
      if (planes_[p].touches[i] != 0)
        add(static_cast<std::int32_t>(i), position_.size() + p, vectorOf(contacts.touch[i]),
            contacts.result(i));
  }
  std::ranges::sort(found, {}, [](const SpaceContact& c) { return std::pair(c.i, c.j); });
  return found;
}

}  // namespace grain
