// load, advance, snapshot, load again: what every run relies on.
#include <algorithm>
#include <cmath>
#include <vector>

#include "runs/conformance/check_list.hpp"
#include "runs/conformance/exam.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::conformance::lifecycle {
namespace {

void advancesByWholeSteps(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const double dt = it.realised.dt;
  const Tolerance rounding = {0.0, 1e-12, "steps·dt in one order of additions or another"};
  std::vector<double> stops = {0.0, 0.3, 1.0, 10.4, 10.6, 11.0};
  while (stops.back() < 40.0) stops.push_back(stops.back() + 1.0);  // as often as a run is stopped
  for (const double steps : stops) {
    const double reached = it.engine().advance(steps * dt);
    const auto whole = static_cast<double>(std::llround(steps));
    it.expect(close(reached, whole * dt, rounding), said("advance to ", steps, " steps"));
    it.equal(it.engine().stats().steps, static_cast<std::uint64_t>(whole), "steps counted");
    const Snapshot now = it.engine().snapshot(ContactReport::none);
    const Tolerance step = {1.001 * dt, 0.0, "arrays may be staggered by up to a step"};
    it.expect(close(now.positionTime, reached, rounding), "position_time");
    it.expect(close(now.velocityTime, reached, step), "velocity_time");
    it.expect(close(now.contactTime, reached, step), "contact_time");
    it.expect(!now.contacts, "shows contacts that were not asked for");
  }
  it.engine().advance(busyEnd);
  const Stats stats = it.engine().stats();
  it.above(stats.contactEvaluations, 0u, "contact_evaluations");
  it.above(stats.wallSeconds, 0.0, "wall_seconds");
  it.above(stats.cpuSeconds, 0.0, "cpu_seconds");
}

void startIsTheScene(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const Snapshot start = it.engine().snapshot(ContactReport::none);
  const Tolerance rounding = it.byPrecision(1e-15, 1e-7, "the given numbers, rounded once");
  it.requireEqual(start.position.size(), scene.disks.size(), "positions shown");
  it.requireEqual(start.velocity.size(), scene.disks.size(), "velocities shown");
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    it.expect(close(start.position[i], scene.disks.position[i], rounding), "a disk's position");
    it.expect(close(start.velocity[i], scene.disks.velocity[i] + start.velocityTime * scene.gravity,
                    rounding),
              "a disk's velocity");
    it.expect(close(spinsOf(scene, start)[i], scene.disks.spin[i], rounding), "a disk's spin");
  }
  it.requireEqual(start.bodies.size(), scene.bodies.size(), "wall bodies shown");
  it.requireEqual(start.wallPosition.size(), scene.wallDiskCount(), "wall disks shown");
  std::size_t k = 0;
  for (const WallBody& body : scene.bodies)
    for (const Vec2& position : body.diskPosition)
      it.expect(close(start.wallPosition[k++], position, rounding), "a wall disk's position");
}

void halfwayStopsChangeNothing(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const Snapshot once = it.at(busyEnd);
  it.require(once.contacts && once.contacts->size() > 0, "nothing happens in this scene");
  it.load(scene);
  it.engine().advance(0.37 * busyEnd);
  it.engine().advance(0.5 * busyEnd);
  it.expect(sameBits(it.at(busyEnd), once), "with stops half way, and without");
}

void lookingChangesNothing(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const Snapshot unseen = it.at(busyEnd);
  it.load(scene);
  for (int look = 0; look < 20; ++look) {
    it.engine().advance(busyEnd * look / 20);
    it.engine().snapshot(ContactReport::none);
    if (it.can.instantContacts) it.engine().snapshot(ContactReport::instant);
    if (it.can.accumulatedContacts) it.engine().snapshot(ContactReport::accumulated);
    it.engine().stats();
  }
  const Snapshot seen = it.at(busyEnd);
  if (it.contactReport() == ContactReport::accumulated) {
    it.expect(seen.position == unseen.position,
              "positions differ from those of a run that nobody looked at");  // each look begins
                                                                              // another interval
  } else {
    it.expect(sameBits(seen, unseen), "looked at often, and never");
  }
  it.expect(sameBits(it.engine().snapshot(ContactReport::none),
                     it.engine().snapshot(ContactReport::none)),
            "two looks at one state");
}

