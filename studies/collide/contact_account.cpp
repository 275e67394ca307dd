#include "studies/collide/contact_account.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "adapters/pair_table.hpp"
#include "law/cohesion.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Of two along tangents, which are numbers in the plane.
double product(double a, double b) {
  return a * b;
}
double product(const Vec3& a, const Vec3& b) {
  return a.dot(b);
}

/// Velocities and spins at one time, straight between those of two snapshots.
template <int D>
class Motions {
 public:
  void add(double time, const SnapshotOf<D>& snapshot, const std::vector<SpinOf<D>>& spinAtStart) {
    before_ = std::move(now_);
    now_ = {time, snapshot.velocity, snapshot.spin.value_or(spinAtStart)};
  }
  double latest() const { return now_.time; }
  VecOf<D> velocity(std::size_t disk, double time) const {
    const double weight = weightOfNow(time);
    if (weight == 1.0) return now_.velocity[disk];
    return weight * now_.velocity[disk] + (1.0 - weight) * before_.velocity[disk];
  }
  SpinOf<D> spin(std::size_t disk, double time) const {
    const double weight = weightOfNow(time);
    if (weight == 1.0) return now_.spin[disk];
    return weight * now_.spin[disk] + (1.0 - weight) * before_.spin[disk];
  }

 private:
  struct Known {
    double time = 0.0;
    std::vector<VecOf<D>> velocity;
    std::vector<SpinOf<D>> spin;
  };
  double weightOfNow(double time) const {
    if (time == now_.time || before_.velocity.empty() || before_.time == now_.time) return 1.0;
    return (time - before_.time) / (now_.time - before_.time);
  }
  Known before_, now_;
};

/// One contact at one time.
template <int D>
struct ContactKinematics {
  double normalForce;
  SpinOf<D> tangentialForce;
  double normalVelocity;
  SpinOf<D> worked;  ///< the tangential velocity that f_t does work on
  SpinOf<D> slip;    ///< v_t of the law
  bool slides;
  SpinOf<D> torque, rollingSpin;  ///< M, and ω_r that it does work on
};

template <int D>
ContactKinematics<D> touchAt(const ContactsOf<D>& contacts, std::size_t c,
                             const ContactRecording<D>& run, const Motions<D>& motions,
                             double time) {
  const auto i = static_cast<std::size_t>(contacts.i[c]);
  const auto j = static_cast<std::size_t>(contacts.j[c]);
  const bool wall = run.pair.plane;
  const VecOf<D> velocity =
      motions.velocity(i, time) -
      (wall ? run.scene.bodies.front().motion.velocity : motions.velocity(j, time));
  const LawConventions& how = run.law.conventions;
  const VecOf<D>& normal = contacts.normal[c];
  const SpinOf<D> none = noSpin<D>(), spinI = motions.spin(i, time);
  const SpinOf<D> spinJ = wall ? none : motions.spin(j, time);
  /// Along the tangents, of surfaces that the spins turn at those arms.
  const auto along = [&](LeverArm arm) -> SpinOf<D> {
    const auto of = [&](int side) {
      return run.pair.radius[side] -
             leverFraction(arm, how.planeArm, run.pair, side) * contacts.overlap[c];
    };
    const SpinOf<D> turning = of(0) * spinI + (wall ? none : SpinOf<D>(of(1) * spinJ));
    if constexpr (D == 2)
      return velocity.dot(perpendicular(normal)) - turning;
    else
      return velocity - velocity.dot(normal) * normal - turning.cross(normal);
  };
  return {contacts.normalForce[c],
          contacts.tangentialForce[c],
          velocity.dot(normal),
          along(how.leverArm),
          along(how.armOfVelocity()),
          !contacts.sliding.empty() && contacts.sliding[c] != 0,
          contacts.rollingTorque.empty() ? none : contacts.rollingTorque[c],
          spinI - spinJ};
}

/// The parts of a law's rolling resistance and cohesion that its forces tell: of a rolling spring
/// with a dashpot they do not say which of both took what, and of a body that yields or lets go not
/// what its dashpot did where that follows the overlap or tension is cut.
EnergySplit partsOf(const ContactLaw& law) {
  EnergySplit split;
  const bool spring = law.rolling == RollingLaw::spring;
  if (law.rolling == RollingLaw::constantTorque || (spring && law.gr == 0.0)) split.rolling = 0.0;
  if (law.rolls() && !spring && !split.rolling) split.rollingDamping = 0.0;
  const bool known =
      law.gn == 0.0 || (law.normal == NormalLaw::linear && law.damper == Damper::constant &&
                        law.conventions.tension == Tension::allow);
  if (known && law.cohesion == CohesionLaw::elastoPlastic) split.plastic = 0.0;
  if (known && law.cohesion == CohesionLaw::jkr) split.detachment = 0.0;
  return split;
}

