#include "engines/box2d/impulse_world.hpp"

#include <algorithm>
#include <cmath>

namespace box2d_granular {
namespace {

// v_B − v_A at a point of contact, in units.
b2Vec2 relativeVelocity(b2Contact* contact, const b2Vec2& point) {
  return contact->GetFixtureB()->GetBody()->GetLinearVelocityFromWorldPoint(point) -
         contact->GetFixtureA()->GetBody()->GetLinearVelocityFromWorldPoint(point);
}

}  // namespace

ImpulseWorld::ImpulseWorld(const Model& model, ImpulseOptions options)
    : options_(std::move(options)),
      dt_(model.dt),
      gravity_(model.gravity),
      restSpeed_(2.0 * std::hypot(model.gravity.x, model.gravity.y) * model.dt),
      walls_(model.walls),
      members_(model),
      world_(model, 0.0),
      ahead_(model.walls.size()),
      behind_(model.walls.size()),
      lastOnWalls_(model.walls.size()),
      sumOnWalls_(model.walls.size()),
      sums_(model.disks.size()) {
  world_.box2d().SetContactListener(this);
}

void ImpulseWorld::step() {
  setWallsMoving();
  world_.coverPlanes();
  touching_.clear();
  turnedBack_.clear();
  oneOfTwo_.clear();
  world_.box2d().Step(static_cast<float>(dt_), options_.velocityIterations,
                      options_.positionIterations);
  harvest();
  ++steps_;
}

/// Box2D carries walls on by their float velocities; each step starts from where they should be, so
/// no error builds up.
void ImpulseWorld::setWallsMoving() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    if (!walls_[w].moves) continue;
    const Pose now = walls_[w].pose(time());
    const Pose next = walls_[w].pose(time() + dt_);
    behind_[w] = ahead_[w];
    ahead_[w] = {(1.0 / dt_) * (next.centre - now.centre), (next.angle - now.angle) / dt_};
    if (steps_ == 0) behind_[w] = ahead_[w];
    members_.pose[w] = now;
    world_.placeWall(w, now);
    world_.moveWall(w, ahead_[w].velocity, ahead_[w].spin);
  }
}

void ImpulseWorld::BeginContact(b2Contact* contact) {
  const std::int32_t a = World::id(contact->GetFixtureA());
  const std::int32_t b = World::id(contact->GetFixtureB());
  const Restitution restitution = options_.restitution(std::min(a, b), std::max(a, b));
  contact->SetFriction(static_cast<float>(options_.friction));
  contact->SetRestitution(static_cast<float>(restitution.normal));
  contact->SetRestitutionThreshold(world_.toUnits({restSpeed_, 0.0}).x);
  if (restitution.tangential == 0.0) return;

  b2WorldManifold manifold;
  contact->GetWorldManifold(&manifold);
  const b2Vec2 approach = relativeVelocity(contact, manifold.points[0]);
  const double normalSpeed = world_.toMetres({b2Dot(approach, manifold.normal), 0.0f}).x;
  if (normalSpeed > -options_.impactSpeed) return;
  const float tangentSpeed = b2Dot(approach, b2Cross(manifold.normal, 1.0f));
  contact->SetTangentSpeed(-static_cast<float>(restitution.tangential) * tangentSpeed);
  turnedBack_.push_back(contact);
  ++impacts_;
}

void ImpulseWorld::PreSolve(b2Contact* contact, const b2Manifold*) {
  const std::int32_t a = World::id(contact->GetFixtureA());
  const std::int32_t b = World::id(contact->GetFixtureB());
  b2WorldManifold manifold;  // its normal points from A to B
  contact->GetWorldManifold(&manifold);
  const double towardsI = b < a ? 1.0 : -1.0;
  Touching& touch =
      touching_.emplace_back(Touching{contact,
                                      std::min(a, b),
                                      std::max(a, b),
                                      {towardsI * static_cast<double>(manifold.normal.x),
                                       towardsI * static_cast<double>(manifold.normal.y)},
                                      contact->GetManifold()->pointCount,
                                      {},
                                      {}});
  for (int k = 0; k < touch.count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    touch.point[n] = world_.toMetres(manifold.points[k]);
    touch.depth[n] = -world_.toMetres({manifold.separations[k], 0.0f}).x;
  }
  if (members_.isWall(touch.j)) actBeforeTheKick(touch);
}

/// Of two points that are too near each other for the solver Box2D takes the first alone, and
/// leaves the other's old impulse where it was.
void ImpulseWorld::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  if (impulse->count < contact->GetManifold()->pointCount) oneOfTwo_.push_back(contact);
}