void loadingStartsAfresh(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const Snapshot first = it.at(busyEnd);
  const Stats stats = it.engine().stats();
  const Scene other = encounterScene(crookedEncounter(), it.law(), 37.0);
  it.load(other);
  it.at(Encounter::end);
  it.load(scene);
  it.equal(it.engine().stats().steps, 0u, "steps counted after loading");
  const Snapshot second = it.at(busyEnd);
  it.expect(sameBits(second, first), "loaded the second time, and the first");
  it.equal(it.engine().stats().steps, stats.steps, "steps counted the second time");
  it.equal(it.engine().stats().contactEvaluations, stats.contactEvaluations,
           "contact_evaluations the second time");
  // Nothing came in between that would have emptied what is kept of these pairs.
  it.load(scene);
  it.expect(sameBits(it.at(busyEnd), second), "loaded a third time, at once, and the second");
}

void workersAgreeBitForBit(Exam& it) {
  const Scene scene = it.simplified(busyScene(it.law()));
  it.load(scene);
  const Snapshot here = it.at(busyEnd);
  const auto other = it.another(it.entry);
  other->load(scene, it.entry.settings);
  other->advance(busyEnd);
  it.expect(sameBits(other->snapshot(it.contactReport()), here), "two workers");
}

/// Where a disk on a plane is when its contact is deepest, about [s].
constexpr double inContact = Encounter::gap / 0.05 + 0.5 * smallContactTime;

/// A run that another worker takes up from the middle goes on to the bit, and the one that wrote
/// the checkpoint is none the other for it.
/// @returns why the engine cannot be asked
std::optional<std::string> expectTakenUp(Exam& it, const Scene& scene, double middle, double end) {
  if (auto why = it.refused(scene)) return why;
  const Snapshot whole = it.at(end);
  it.load(scene);
  const Snapshot half = it.at(middle);
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.path / "checkpoint";
  const auto other = it.another(it.entry);
  try {
    it.engine().checkpoint(file);
    other->load(it.scene, it.entry.settings);
    other->restore(file);
  } catch (const EngineFailure& failure) {
    it.fault(
        said("it declares checkpoints, and one at t = ", middle, " s fails: ", failure.what()));
    it.suspect("checkpoints are declared, and there are none that work");
    throw GivenUp{};
  }
  it.expect(sameBits(it.at(end), whole), "the run that wrote a checkpoint, and one that did not");
  it.expect(sameBits(other->snapshot(it.contactReport()), half), "what is restored, at once");
  other->advance(end);
  const Snapshot takenUp = other->snapshot(it.contactReport());
  const Comparison same = sameBits(takenUp, whole);
  it.expect(same, said("taken up from a checkpoint at t = ", middle, " s, and in one go"));
  if (same.difference.empty()) return std::nullopt;
  if (!scene.bodies.empty() && scene.bodies.front().motion.kind != Motion::Kind::fixed)
    return std::nullopt;
  // A start from the same places and velocities has no springs.
  Scene afresh = it.scene;
  afresh.disks.position = half.position;
  afresh.disks.velocity = half.velocity;
  afresh.disks.spin = spinsOf(scene, half);
  if (it.refused(afresh)) return std::nullopt;
  const Snapshot forgot = it.at(end - middle);
  const auto apart = [](const Snapshot& one, const Snapshot& two) {
    double most = 0.0;
    for (std::size_t i = 0; i < one.velocity.size(); ++i)
      most = std::max(most, (one.velocity[i] - two.velocity[i]).norm());
    return most;
  };
  if (apart(takenUp, forgot) < 0.1 * apart(takenUp, whole))
    it.suspect(
        "checkpoints lose the springs of contacts: what is restored goes on as a start "
        "without them does");
  return std::nullopt;
}

void checkpointsGoOnToTheBit(Exam& it) {
  it.needs(checkpoints);
  it.examined(checkpoints);
  // Without planes only the heap; whoever refuses that is asked nothing.
  expectTakenUp(it, landingScene(it.law(), 50.0), inContact, Encounter::end);
  if (const auto why =
          expectTakenUp(it, it.simplified(busyScene(it.law())), 0.5 * busyEnd, busyEnd))
    it.skip(*why);
}

}  // namespace
std::span<const Check> checks() {
  static constexpr std::array list = {
      Check{"AdvancesByWholeSteps", "it advances by whole steps and counts them",
            advancesByWholeSteps},
      Check{"StartIsTheScene", "it starts from the scene's own state", startIsTheScene},
      Check{"HalfwayStopsChangeNothing", "stops half way change nothing",
            halfwayStopsChangeNothing},
      Check{"LookingChangesNothing", "looking changes nothing", lookingChangesNothing},
      Check{"LoadingStartsAfresh", "loading again starts afresh, to the bit", loadingStartsAfresh},
      Check{"CheckpointsGoOnToTheBit", "a run taken up from a checkpoint goes on to the bit",
            checkpointsGoOnToTheBit},
      Check{"WorkersAgreeBitForBit", "two workers do the same, to the bit", workersAgreeBitForBit},
  };
  return list;
}

}  // namespace crossgrain::conformance::lifecycle
