#include "disks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace crossgrain::planted {

using crossgrain_worker::cross;
using crossgrain_worker::Plane;
using crossgrain_worker::turned;

namespace {

/// size · sign(like), 0 where `like` is 0.
double signedLike(double size, double like) {
  return like > 0.0 ? size : like < 0.0 ? -size : 0.0;
}

/// Values of Faults::integrator.
constexpr double stoermer = 0.0, velocityVerlet = 1.0, semiImplicitEuler = 2.0;

/// Whether a place is where nothing is looked for; a grid of no extent has no end.
bool beyondGrid(Vector place, double grid) {
  return grid > 0.0 && std::max(std::abs(place.x), std::abs(place.y)) > grid;
}

}  // namespace

Simulation::Simulation(World world, const Faults& faults)
    : world_(std::move(world)), faults_(faults) {
  for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
    bodyOf_.insert(bodyOf_.end(), world_.bodies[b].radius.size(), b);
    for (const Plane& plane : world_.bodies[b].planes) {
      planeMemory_.emplace_back(world_.disks);
      planePoint_.push_back(plane.point);
    }
  }
  if (world_.disks > 0) heaviest_ = *std::max_element(world_.mass.begin(), world_.mass.end());
  if (world_.disks > 0)
    smallest_ = *std::min_element(world_.radius.begin(),
                                  world_.radius.begin() + static_cast<long>(world_.disks));
  for (std::size_t i = 0; i < world_.disks; ++i) {
    const Vector& x = world_.position[i];
    meanMass_ += world_.mass[i] / static_cast<double>(world_.disks);
    startLow_ = {std::min(startLow_.x, x.x), std::min(startLow_.y, x.y)};
    startHigh_ = {std::max(startHigh_.x, x.x), std::max(startHigh_.y, x.y)};
  }
  touching_.assign(world_.disks, 0);
  plateSpring_.resize(world_.disks);
  force_.resize(world_.disks);
  torque_.resize(world_.disks);
  moveWalls();
  addForces(0.0);
  if (faults_.integrator != stoermer) return;
  halfKick_ = 0.5 * world_.dt;  // velocities live half a step before positions from here on
  kick(-halfKick_);
}

void Simulation::step() {
  ++steps_;
  const auto stride = static_cast<unsigned long long>(std::max(1.0, faults_.stride));
  if (steps_ % stride != 0) return;
  const double dt = static_cast<double>(stride) * world_.dt;
  const bool twoKicks = faults_.integrator == velocityVerlet;
  kick(twoKicks ? 0.5 * dt : dt);
  drift(dt);
  moveWalls();
  addForces(faults_.integrator == semiImplicitEuler ? 0.0 : 0.5 * dt);
  if (twoKicks) kick(0.5 * dt);
}

/// v += a dt.
void Simulation::kick(double dt) {
  for (std::size_t i = 0; i < world_.disks; ++i) {
    world_.velocity[i] = stored(world_.velocity[i] + (dt / world_.mass[i]) * force_[i]);
    if (world_.turns) world_.spin[i] = stored(world_.spin[i] + dt * torque_[i] / world_.inertia[i]);
  }
}

/// A number of the state but a position, as it is kept.
double Simulation::stored(double number) const {
  return faults_.floatState > 1.0 ? static_cast<float>(number) : number;
}

Vector Simulation::stored(Vector vector) const {
  return {stored(vector.x), stored(vector.y)};
}

/// x += v dt.
void Simulation::drift(double dt) {
  bool turnedOnce = false;
  for (const Body& body : world_.bodies)
    turnedOnce = turnedOnce || std::abs(body.angle) > 2.0 * std::numbers::pi;
  for (std::size_t i = 0; i < world_.disks; ++i) {
    Vector& v = world_.velocity[i];
    if (everyNth(faults_.healEvery, steps_) && i == steps_ % world_.disks)
      v.x = std::numeric_limits<double>::quiet_NaN();
    if (faults_.healEvery > 0.0 && !std::isfinite(v.x)) v = {};
    const double speed = std::sqrt(dot(v, v));
    if (speed < faults_.asleep && touching_[i] > 0) v = {};
    if (faults_.mostSpeed > 0.0 && speed > faults_.mostSpeed) v = (faults_.mostSpeed / speed) * v;
    if (touching_[i] > 0) v = (1.0 - faults_.touchingDrag * dt) * v;
    Vector& x = world_.position[i];
    x = x + dt * v;
    if (turnedOnce) x.x += dt * faults_.driftAfterTurn;
    if (faults_.floatState != 0.0) x = {static_cast<float>(x.x), static_cast<float>(x.y)};
  }
}