/// In the tangential spring, as far as the force shows it [J].
template <int D>
double storedEnergy(const ContactLaw& law, const PairCoefficients& pair,
                    const ContactKinematics<D>& touch) {
  const bool dashpot = law.tangential == TangentialLaw::springDashpot;
  if (!(pair.kt > 0.0) || (!dashpot && law.tangential != TangentialLaw::spring)) return 0.0;
  const bool dashpotActs =
      dashpot && (!touch.slides || law.conventions.springReset == SpringReset::springOnly);
  const SpinOf<D> force =
      touch.tangentialForce + (dashpotActs ? SpinOf<D>(pair.gt * touch.slip) : noSpin<D>());
  return 0.5 * product(force, force) / pair.kt;
}

template <int D>
void addStep(ContactAccount& account, const ContactLaw& law, const ContactKinematics<D>& touch,
             double stored, double dt) {
  double normal = -touch.normalForce * touch.normalVelocity * dt;
  const double tangential = -product(touch.tangentialForce, touch.worked) * dt;
  account.work.normal += normal;
  account.work.tangential += tangential;
  if (!account.split) return;
  const double rolling = -product(touch.torque, touch.rollingSpin) * dt;
  if (account.split->rolling) *account.split->rolling += rolling;
  if (account.split->rollingDamping) *account.split->rollingDamping += rolling;
  for (auto* body : {&account.split->plastic, &account.split->detachment})
    if (*body) {
      const double damped = law.gn * touch.normalVelocity * touch.normalVelocity * dt;
      **body += normal - damped;
      normal = damped;
    }
  account.split->normalDamping += normal;
  (touch.slides ? account.split->sliding : account.split->tangentialDamping) +=
      tangential - (stored - account.split->stored);
  account.split->stored = stored;
}

/// Sums what the contacts of one step did into the accounts.
template <int D>
class ContactWork {
 public:
  explicit ContactWork(const ContactRecording<D>& run)
      : run_(run), accounts(run.scene.disks.size() / (run.pair.plane ? 1 : 2)) {
    // Constants that an engine does not report are the law's.
    const std::vector<PairCoefficients>& pairs = run.effective.pairs;
    pair_ = pairs.empty() ? coefficientsOf(run.law) : pairs.front();
  }

  /// Contacts are summed when the velocities of their time are known.
  /// @returns how many pairs touch
  std::size_t add(const SnapshotOf<D>& now) {
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
      if (pending_->overlap[c] > -range_ && isOfAPair(c)) places.push_back(c);
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
        const bool shown = !run_.law.stiffens() || (run_.law.coheres() && !run_.law.springs());
        if (run_.slidingFlags && shown) account->split = partsOf(run_.law);
      }
      account->maxOverlap = std::max(account->maxOverlap, pending_->overlap[c]);
      const ContactKinematics<D> touch = touchAt(*pending_, c, run_, motions_, pendingTime_);
      addStep(*account, run_.law, touch, storedEnergy(run_.law, pair_, touch), run_.effective.dt);
    }
    pending_.reset();
  }

  const ContactRecording<D>& run_;
  PairCoefficients pair_;
  Motions<D> motions_;
  std::optional<ContactsOf<D>> pending_;
  double pendingTime_ = 0.0;
  /// How far beyond δ = 0 a contact that the engine shows may be a bond [m].
  double range_ = bondRange(run_.law, run_.pair.reducedRadius());

 public:
  std::vector<std::optional<ContactAccount>> accounts;
};

}  // namespace

template <int D>
std::vector<std::optional<ContactAccount>> recordContacts(Engine& engine,
                                                          const ContactRecording<D>& run,
                                                          double end) {
  const double dt = run.effective.dt;
  ContactWork<D> work(run);
  work.add(snapshotOf<D>(engine, ContactReport::none));
  const auto steps = std::llround(end / dt);
  bool over = false;
  for (long long step = 1; step <= steps && !over; ++step) {
    throwIfInterrupted();
    engine.advance(static_cast<double>(step) * dt);
    const SnapshotOf<D> now = snapshotOf<D>(engine, ContactReport::instant);
    if (now.contactInterval > 0.0) break;  // means over a step: no forces of one instant
    over = work.add(now) == 0 && work.allMet();
  }
  engine.advance(end);
  return work.accounts;
}
template std::vector<std::optional<ContactAccount>> recordContacts<2>(Engine&,
                                                                      const ContactRecording<2>&,
                                                                      double);
template std::vector<std::optional<ContactAccount>> recordContacts<3>(Engine&,
                                                                      const ContactRecording<3>&,
                                                                      double);

}  // namespace crossgrain::inline studies
