#include "engines/box2d/penalty_world.hpp"

#include <algorithm>

namespace box2d_granular {
namespace {

// Enough for Begin and End to enclose the true contact in spite of rounded positions, and so little
// that hardly any pair is looked at in vain.
double skinFor(const Model& model) {
  double smallest = extentOf(model);
  for (const Disk& disk : model.disks) smallest = std::min(smallest, disk.radius);
  return std::max(1e-3 * smallest, 8.0 * roundingAt(extentOf(model)));
}

}  // namespace

PenaltyWorld::PenaltyWorld(const Model& model, const ContactLaw& law,
                           std::optional<BottomPlate> plate, std::optional<PairLaws> pairs)
    : law_(law),
      pairs_(std::move(pairs)),
      plate_(plate),
      gravity_(model.gravity),
      dt_(model.dt),
      rotation_(model.rotation && law.friction()),
      walls_(model.walls),
      members_(model),
      world_(model, skinFor(model)),
      force_(model.disks.size()) {
  for (const Disk& disk : model.disks) {
    mass_.push_back(disk.mass);
    inertia_.push_back(disk.inertia);
  }
  if (law.friction()) torque_.resize(model.disks.size());
  if (plate_) plateSpring_.resize(model.disks.size());
  world_.box2d().SetContactListener(this);
  showBox2d();
  evaluateForces();
  contactEvaluations_ = 0;
}

void PenaltyWorld::step() {
  integrate();
  ++steps_;
  moveWalls();
  showBox2d();
  evaluateForces();
}

void PenaltyWorld::integrate() {
  for (std::size_t i = 0; i < members_.disks; ++i) {
    members_.velocity[i] = members_.velocity[i] + (dt_ / mass_[i]) * force_[i];
    members_.position[i] = members_.position[i] + dt_ * members_.velocity[i];
  }
  if (!rotation_) return;
  for (std::size_t i = 0; i < members_.disks; ++i)
    members_.spin[i] += dt_ * torque_[i] / inertia_[i];
}

void PenaltyWorld::moveWalls() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (!walls_[w].moves) continue;
    members_.place(w, walls_[w].pose(time()));
    world_.placeWall(w, members_.pose[w]);
  }
}

void PenaltyWorld::showBox2d() {
  for (std::size_t i = 0; i < members_.disks; ++i)
    world_.disk(i).SetTransform(world_.toUnits(members_.position[i]), 0.0f);
  world_.coverPlanes();
  world_.box2d().Step(0.0f, 0, 0);
}

void PenaltyWorld::BeginContact(b2Contact* contact) {
  const std::int32_t a = World::id(contact->GetFixtureA());
  const std::int32_t b = World::id(contact->GetFixtureB());
  slot_[contact] = contacts_.size();
  contacts_.push_back({std::min(a, b), std::max(a, b)});
  owner_.push_back(contact);
}

void PenaltyWorld::EndContact(b2Contact* contact) {
  const auto found = slot_.find(contact);
  const std::size_t freed = found->second;
  slot_.erase(found);
  if (freed + 1 < contacts_.size()) {
    contacts_[freed] = contacts_.back();
    owner_[freed] = owner_.back();
    slot_[owner_[freed]] = freed;
  }
  contacts_.pop_back();
  owner_.pop_back();
}

void PenaltyWorld::evaluateForces() {
  for (std::size_t i = 0; i < members_.disks; ++i) force_[i] = mass_[i] * gravity_;
  std::ranges::fill(torque_, 0.0);
  withPartsOf(law_, [this]<bool Damped, TangentialLaw T>() { addContactForces<Damped, T>(); });
  if (plate_) addPlateForces();
}

PenaltyWorld::Levers PenaltyWorld::levers(const SoftContact& contact) const {
  const double a = members_.radius[static_cast<std::size_t>(contact.i)];
  const bool yielding = law_.conventions.leverArm == LeverArm::contactPoint;
  const double overlap = contact.geometry.overlap;
  // A plane does not yield: the contact point lies on it.
  if (members_.isPlane(contact.j)) return {yielding ? a - overlap : a, 0.0};
  const double b = members_.radius[static_cast<std::size_t>(contact.j)];
  if (!yielding) return {a, b};
  return {a - overlap * b / (a + b), b - overlap * a / (a + b)};
}

Vector PenaltyWorld::footOnPlane(const SoftContact& contact) const {
  const auto i = static_cast<std::size_t>(contact.i);
  const double height = members_.radius[i] - contact.geometry.overlap;
  return members_.position[i] - height * contact.geometry.normal;
}

/// Velocity of a plane where a disk touches it.
Vector PenaltyWorld::planeVelocity(const SoftContact& contact) const {
  const Pose& pose = members_.pose[members_.wallOf(contact.j)];
  return pose.velocity + pose.spin * turned(footOnPlane(contact) - pose.centre);
}

const ContactLaw& PenaltyWorld::lawOf(const SoftContact& contact) const {
  if (!pairs_) return law_;
  const auto of = [&](std::int32_t id) {
    return static_cast<std::size_t>(pairs_->material[static_cast<std::size_t>(id)]);
  };
  return pairs_->laws[of(contact.i) * pairs_->count + of(contact.j)];
}