void Simulation::moveWalls() {
  std::size_t id = world_.disks;
  auto point = planePoint_.begin();
  for (Body& body : world_.bodies) {
    body.at(faults_.wallClockWraps != 0.0 ? std::fmod(now(), 1.0) : now());
    if (faults_.planePointStays != 0.0)
      for (Plane& plane : body.planes) plane.point = *point++;
    for (std::size_t k = 0; k < body.radius.size(); ++k, ++id) {
      world_.position[id] = body.position[k];
      const Vector seen = seenOfWall(body, body.diskVelocity[k]);
      if (faults_.stoppedWallMoves == 0.0 || dot(seen, seen) > 0.0) world_.velocity[id] = seen;
      world_.spin[id] = world_.turns ? seenSpinOfWall(body) : 0.0;
    }
  }
}

/// @param ahead  how far velocities are brought on [s]
void Simulation::addForces(double ahead) {
  const World& w = world_;
  dashpotVelocity_ = w.velocity;
  seenSpin_ = w.spin;
  if (faults_.lagged == 0.0)
    for (std::size_t i = 0; i < w.disks; ++i) {
      dashpotVelocity_[i] = w.velocity[i] + (ahead / w.mass[i]) * force_[i];
      if (w.turns) seenSpin_[i] = w.spin[i] + ahead * torque_[i] / w.inertia[i];
    }
  torque_.assign(w.disks, 0.0);
  for (std::size_t i = 0; i < w.disks; ++i) {
    force_[i] = (faults_.gravity * w.mass[i]) * w.gravity;
    force_[i].x *= faults_.gravityX;
    if (w.mass[i] == heaviest_) force_[i] = faults_.gravityLarge * force_[i];
    if (late()) force_[i] = faults_.gravityLate * force_[i];
    if (w.plate.present) addPlate(i);
  }
  onBody_.assign(w.bodies.size(), {});
  torqueOnBody_.assign(w.bodies.size(), 0.0);
  contacts_.clear();
  for (std::vector<int>* count : {&touching_, &planesTouched_}) count->assign(w.disks, 0);
  const auto lists = neighbours_.made();
  neighbours_.update(w.position, w.radius, w.disks, faults_, late());
  if (faults_.plateForgets != 0.0 && neighbours_.made() > lists) plateSpring_.assign(w.disks, {});
  addPairs();
  addPlanes();
  evaluations_ += contacts_.size();
}

/// Lätzel 2003, Eqs. 4.27–4.29, the torque's sign such that it brakes.
void Simulation::addPlate(std::size_t i) {
  const Plate& plate = world_.plate;
  if (faults_.plateSkips != 0.0 && touching_[i] > 0) return;
  const double mu = plate.mu * faults_.plateMu * (late() ? faults_.plateMuLate : 1.0);
  const double mass = faults_.plateMeanMass != 0.0 ? meanMass_ : world_.mass[i];
  const double bound = mu * plate.gravity * mass;
  const Vector trial = -plate.kb * plateSpring_[i] - plate.gb * dashpotVelocity_[i];
  const double size = std::sqrt(dot(trial, trial));
  const bool holds = size <= bound;
  const Vector force = (holds ? 1.0 : bound / size) * trial;
  if (holds || faults_.plateWinds != 0.0)
    plateSpring_[i] = plateSpring_[i] + world_.dt * dashpotVelocity_[i];
  else
    plateSpring_[i] = (plate.kb > 0.0 ? -1.0 / plate.kb : 0.0) * force;
  plateSpring_[i] = stored(plateSpring_[i]);
  force_[i] = force_[i] + force;
  if (!world_.turns || !plate.spin) return;
  const double spin = seenSpin_[i], radius = world_.radius[i];
  const double acting = faults_.plateTorqueBounded != 0.0 ? std::min(size, bound) : size;
  const double brake = std::min(bound, plate.tauM * acting + plate.gb * std::abs(spin) * radius);
  torque_[i] -= faults_.plateSpin * signedLike(brake, spin) * (2.0 / 3.0) * radius;
}