/// Box2D reflects the velocity that already holds the coming kick, of gravity or of a wall that
/// speeds up: a ball would gain g dt at every bounce. So the restitution of this step is such that
/// the velocity before the kick comes back. Two disks get the same kick. Points of a convex body
/// have one restitution: that of the point which comes fastest.
void ImpulseWorld::actBeforeTheKick(const Touching& touch) {
  const auto i = static_cast<std::size_t>(touch.i);
  const std::size_t w = members_.wallOf(touch.j);
  const b2Body& body = world_.disk(i);
  const double speed = dot(world_.toMetres(body.GetLinearVelocity()), touch.normal);
  // Of a disk the surface's own speed is across the normal.
  const auto turning = [&](Vector point) {
    if (members_.turn.empty()) return 0.0;
    const Vector arm = point - world_.toMetres(body.GetPosition());
    return static_cast<double>(body.GetAngularVelocity()) * cross(arm, touch.normal);
  };
  Vector point = touch.point[0];
  if (touch.count > 1 && turning(touch.point[1]) < turning(point)) point = touch.point[1];
  const Vector arm = point - members_.pose[w].centre;
  const auto along = [&](const Motion& wall, Vector at) {
    return dot(wall.velocity + wall.spin * turned(at), touch.normal);
  };
  // Of a wall disk the centre goes round; its surface only slides past when it spins.
  const Vector radius = members_.isPlane(touch.j)
                            ? Vector{}
                            : members_.radius[static_cast<std::size_t>(touch.j)] * touch.normal;
  const double ahead = along(ahead_[w], arm);
  const double behind = along(behind_[w], turned(-behind_[w].spin * dt_, arm - radius));
  const double disk = speed + turning(point);
  const double before = disk - behind;
  const double kicked = disk + dt_ * dot(gravity_, touch.normal) - ahead;
  if (!(kicked < 0.0)) return;
  const double share = std::max(0.0, before / kicked);
  touch.contact->SetRestitution(
      static_cast<float>(share * options_.restitution(touch.i, touch.j).normal));
}

void ImpulseWorld::harvest() {
  last_.clear();
  lastPoints_.clear();
  std::ranges::fill(lastOnWalls_, WallImpulse{});
  for (const Touching& touch : touching_) {
    const bool one = std::ranges::find(oneOfTwo_, touch.contact) != oneOfTwo_.end();
    for (int k = 0; k < (one ? 1 : touch.count); ++k) {
      const b2ManifoldPoint& solved = touch.contact->GetManifold()->points[k];
      // Box2D's tangent is the normal turned by −90°; with either order of A and B that is −(z × n)
      // for a force on i.
      const PairImpulse impulse{touch.i, touch.j, world_.toMetres({solved.normalImpulse, 0.0f}).x,
                                -world_.toMetres({solved.tangentImpulse, 0.0f}).x};
      const auto n = static_cast<std::size_t>(k);
      if (members_.turn.empty()) {
        last_.push_back(impulse);
        addToSum(impulse);
      } else {
        addToPoints(impulse, touch, n);
      }
      if (!members_.isWall(touch.j)) continue;
      const std::size_t w = members_.wallOf(touch.j);
      const Vector onWall =
          -impulse.normal * touch.normal + -impulse.tangential * turned(touch.normal);
      const Vector arm = touch.point[n] - members_.pose[w].centre;
      for (auto* load : {&lastOnWalls_[w], &sumOnWalls_[w]}) {
        load->linear = load->linear + onWall;
        load->angular += cross(arm, onWall);
      }
    }
  }
  contactEvaluations_ += touching_.size();
  for (b2Contact* contact : turnedBack_) contact->SetTangentSpeed(0.0f);
}

void ImpulseWorld::addToSum(const PairImpulse& impulse) {
  if (impulse.normal == 0.0 && impulse.tangential == 0.0) return;
  std::vector<PairImpulse>& ofDisk = sums_[static_cast<std::size_t>(impulse.i)];
  const auto found = std::ranges::find(ofDisk, impulse.j, &PairImpulse::j);
  if (found == ofDisk.end()) {
    ofDisk.push_back(impulse);
    return;
  }
  found->normal += impulse.normal;
  found->tangential += impulse.tangential;
}

void ImpulseWorld::addToPoints(const PairImpulse& impulse, const Touching& touch,
                               std::size_t point) {
  if (impulse.normal == 0.0 && impulse.tangential == 0.0) return;
  const Vector onI = impulse.normal * touch.normal + impulse.tangential * turned(touch.normal);
  for (PairPoints* points : {&lastPoints_, &pointSums_})
    (*points)[{impulse.i, impulse.j}].add(touch.normal, impulse.normal, onI, touch.point[point],
                                          touch.depth[point]);
}

std::vector<PairImpulse> ImpulseWorld::sums() const {
  std::vector<PairImpulse> all;
  for (const auto& ofDisk : sums_) all.insert(all.end(), ofDisk.begin(), ofDisk.end());
  return all;
}

void ImpulseWorld::clearSums() {
  for (auto& ofDisk : sums_) ofDisk.clear();
  pointSums_.clear();
  std::ranges::fill(sumOnWalls_, WallImpulse{});
  sumsFrom_ = steps_;
}

const Members& ImpulseWorld::members() {
  for (std::size_t i = 0; i < members_.disks; ++i) {
    const b2Body& disk = world_.disk(i);
    members_.position[i] = world_.toMetres(disk.GetPosition());
    members_.velocity[i] = world_.toMetres(disk.GetLinearVelocity());
    members_.spin[i] = static_cast<double>(disk.GetAngularVelocity());
    if (!members_.turn.empty()) members_.turn[i] = static_cast<double>(disk.GetAngle());
  }
  for (std::size_t w = 0; w < walls_.size(); ++w)
    if (walls_[w].moves) members_.place(w, walls_[w].pose(time()));
  return members_;
}

}  // namespace box2d_granular
