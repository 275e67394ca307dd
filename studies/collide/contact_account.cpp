#include "studies/collide/contact_account.hpp"

#include <algorithm>
#include <cmath>

#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Velocities and spins at one time, straight between those of two snapshots.
class Motions {
 public:
  void add(double time, const Snapshot& snapshot, const std::vector<double>& spinAtStart) {
    before_ = std::move(now_);
    now_ = {time, snapshot.velocity, snapshot.spin.value_or(spinAtStart)};
  }
  double latest() const { return now_.time; }
  Vec2 velocity(std::size_t disk, double time) const {
    const double weight = weightOfNow(time);
    if (weight == 1.0) return now_.velocity[disk];
    return weight * now_.velocity[disk] + (1.0 - weight) * before_.velocity[disk];
  }
  double spin(std::size_t disk, double time) const {
    const double weight = weightOfNow(time);
    if (weight == 1.0) return now_.spin[disk];
    return weight * now_.spin[disk] + (1.0 - weight) * before_.spin[disk];
  }

 private:
  struct Known {
    double time = 0.0;
    std::vector<Vec2> velocity;
    std::vector<double> spin;
  };
  double weightOfNow(double time) const {
    if (time == now_.time || before_.velocity.empty() || before_.time == now_.time) return 1.0;
    return (time - before_.time) / (now_.time - before_.time);
  }
  Known before_, now_;
};

/// One contact at one time.
struct ContactKinematics {
  double normalForce, tangentialForce, normalVelocity;
  double worked;  ///< the tangential velocity that f_t does work on
  double slip;    ///< v_t of the law
  bool slides;
};

ContactKinematics touchAt(const Contacts& contacts, std::size_t c, const ContactRecording& run,
                          const Motions& motions, double time) {
  const auto i = static_cast<std::size_t>(contacts.i[c]);
  const auto j = static_cast<std::size_t>(contacts.j[c]);
  const bool wall = run.pair.plane;
  const Vec2 velocity = motions.velocity(i, time) - (wall ? run.scene.bodies.front().motion.velocity
                                                          : motions.velocity(j, time));
  const LawConventions& how = run.law.conventions;
  const auto turning = [&](LeverArm arm) {
    const auto of = [&](int side) {
      return run.pair.radius[side] -
             leverFraction(arm, how.planeArm, run.pair, side) * contacts.overlap[c];
    };
    return of(0) * motions.spin(i, time) + (wall ? 0.0 : of(1) * motions.spin(j, time));
  };
  const Vec2& normal = contacts.normal[c];
  return {contacts.normalForce[c],
          contacts.tangentialForce[c],
          velocity.dot(normal),
          velocity.dot(perpendicular(normal)) - turning(how.leverArm),
          velocity.dot(perpendicular(normal)) - turning(how.armOfVelocity()),
          !contacts.sliding.empty() && contacts.sliding[c] != 0};
}

/// In the tangential spring, as far as the force tells [J].
double storedEnergy(const ContactLaw& law, const PairCoefficients& pair,
                    const ContactKinematics& touch) {
  const bool dashpot = law.tangential == TangentialLaw::springDashpot;
  if (!(pair.kt > 0.0) || (!dashpot && law.tangential != TangentialLaw::spring)) return 0.0;
  const bool dashpotActs =
      dashpot && (!touch.slides || law.conventions.springReset == SpringReset::springOnly);
  const double force = touch.tangentialForce + (dashpotActs ? pair.gt * touch.slip : 0.0);
  return 0.5 * force * force / pair.kt;
}

void addStep(ContactAccount& account, const ContactKinematics& touch, double stored, double dt) {
  const double normal = -touch.normalForce * touch.normalVelocity * dt;
  const double tangential = -touch.tangentialForce * touch.worked * dt;
  account.work.normal += normal;
  account.work.tangential += tangential;
  if (!account.split) return;
  account.split->normalDamping += normal;
  (touch.slides ? account.split->sliding : account.split->tangentialDamping) +=
      tangential - (stored - account.split->stored);
  account.split->stored = stored;
}

/// Sums what the contacts of one step did into the accounts.
class ContactWork {
 public:
  explicit ContactWork(const ContactRecording& run)
      : run_(run), accounts(run.scene.disks.size() / (run.pair.plane ? 1 : 2)) {
    if (!run.effective.pairs.empty()) pair_ = run.effective.pairs.front();
  }

  /// Contacts are summed when the velocities of their time are known.
  /// @returns how many pairs touch
  std::size_t add(const Snapshot& now) {
    motions_.add(timeOfVelocities(now, run_.effective.velocityLag), now, run_.scene.disks.spin);
    if (pending_ && motions_.latest() >= pendingTime_) sumPending();
    pending_ = now.contacts;
    pendingTime_ = now.contactTime;
    const std::size_t touching = pending_ ? touchingPairs().size() : 0;
    if (motions_.latest() >= pendingTime_) sumPending();
    return touching;
  }
  bool allMet() const {
    return std::ranges::all_of(accounts, [](const auto& account) { return bool(account); });
  }

 private:
  /// Places in the arrays of contacts.
  std::vector<std::size_t> touchingPairs() const {
    std::vector<std::size_t> places;
    for (std::size_t c = 0; c < pending_->size(); ++c)
      if (pending_->overlap[c] > 0.0 && isOfAPair(c)) places.push_back(c);
    return places;
  }
  bool isOfAPair(std::size_t c) const {
    const std::int32_t i = pending_->i[c], j = pending_->j[c];
    const auto disks = static_cast<std::int32_t>(run_.scene.disks.size());
    return run_.pair.plane ? i < disks && j >= disks : j == i + 1 && j < disks;
  }
  std::size_t pairOf(std::size_t c) const {
    const auto i = static_cast<std::size_t>(pending_->i[c]);
    return run_.pair.plane ? i : i / 2;
  }
  void sumPending() {
    if (!pending_) return;
    for (const std::size_t c : touchingPairs()) {
      auto& account = accounts[pairOf(c)];
      if (!account) {
        account.emplace();
        if (run_.slidingFlags && !run_.law.stiffens()) account->split.emplace();
      }
      account->maxOverlap = std::max(account->maxOverlap, pending_->overlap[c]);
      const ContactKinematics touch = touchAt(*pending_, c, run_, motions_, pendingTime_);
      addStep(*account, touch, storedEnergy(run_.law, pair_, touch), run_.effective.dt);
    }
    pending_.reset();
  }

  const ContactRecording& run_;
  PairCoefficients pair_;
  Motions motions_;
  std::optional<Contacts> pending_;
  double pendingTime_ = 0.0;

 public:
  std::vector<std::optional<ContactAccount>> accounts;
};

}  // namespace

std::vector<std::optional<ContactAccount>> recordContacts(Engine& engine,
                                                          const ContactRecording& run, double end) {
  const double dt = run.effective.dt;
  ContactWork work(run);
  work.add(engine.snapshot(ContactReport::none));
  const auto steps = std::llround(end / dt);
  bool over = false;
  for (long long step = 1; step <= steps && !over; ++step) {
    throwIfInterrupted();
    engine.advance(static_cast<double>(step) * dt);
    const Snapshot now = engine.snapshot(ContactReport::instant);
    if (now.contactInterval > 0.0) break;  // means over a step: no forces of one instant
    over = work.add(now) == 0 && work.allMet();
  }
  engine.advance(end);
  return work.accounts;
}

}  // namespace crossgrain::inline studies