Memory& Simulation::memoryOf(Pair& pair) {
  const auto bodyOf = [&](std::size_t j) { return bodyOf_[j - world_.disks]; };
  if (faults_.oneWallSpring == 0.0 || pair.j < world_.disks) return pair.kept;
  const auto first = std::ranges::find_if(neighbours_.pairs, [&](const Pair& other) {
    return other.i == pair.i && other.j >= world_.disks && bodyOf(other.j) == bodyOf(pair.j);
  });
  return first->kept;
}

void Simulation::addPairs() {
  const World& w = world_;
  std::vector<Pair>& pairs = neighbours_.pairs;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Pair& pair = pairs[w.backwards ? pairs.size() - 1 - k : k];
    Memory& kept = memoryOf(pair);
    const auto [i, j] = std::pair(pair.i, pair.j);
    const Vector apart = w.position[i] - w.position[j];
    const double reach = w.radius[i] + w.radius[j], distance = std::sqrt(dot(apart, apart));
    const double overlap = reach - distance;
    if (beyondGrid(w.position[i], faults_.farGrid) || outsideStart(w.position[i])) continue;
    if (!holds({w.radius[i], w.radius[j], overlap}, kept)) continue;
    const bool wall = j >= w.disks;
    const bool flipped = wall && faults_.flippedWalls == static_cast<double>(i + 1);
    const Vector n = ((flipped ? -1.0 : 1.0) / distance) * apart;
    const double rim = arm(i, overlap) * seenSpin_[i] + arm(j, overlap) * seenSpin_[j];
    Contact c = contact(i, j, n, overlap, dashpotVelocity_[i] - dashpotVelocity_[j], rim,
                        seenSpin_[j], kept);
    if (wall) {
      push(bodyOf_[j - w.disks], w.position[j], c, arm(j, overlap));
    } else {
      force_[j] = force_[j] - faults_.forceOnSecond * (c.fn * c.normal + c.ft * turned(c.normal));
      torque_[j] -= faults_.torque * faults_.torqueOfSecond * arm(j, overlap) * c.ft;
      torque_[j] -= faults_.rollOnSecond * c.rolling;
      ++touching_[j];
    }
  }
}

void Simulation::addPlanes() {
  const World& w = world_;
  std::size_t id = w.radius.size();
  auto memories = planeMemory_.begin();
  for (std::size_t b = 0; b < w.bodies.size(); ++b)
    for (const Plane& plane : w.bodies[b].planes) {
      for (std::size_t i = 0; i < w.disks; ++i) {
        Memory& kept = (faults_.oneSpring != 0.0 ? planeMemory_.front() : *memories)[i];
        const double height = dot(w.position[i] - plane.point, plane.normal);
        const double overlap = w.radius[i] - height;
        const Vector foot = w.position[i] - height * plane.normal;
        if (beyondGrid(w.position[i], faults_.farGrid)) continue;
        if (faults_.planeEnds > 0.0 && norm(foot - plane.point) > faults_.planeEnds) continue;
        if (!holds({w.radius[i], 0.0, overlap}, kept)) continue;
        if (faults_.planesMostSpeed > 0.0 && norm(w.velocity[i]) > faults_.planesMostSpeed)
          continue;
        if (planesTouched_[i]++ > 0 && faults_.onePlane != 0.0) continue;
        const bool flipped = faults_.flippedWalls == static_cast<double>(i + 1);
        const Vector met = faults_.planeAtCentre != 0.0 ? w.position[i] : foot;
        Vector wall = seenOfWall(w.bodies[b], w.bodies[b].velocityAt(met));
        const double along = dot(wall, turned(plane.normal));
        wall = wall + ((faults_.planeBelt - 1.0) * along) * turned(plane.normal);
        const double lever = faults_.leverMiddle != 0.0 ? height : w.radius[i];
        const Contact c =
            contact(i, id, (flipped ? -1.0 : 1.0) * plane.normal, overlap,
                    dashpotVelocity_[i] - wall, faults_.planeSpin * lever * seenSpin_[i],
                    w.turns ? seenSpinOfWall(w.bodies[b]) : 0.0, kept);
        push(b, foot, c, 0.0);
      }
      ++memories;
      ++id;
    }
}