/// R₁₂ [m].
double PenaltyWorld::radiusOf(const SoftContact& contact) const {
  const double a = members_.radius[static_cast<std::size_t>(contact.i)];
  if (members_.isPlane(contact.j)) return a;
  const double b = members_.radius[static_cast<std::size_t>(contact.j)];
  return a * b / (a + b);
}

/// m₁₂ [kg]; walls are infinitely heavy.
double PenaltyWorld::massOf(const SoftContact& contact) const {
  const double a = mass_[static_cast<std::size_t>(contact.i)];
  if (members_.isWall(contact.j)) return a;
  const double b = mass_[static_cast<std::size_t>(contact.j)];
  return a * b / (a + b);
}

template <bool Damped, TangentialLaw T>
void PenaltyWorld::addContactForces() {
  for (SoftContact& contact : contacts_) {
    contact.geometry = pairGeometry(members_, contact.i, contact.j);
    const auto [n, overlap] = contact.geometry;
    contact.touching = overlap > 0.0;
    if (!contact.touching) {
      contact.spring = 0.0;
      continue;
    }
    ++contactEvaluations_;

    const auto i = static_cast<std::size_t>(contact.i);
    const auto j = static_cast<std::size_t>(contact.j);
    const bool plane = members_.isPlane(contact.j);
    const Vector v = members_.velocity[i] - (plane ? planeVelocity(contact) : members_.velocity[j]);
    double vt = 0.0;
    Levers lever{};
    if constexpr (T != TangentialLaw::none) {
      lever = levers(contact);
      vt = dot(v, turned(n)) - lever.i * members_.spin[i];
      if (!plane) vt -= lever.j * members_.spin[j];
    }
    const ContactLaw& law = lawOf(contact);
    PairMotion motion{overlap, dot(v, n), vt, dt_};
    if (law.normal == NormalLaw::hertz) motion.radius = radiusOf(contact);
    if (law.damper == Damper::critical) motion.mass = massOf(contact);
    contact.force = contactForce<Damped, T>(law, motion, contact.spring);

    const Vector onI = contact.force.normal * n + contact.force.tangential * turned(n);
    const bool wall = members_.isWall(contact.j);
    force_[i] = force_[i] + onI;
    if (!wall) force_[j] = force_[j] - onI;
    if constexpr (T != TangentialLaw::none) {
      torque_[i] -= lever.i * contact.force.tangential;
      if (!wall) torque_[j] -= lever.j * contact.force.tangential;
    }
  }
}

std::vector<WallLoad> PenaltyWorld::wallLoads() const {
  std::vector<WallLoad> loads(walls_.size());
  for (const SoftContact& contact : contacts_) {
    if (!contact.touching || !members_.isWall(contact.j)) continue;
    const std::size_t w = members_.wallOf(contact.j);
    const Vector n = contact.geometry.normal;
    const Vector onWall = -contact.force.normal * n - contact.force.tangential * turned(n);
    const Vector at = members_.isPlane(contact.j)
                          ? footOnPlane(contact)
                          : members_.position[static_cast<std::size_t>(contact.j)];
    loads[w].force = loads[w].force + onWall;
    loads[w].torque +=
        cross(at - members_.pose[w].centre, onWall) - levers(contact).j * contact.force.tangential;
  }
  return loads;
}

/// f* = −k_b ξ − γ_b v limited to µ_b m g, ξ a vector for each disk that is set to −f/k_b where it
/// slips; f_M* = −sign(ω) τ_M |f*| − γ_b ω a limited to the same bound, torque (2/3) a f_M.
void PenaltyWorld::addPlateForces() {
  for (std::size_t i = 0; i < members_.disks; ++i) {
    const double bound = plate_->mu * mass_[i] * plate_->gravity;
    const Vector v = members_.velocity[i];
    Vector force = -plate_->kb * plateSpring_[i] - plate_->gb * v;
    const double trial = std::sqrt(dot(force, force));
    if (trial <= bound) {
      plateSpring_[i] = plateSpring_[i] + dt_ * v;
    } else {
      force = (bound / trial) * force;
      if (plate_->kb > 0.0) plateSpring_[i] = (-1.0 / plate_->kb) * force;
    }
    force_[i] = force_[i] + force;
    const double spin = members_.spin[i];
    if (!rotation_ || !plate_->spin || spin == 0.0) continue;
    const double brake = plate_->tauM * trial + plate_->gb * std::abs(spin) * members_.radius[i];
    torque_[i] -= std::copysign(std::min(bound, brake), spin) * (2.0 / 3.0) * members_.radius[i];
  }
}

double PenaltyWorld::kineticEnergy() const {
  double energy = 0.0;
  for (std::size_t i = 0; i < members_.disks; ++i) {
    energy += 0.5 * mass_[i] * dot(members_.velocity[i], members_.velocity[i]);
    if (rotation_) energy += 0.5 * inertia_[i] * members_.spin[i] * members_.spin[i];
  }
  return energy;
}

double PenaltyWorld::elasticEnergy() const {
  double energy = 0.0;
  for (const SoftContact& contact : contacts_)
    if (contact.touching)
      energy +=
          storedEnergy(lawOf(contact), contact.geometry.overlap, radiusOf(contact), contact.spring);
  return energy;
}

}  // namespace box2d_granular
