// A mirror is the in-house engine set to a peer's conventions, and has to follow that peer: where
// it does not, one of the two is wrong about what the peer does.
#include <algorithm>
#include <array>

#include "runs/conformance/check_list.hpp"

namespace crossgrain::conformance::mirror {
namespace {

constexpr const char* turns = "roundings, and springs that turn to first or higher order";

/// A mirror under examination, and its peer.
struct Pair {
  Exam& it;
  std::unique_ptr<Engine> peer = {};
  Capabilities canPeer = {};
  Settings settingsPeer = {};

  explicit Pair(Exam& exam) : it(exam) {
    const EngineEntry* entry = findEngine(it.entry.mirrors);
    it.require(entry != nullptr, said("there is no engine '", it.entry.mirrors, "'"));
    if (entry->missing)
      if (const std::string why = entry->missing(); !why.empty()) it.skip(why);
    peer = it.another(*entry);
    settingsPeer = entry->settings;
    canPeer = peer->capabilities();
    if (it.rigid() != (followed(canPeer, fullLaw()).normal == NormalLaw::rigid))
      it.skip("its peer has another normal law");
  }

  double allowed() const { return canPeer.precisions.front() == Precision::float32 ? 1e-5 : 1e-6; }

  /// Both run the scene, each with its own conventions, at the peer's time step.
  void load(Scene scene) {
    scene.law = followed(canPeer, scene.law);
    try {
      scene.dt = peer->load(scene, settingsPeer).dt;
    } catch (const UnsupportedScene& refusal) {
      it.skip(refusal.what());
    }
    scene.law = followed(it.can, scene.law);
    it.load(scene);
    it.equal(it.realised.dt, scene.dt, "the time step of the mirror");
  }

  /// Of an encounter's end, when nothing touches.
  void compareVelocities() {
    peer->advance(Encounter::end);
    const Snapshot theirs = peer->snapshot(ContactReport::none);
    const Snapshot ours = it.at(Encounter::end);
    const double unit = allowed() * Encounter::speed;
    for (std::size_t i = 0; i < ours.velocity.size(); ++i) {
      it.expect(close(ours.velocity[i], theirs.velocity[i], {unit, 0.0, turns}),
                said("velocity of disk ", i, " [m/s]"));
      it.expect(close(spinsOf(it.scene, ours)[i], spinsOf(it.scene, theirs)[i],
                      {unit / smallRadius, 0.0, turns}),
                said("spin of disk ", i, " [rad/s]"));
    }
  }

  void followThroughACollision(const ContactLaw& law) {
    Encounter encounter = crookedEncounter();
    // Box2D's position solver, which a mirror does not have, moves disks that overlap by more than
    // its slop.
    const double steps = it.rigid() ? 2000.0 : 50.0;
    for (const double obliqueness : {0.5, -1.0}) {
      encounter.obliqueness = obliqueness;
      load(encounterScene(encounter, law, steps));
      compareVelocities();
    }
  }

  /// Gravity and a moving wall act from the first step on. Only positions are compared: the two may
  /// show velocities of different times.
  void followThroughAHeap(const ContactLaw& law) {
    if (it.rigid()) it.skip("lets contacts collide one by one, its peer solves them together");
    load(busyScene(law));
    for (const double t : {0.01 * busyEnd, 0.1 * busyEnd, 0.5 * busyEnd}) {
      peer->advance(t);
      const Snapshot theirs = peer->snapshot(ContactReport::none);
      const Snapshot ours = it.at(t);
      it.requireEqual(ours.positionTime, theirs.positionTime, "position_time of the mirror");
      for (std::size_t i = 0; i < ours.position.size(); ++i)
        it.expect(
            close(ours.position[i], theirs.position[i], {allowed() * smallRadius, 0.0, turns}),
            said("disk ", i, " at t = ", t, " s [m]"));
    }
  }
};

void followsItsPeerThroughACollision(Exam& it) {
  Pair(it).followThroughACollision(fullLaw());
}

void followsItsPeerThroughAHeap(Exam& it) {
  Pair(it).followThroughAHeap(fullLaw());
}

void followsItsPeerOnAPlane(Exam& it) {
  Pair pair(it);
  pair.load(landingScene(fullLaw(), 50.0));
  pair.compareVelocities();
}

void followsItsPeerByHertzLaw(Exam& it) {
  Pair pair(it);
  if (std::ranges::count(pair.canPeer.lawOptions.at("normal"), "hertz") == 0)
    it.skip("its peer has another normal law");
  pair.followThroughACollision(hertzLaw());
  pair.followThroughAHeap(hertzLaw());
  pair.load(landingScene(hertzLaw(), 50.0));
  pair.compareVelocities();
}

}  // namespace

std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"FollowsItsPeerThroughACollision", "a mirror follows its peer through a collision",
            followsItsPeerThroughACollision},
      Check{"FollowsItsPeerThroughAHeap", "a mirror follows its peer through a heap",
            followsItsPeerThroughAHeap},
      Check{"FollowsItsPeerOnAPlane", "a mirror follows its peer on a plane",
            followsItsPeerOnAPlane},
      Check{"FollowsItsPeerByHertzLaw", "a mirror follows its peer by Hertz' law",
            followsItsPeerByHertzLaw},
  };
  return list;
}

}  // namespace crossgrain::conformance::mirror