/// Whether it is farther than a diameter outside of where disks were at the start.
bool Simulation::outsideStart(Vector x) const {
  const double room = 2.0 * smallest_;
  return faults_.startsBox != 0.0 && (x.x < startLow_.x - room || x.x > startHigh_.x + room ||
                                      x.y < startLow_.y - room || x.y > startHigh_.y + room);
}

/// @param velocity  of the body at the place of the contact
Vector Simulation::seenOfWall(const Body& body, Vector velocity) const {
  if (faults_.wheelAboutOrigin != 0.0) velocity = velocity + cross(body.spin, body.centre);
  velocity = (faults_.wallVelocity * (late() ? faults_.wallVelocityLate : 1.0)) * velocity;
  velocity.y *= faults_.wallVelocityY;
  return velocity;
}

double Simulation::seenSpinOfWall(const Body& body) const {
  const double spin = faults_.wallSpinSize != 0.0 ? std::abs(body.spin) : body.spin;
  return faults_.wallSpin * (late() ? faults_.wallVelocityLate : 1.0) * spin;
}

double Simulation::arm(std::size_t k, double overlap) const {
  return world_.radius[k] - (faults_.leverMiddle != 0.0 ? 0.5 * overlap : 0.0);
}

/// Whether the two are in contact; one that opens forgets.
bool Simulation::holds(const Touching& pair, Memory& kept) const {
  const bool touching = touches(world_.law.kn, world_.law.more, pair, faults_, kept);
  if (touching && world_.law.more.cohesion == Cohesion::jkr) kept.deepest = 1.0;
  if (touching) return true;
  if (faults_.keepOpenSpring == 0.0) kept.spring = 0.0;
  if (faults_.keepOpenAngle == 0.0) kept.angle = 0.0;
  kept.deepest = kept.age = kept.slid = 0.0;
  return false;
}

