// A mirror is the in-house engine set to a peer's conventions, and has to follow that peer: where
// it does not, one of the two is wrong about what the peer does.
#include <algorithm>

#include "tests/conformance/conformance.hpp"
#include "tests/conformance/names.hpp"

namespace crossgrain::test {
namespace {

class MirrorConformance : public Conformance {
 protected:
  void SetUp() override {
    Conformance::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    const EngineEntry* peer = findEngine(entry_->mirrors);
    ASSERT_TRUE(peer) << "there is no engine '" << entry_->mirrors << "'";
    if (peer->missing)
      if (const std::string why = peer->missing(); !why.empty()) GTEST_SKIP() << why;
    peer_ = startWorker(*peer);
    canPeer_ = peer_->capabilities();
    if (rigid() != (followed(canPeer_, fullLaw()).normal == NormalLaw::rigid))
      GTEST_SKIP() << "its peer has another normal law";
  }

  /// Both run the scene, each with its own conventions, at the peer's time step.
  /// @returns why one of them cannot
  std::optional<std::string> refusedByEither(Scene scene) {
    scene.law = followed(canPeer_, scene.law);
    try {
      scene.dt = peer_->load(scene, {}).dt;
    } catch (const UnsupportedScene& refusal) {
      return refusal.what();
    }
    scene.law = followed(can_, scene.law);
    if (const auto why = refused(scene)) return why;
    EXPECT_EQ(realised_.dt, scene.dt);
    return std::nullopt;
  }

  void followThroughACollision(const ContactLaw& law) {
    Encounter pair = crookedEncounter();
    // Box2D's position solver, which a mirror does not have, moves disks that overlap by more than
    // its slop.
    const double steps = rigid() ? 2000.0 : 50.0;
    for (const double obliqueness : {0.5, -1.0}) {
      pair.obliqueness = obliqueness;
      if (const auto why = refusedByEither(encounterScene(pair, law, steps))) GTEST_SKIP() << *why;
      compareVelocities();
    }
  }

  /// Gravity and a moving wall act from the first step on. Only positions are compared: the two may
  /// show velocities of different times.
  void followThroughAHeap(const ContactLaw& law) {
    if (rigid()) GTEST_SKIP() << "lets contacts collide one by one, its peer solves them together";
    if (const auto why = refusedByEither(busyScene(law))) GTEST_SKIP() << *why;
    for (const double t : {0.01 * busyEnd, 0.1 * busyEnd, 0.5 * busyEnd}) {
      peer_->advance(t);
      const Snapshot theirs = peer_->snapshot(ContactReport::none);
      const Snapshot ours = at(t);
      ASSERT_EQ(ours.positionTime, theirs.positionTime);
      for (std::size_t i = 0; i < ours.position.size(); ++i) {
        EXPECT_TRUE(
            close(ours.position[i], theirs.position[i], {allowed() * smallRadius, 0.0, turns}))
            << "disk " << i << " at t = " << t << " s";
      }
    }
  }

  /// Of an encounter's end, when nothing touches.
  void compareVelocities() {
    peer_->advance(Encounter::end);
    const Snapshot theirs = peer_->snapshot(ContactReport::none);
    const Snapshot ours = at(Encounter::end);
    const double unit = allowed() * Encounter::speed;
    for (std::size_t i = 0; i < ours.velocity.size(); ++i) {
      EXPECT_TRUE(close(ours.velocity[i], theirs.velocity[i], {unit, 0.0, turns}));
      EXPECT_TRUE(close(spinsOf(scene_, ours)[i], spinsOf(scene_, theirs)[i],
                        {unit / smallRadius, 0.0, turns}));
    }
  }

  bool peerHasHertz() const {
    return std::ranges::count(canPeer_.lawOptions.at("normal"), "hertz") > 0;
  }

  double allowed() const { return canPeer_.precisions.front() == Precision::float32 ? 1e-5 : 1e-6; }

  static constexpr const char* turns = "roundings, and springs that turn to first or higher order";
  std::unique_ptr<Engine> peer_;
  Capabilities canPeer_;
};

TEST_P(MirrorConformance, FollowsItsPeerThroughACollision) {
  followThroughACollision(fullLaw());
}

TEST_P(MirrorConformance, FollowsItsPeerThroughAHeap) {
  followThroughAHeap(fullLaw());
}

TEST_P(MirrorConformance, FollowsItsPeerOnAPlane) {
  if (const auto why = refusedByEither(landingScene(fullLaw(), 50.0))) GTEST_SKIP() << *why;
  compareVelocities();
}

TEST_P(MirrorConformance, FollowsItsPeerByHertzLaw) {
  if (!peerHasHertz()) GTEST_SKIP() << "its peer has another normal law";
  followThroughACollision(hertzLaw());
  followThroughAHeap(hertzLaw());
  if (const auto why = refusedByEither(landingScene(hertzLaw(), 50.0))) GTEST_SKIP() << *why;
  compareVelocities();
}

std::vector<std::string> mirrors() {
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry())
    if (!entry.mirrors.empty()) names.push_back(entry.name);
  return names;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MirrorConformance);
INSTANTIATE_TEST_SUITE_P(Mirrors, MirrorConformance, testing::ValuesIn(mirrors()),
                         [](const auto& one) { return testName(one.param); });

}  // namespace
}  // namespace crossgrain::test