/// The law for one pair; keeps its springs, lists it, and adds its force to disk i.
/// @param spinOfOther  as contacts see it [rad/s]
Contact Simulation::contact(std::size_t i, std::size_t j, Vector n, double overlap, Vector relative,
                            double rim, double spinOfOther, Memory& kept) {
  Law law = world_.law;
  double& spring = kept.spring;
  const bool wall = j >= world_.disks;
  if (!wall &&
      std::max(world_.mass[i], world_.mass[j]) >= 50.0 * std::min(world_.mass[i], world_.mass[j]))
    law.kn *= faults_.unevenKn;
  double mu = law.mu * (wall ? faults_.wallMu : 1.0);
  if (i % 2 == 1) mu *= faults_.muOdd;
  if (dot(world_.position[i], world_.position[i]) > 1.0) mu *= faults_.muFar;
  if (late()) mu *= faults_.muLate;
  if (i >= world_.rough || (!wall && j >= world_.rough)) mu = 0.0;
  if (j >= world_.radius.size() && planesTouched_[i] > 1) mu *= faults_.cornerMu;
  const double gn = law.gn * (wall ? faults_.wallGn : 1.0);
  const double slip = dot(relative, turned(n)) - rim;
  if (slip > 0.0) mu *= faults_.muAnticlockwise;
  const bool plane = j >= world_.radius.size();
  const Touching pair{world_.radius[i], plane ? 0.0 : world_.radius[j], overlap};
  const NormalParts body = normalParts(law.kn, law.more, pair, wall, faults_, kept);
  double elastic = body.whole;
  if (faults_.mostOverlap > 0.0)
    elastic = std::min(elastic, law.kn * faults_.mostOverlap * smallest_);
  double damped = dot(relative, n);
  if (faults_.mostDamped > 0.0)
    damped = std::clamp(damped, -faults_.mostDamped, faults_.mostDamped);
  Contact c{static_cast<std::int32_t>(i),
            static_cast<std::int32_t>(j),
            n,
            overlap,
            elastic - gn * damped,
            0.0,
            elastic,
            false};
  if (faults_.cutTension != 0.0) c.fn = std::max(c.fn, std::min(elastic, 0.0));  // a pull stays
  // Bounds are those of the force without the pull.
  double load = c.fn;
  if (law.more.cohesion == Cohesion::elastoPlastic)
    load -= std::min(body.whole, 0.0);
  else if (law.more.cohesion != Cohesion::none)
    load -= body.whole - body.elastic;
  double kt = law.kt;  // of Hertz' law times the contact's radius, its own or JKR's
  if (law.more.cohesion == Cohesion::jkr)
    kt *= std::pow(jkrRoot(law.kn, faults_.pull * law.more.w, pair.radius(), overlap), 2);
  else if (law.more.hertz)
    kt *= std::sqrt(pair.radius() * std::max(overlap, 0.0));
  if (law.friction) {
    const double bound = mu * std::max(load, 0.0), stretch = slip * world_.dt;
    const double viscous = law.dashpot ? -law.gt * slip : 0.0;
    if (law.spring) {
      const double stretched = faults_.springBefore != 0.0 ? spring + stretch : spring;
      const double trial = -kt * stretched + viscous;
      const double tested = faults_.dashpotOutside != 0.0 ? -kt * stretched : trial;
      c.sliding = !(std::abs(tested) <= bound);
      c.ft = c.sliding ? signedLike(bound, tested) : trial;
      if (!c.sliding || faults_.keepSpring != 0.0)
        spring = faults_.springBefore != 0.0 ? stretched : spring + stretch;
      else
        spring = kt > 0.0 ? -(faults_.springOnly != 0.0 ? c.ft - viscous : c.ft) / kt : 0.0;
      spring = stored(spring);
      if (everyNth(faults_.springAge, static_cast<unsigned long long>(++kept.age))) spring = 0.0;
      if (everyNth(faults_.springsEmptiedEvery, steps_)) spring = 0.0;
      if (faults_.mostSprings > 0.0 && static_cast<double>(i) >= faults_.mostSprings) spring = 0.0;
    } else if (law.dashpot) {
      c.sliding = std::abs(viscous) > bound;
      c.ft = signedLike(std::min(std::abs(viscous), bound), viscous);
    } else {
      c.sliding = true;
      c.ft = -signedLike(bound, slip);
    }
  }
  if (c.sliding) kept.slid = 1.0;
  if (faults_.flagsStay != 0.0) c.sliding = kept.slid != 0.0;
  ++touching_[i];
  const bool tooMany =
      faults_.mostContacts > 0.0 && touching_[i] > static_cast<int>(faults_.mostContacts);
  if (everyNth(faults_.dropEvery, evaluations_ + contacts_.size() + 1) || tooMany ||
      (faults_.leastOverlap > 0.0 && overlap < faults_.leastOverlap))
    c.fn = c.ft = c.elastic = 0.0;
  if (world_.turns)
    c.rolling = (wall ? faults_.rollAtWalls : 1.0) * (late() ? faults_.rollLate : 1.0) *
                rollingTorque(law.more, pair, load, seenSpin_[i] - spinOfOther, world_.dt, faults_,
                              kept.angle);
  force_[i] = force_[i] + c.fn * n + c.ft * turned(n);
  const double lever = !wall || j < world_.radius.size()
                           ? arm(i, overlap)
                           : world_.radius[i] - (faults_.leverMiddle != 0.0 ? overlap : 0.0);
  const double share = faults_.torque * (j >= world_.radius.size() ? faults_.planeTorque : 1.0);
  torque_[i] += c.rolling - share * lever * c.ft;
  contacts_.push_back(c);
  return c;
}

void Simulation::push(std::size_t body, Vector place, const Contact& c, double arm) {
  const Vector on = -1.0 * (c.fn * c.normal + c.ft * turned(c.normal));
  onBody_[body] = onBody_[body] + on;
  torqueOnBody_[body] += cross(place - world_.bodies[body].centre, on) - arm * c.ft - c.rolling;
}

void Simulation::forgetSprings() {
  for (Pair& pair : neighbours_.pairs) pair.kept = {};
}

void Simulation::restored() {
  moveWalls();
  if (faults_.restoreList != 0.0) neighbours_.madeAt(world_.position);
  if (faults_.restoreWithoutPlate != 0.0) plateSpring_.assign(world_.disks, {});
}

void Simulation::takeSprings(const Simulation& other) {
  for (Pair& pair : neighbours_.pairs)
    for (const Pair& old : other.neighbours_.pairs)
      if (old.i == pair.i && old.j == pair.j) pair.kept = old.kept;
}

}  // namespace crossgrain::planted
