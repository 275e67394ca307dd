// Contents of a baseline, and the diff of engines that behave otherwise.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "adapters/registry.hpp"
#include "adapters/worker/arrays.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/regression/diff.hpp"
#include "studies/regression/observe.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/scratch_folder.hpp"
#include "tests/studies/planted_engine.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

const auto nobody = [](double) {};

/// The quick cell's baseline of the in-house engine, from three starts, made once for all tests.
class BaselineDiff : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases_ = new std::vector{test::quickCell()};
    const Case& setup = cases_->front();
    const test::QuickFlow flow(3);
    baseline_ = new Baseline;
    baseline_->version = "this";
    baseline_->setup = {setup.name, "", setup.file.string(), resolvedFile(*cases_)};
    baseline_->starts = flow.states;
    baseline_->engines = {keepEngine(*makeGrain(), engineRegistry().front(), *cases_,
                                     baseline_->starts, flow.dt, nobody)};
  }
  static void TearDownTestSuite() {
    delete cases_;
    delete baseline_;
  }

  static DiffRow rowOf(Engine& engine) {
    return diffEngine(engine, engineRegistry().front(), *cases_, *baseline_,
                      baseline_->engines.front(), nobody);
  }
  static DiffRow rowOf(std::function<void(Scene&)> fault) {
    test::PlantedEngine engine(std::move(fault));
    return rowOf(engine);
  }

  /// Why a file is no baseline; empty if it is one.
  static std::string refusalOf(const std::filesystem::path& file) {
    return test::refusalOf([&] { readBaseline(file); });
  }

  static inline std::vector<Case>* cases_ = nullptr;
  static inline Baseline* baseline_ = nullptr;
};

TEST_F(BaselineDiff, SameEngine_SameBits) {
  const DiffRow row = rowOf([](Scene&) {});
  EXPECT_EQ(row.verdict, Equivalence::sameBits);
  EXPECT_EQ(row.windowsVerdict, Equivalence::sameBits);
  EXPECT_EQ(row.collisionsVerdict, Equivalence::sameBits);
  EXPECT_EQ(row.windows->starts, 3u);
  EXPECT_EQ(row.windows->track.back(), 0.0);
  EXPECT_EQ(row.sweeps, 1u);
  EXPECT_TRUE(row.declared.empty());
}

/// A build in which one constant is another, and says nothing of it.
TEST_F(BaselineDiff, ChangedConstant_IsNamedWithItsAmount) {
  const DiffRow row = rowOf([](Scene& scene) { scene.law.kn *= 1.01; });
  EXPECT_EQ(row.verdict, Equivalence::differs);
  EXPECT_NEAR(*row.windows->separations.front().equivalent / 0.01, 1.0, 0.01);
  ASSERT_TRUE(row.windows->first);
  EXPECT_EQ(row.windows->first->after, 0.0);
  EXPECT_FALSE(row.windows->first->contact.empty());
  ASSERT_TRUE(row.windows->term);
  EXPECT_EQ(row.windows->term->name, "kn");
  EXPECT_NEAR(*row.windows->term->amount / 0.01, 1.0, 0.01);
  // t_c = π/√(k_n/m₁₂ − …): half of a per cent less.
  const auto duration =
      std::ranges::find(row.collisions, std::string("duration"), &CollisionChange::quantity);
  ASSERT_NE(duration, row.collisions.end());
  EXPECT_LT(duration->largest, 0.0);
  EXPECT_NEAR(duration->relative / 0.005, 1.0, 0.3);
  EXPECT_EQ(row.collisionsVerdict, Equivalence::differs);
  // A law that is the same to 3e-5 of k_n is the same law.
  const DiffRow tiny = rowOf([](Scene& scene) { scene.law.kn *= 1.0 + 3e-5; });
  EXPECT_EQ(tiny.verdict, Equivalence::sameLaw);
  EXPECT_EQ(tiny.windowsVerdict, Equivalence::sameLaw);
}

TEST_F(BaselineDiff, OtherIntegratorOrStep_IsNamed) {
  const DiffRow row =
      rowOf([](Scene& scene) { scene.law.conventions.integrator = Integrator::semiImplicitEuler; });
  EXPECT_EQ(row.verdict, Equivalence::differs);
  ASSERT_TRUE(row.windows->term);
  EXPECT_EQ(row.windows->term->name, "integrator = semi_implicit_euler");
  EXPECT_LT(row.windows->term->unexplained, 1e-6);
  const auto declared =
      std::ranges::find(row.declared, std::string("integrator"), &DeclaredChange::name);
  ASSERT_NE(declared, row.declared.end());
  EXPECT_EQ(declared->before, "position_verlet");
  const DiffRow halved = rowOf([](Scene& scene) { scene.dt *= 0.5; });
  EXPECT_EQ(halved.verdict, Equivalence::differs);
  ASSERT_TRUE(halved.windows->term);
  EXPECT_EQ(halved.windows->term->name, "dt = 2e-05 s");
}

/// Motion to the bit, and half as much again of the forces that are reported.
TEST_F(BaselineDiff, ReportedForces_Changed_Differ) {
  const auto nothing = [](Scene&) {};
  const auto expect = [&](const std::function<void(Snapshot&)>& shown, Equivalence verdict) {
    test::PlantedEngine engine(nothing, shown);
    const DiffRow row = rowOf(engine);
    EXPECT_EQ(row.verdict, verdict);
    EXPECT_EQ(row.windows->track.back(), 0.0);
    return row;
  };
  const DiffRow contacts = expect(
      [](Snapshot& snapshot) {
        if (!snapshot.contacts) return;
        for (double& force : snapshot.contacts->normalForce) force *= 1.5;
      },
      Equivalence::differs);
  EXPECT_NEAR(contacts.forces->normal, 0.5, 1e-12);
  EXPECT_EQ(contacts.forces->walls, 0.0);
  const DiffRow walls = expect(
      [](Snapshot& snapshot) {
        for (BodySnapshot& body : snapshot.bodies) {
          if (body.force) *body.force *= 1.5;
          if (body.torque) *body.torque *= 1.5;
        }
      },
      Equivalence::differs);
  EXPECT_EQ(walls.forces->normal, 0.0);
  EXPECT_NEAR(walls.forces->walls, 0.5, 1e-12);
  expect(
      [](Snapshot& snapshot) {
        if (snapshot.contacts && snapshot.contacts->size() > 0)
          snapshot.contacts->normalForce.front() *= 1.0 + 1e-12;
      },
      Equivalence::sameToRounding);
}

/// Runs from several starts are compared at one step and one precision; a step that never meets the
/// kept times leaves the flow unmeasured.
TEST_F(BaselineDiff, StepChangedBetweenStartsOrOffTheKeptTimes_IsNotCompared) {
  int loads = 0;
  const DiffRow between = rowOf([&](Scene& scene) {
    if (++loads > 1) scene.dt *= 0.5;
  });
  EXPECT_NE(between.failure.find("from another"), std::string::npos) << between.failure;
  EXPECT_EQ(between.windows->starts, 1u);
  const DiffRow off = rowOf([](Scene& scene) { scene.dt *= 0.99; });
  EXPECT_EQ(off.windowsVerdict, Equivalence::notMeasured);
  EXPECT_NE(off.reason.find("meets the times"), std::string::npos) << off.reason;
  EXPECT_NE(off.verdict, Equivalence::sameBits);
}

TEST_F(BaselineDiff, EngineDies_KeepsTheStartsBefore) {
  int loads = 0;
  const DiffRow row = rowOf([&](Scene&) {
    if (++loads == 2) throw EngineFailure("gone");
  });
  EXPECT_EQ(row.failure, "gone");
  EXPECT_EQ(row.windows->starts, 1u);
}

TEST_F(BaselineDiff, File_WrittenAndRead_KeepsEveryBit) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b", again = scratch.path / "again";
  writeBaseline(*baseline_, file);
  const Baseline read = readBaseline(file);
  ASSERT_EQ(read.starts.size(), 3u);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(contentHash(read.starts[s].packing), contentHash(baseline_->starts[s].packing));
    const BaselineWindow &one = read.engines.front().windows[s],
                         &other = baseline_->engines.front().windows[s];
    ASSERT_EQ(one.frames.size(), other.frames.size());
    EXPECT_EQ(one.responses, other.responses);
    for (std::size_t k = 0; k < one.frames.size(); ++k) {
      EXPECT_EQ(one.frames[k].position, other.frames[k].position);
      EXPECT_EQ(one.frames[k].spin, other.frames[k].spin);
      EXPECT_EQ(one.frames[k].time, other.frames[k].time);
      EXPECT_EQ(one.frames[k].contacts->normalForce, other.frames[k].contacts->normalForce);
    }
  }
  const CollisionChanges changes =
      collisionChanges(read.engines.front().collisions, baseline_->engines.front().collisions);
  EXPECT_EQ(changes.sweeps, 1u);
  EXPECT_TRUE(changes.changes.empty());
  writeBaseline(read, again);
  EXPECT_EQ(readFile(file), readFile(again));  // the same baseline, the same bytes
}

/// Every refusal names the file and its fault.
TEST_F(BaselineDiff, File_OfAnotherKind_IsRefused) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b.baseline";
  const auto refuses = [&](const std::string& content, const char* what) {
    writeFile(file, content);
    const std::string said = refusalOf(file);
    EXPECT_EQ(said.find(file.string()), 0u) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  EXPECT_NE(refusalOf(file).find("no such file"), std::string::npos);
  refuses("", "is no baseline; `crossgrain baseline CASE --out FILE` makes one");
  refuses("no record", "is no baseline");
  refuses(headText("baseline-9", {}), "has format \"baseline-9\", this crossgrain reads");
  refuses(headText(recordingFormat, {}), "has format \"recording-2\"");
  refuses(headText(baselineFormat, {{"engines", "two"}}), "engines: is string, not a whole number");
  refuses(headText(baselineFormat, {{"engines", 1000000}}), "it ends after 0 records");
  refuses(headText(baselineFormat, {{"engines", 1}}) + textOf({{{"name", 3}}, {}}),
          "record 1: name: is number, not a text");
}

/// A baseline of which anything is changed or missing is refused; with a checksum that fits, for
/// what it holds.
TEST_F(BaselineDiff, File_Altered_IsRefused) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b.baseline";
  writeBaseline(*baseline_, file);
  const std::string whole = *readFile(file);
  std::mt19937_64 random(1);
  for (int k = 0; k < 40; ++k) {
    std::string content = whole;
    const std::size_t at = random() % whole.size();
    if (k % 4 == 0)
      content.resize(at);
    else
      content[at] = static_cast<char>(content[at] ^ (1 << random() % 8));
    writeFile(file, content);
    EXPECT_NE(refusalOf(file), "") << "byte " << at;
  }
  Baseline other = *baseline_;
  auto& frames = other.engines.front().windows[1].frames;
  frames[2].time = NAN;
  writeBaseline(other, file);
  EXPECT_NE(refusalOf(file).find("times of a window"), std::string::npos) << refusalOf(file);
  frames[2].time = frames[1].time;
  writeBaseline(other, file);
  EXPECT_NE(refusalOf(file).find("times of a window"), std::string::npos) << refusalOf(file);
  other = *baseline_;
  frames[2].position.pop_back();
  other.engines.front().windows[1].frames[2].position.pop_back();
  writeBaseline(other, file);
  EXPECT_NE(refusalOf(file).find("2.position is"), std::string::npos) << refusalOf(file);
}

/// The packing file that a flow began with need not be there any more.
TEST_F(BaselineDiff, Case_PackingFileGone_StillLoads) {
  const ScratchFolder scratch;
  const auto packing = scratch.path / "mine.h5";
  writePacking(baseline_->starts.front().packing, packing);
  Baseline baseline = *baseline_;
  baseline.setup.toml = resolvedFile(
      loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {"particles.file=" + packing.string()}));
  std::filesystem::remove(packing);
  EXPECT_EQ(casesOf(baseline, "b.h5", {"law.mu=0.3"}).front().law.mu, 0.3);
}

/// The in-house engine, which leaves paths whole, showing the images in the box.
class Wrapping : public test::PlantedEngine {
 public:
  Wrapping() : PlantedEngine([](Scene&) {}, [](Snapshot&) {}, nullptr), own_(makeGrain()) {}
  Capabilities capabilities() const override { return own_->capabilities(); }
  EffectiveParameters loadInSpace(const SpaceScene& scene, const Settings& settings) override {
    box_ = scene.box;
    return own_->loadInSpace(scene, settings);
  }
  double advance(double t) override { return own_->advance(t); }
  SpaceSnapshot snapshotInSpace(ContactReport contacts) override {
    SpaceSnapshot now = own_->snapshotInSpace(contacts);
    for (Vec3& place : now.position) {
      const Vec3 inside = box_ ? box_->wrapped(place) : place;
      wrapped += inside != place;
      place = inside;
    }
    return now;
  }
  Stats stats() const override { return own_->stats(); }

  std::size_t wrapped = 0;  ///< places that were of other images

 private:
  std::unique_ptr<Engine> own_;
  std::optional<BoxOf<3>> box_;  ///< collisions have none
};

/// Spheres between bumpy walls in a periodic box: kept, written, read and compared as disks are.
TEST(BaselineInSpace, Flow_KeptAndCompared) {
  const auto casesWith = [](const std::vector<std::string>& changes) {
    return loadCase(CROSSGRAIN_CASES "/space/shear-3d.toml", changes);
  };
  const std::vector<Case> cases = casesWith({});
  const Case& setup = cases.front();
  const double dt = timeStep(setup);
  const auto grain = makeGrain();
  Baseline baseline{"this", {setup.name, "", setup.file.string(), resolvedFile(cases)}, 3, {}, {}};
  baseline.starts =
      statesAlongTheFlow(setup, {flowPacking(setup, 0, dt, *grain, nobody)}, dt, 2, nobody);
  const EngineEntry& entry = engineRegistry().front();
  baseline.engines = {keepEngine(*grain, entry, cases, baseline.starts, dt, nobody)};
  ASSERT_EQ(baseline.engines.front().spaceWindows.size(), 2u);
  EXPECT_TRUE(baseline.engines.front().windows.empty());

  const ScratchFolder scratch;
  const auto file = scratch.path / "b", again = scratch.path / "again";
  writeBaseline(baseline, file);
  const Baseline read = readBaseline(file);
  writeBaseline(read, again);
  EXPECT_EQ(readFile(file), readFile(again));
  const auto rowOf = [&](Engine& engine, const std::vector<Case>& now) {
    return diffEngine(engine, entry, now, read, read.engines.front(), nobody);
  };
  const DiffRow same = rowOf(*grain, cases);
  EXPECT_EQ(same.verdict, Equivalence::sameBits);
  EXPECT_EQ(same.windows->starts, 2u);
  EXPECT_EQ(same.sweeps, 1u);

  const DiffRow other = rowOf(*grain, casesWith({fmt::format("law.kn={}", 1.01 * setup.law.kn),
                                                 fmt::format("run.dt={}", dt)}));
  EXPECT_EQ(other.verdict, Equivalence::differs);
  ASSERT_TRUE(other.windows->term);
  EXPECT_EQ(other.windows->term->name, "kn");
  EXPECT_NEAR(*other.windows->term->amount / 0.01, 1.0, 0.01);

  // Which image of a place an engine shows is no difference, kept or compared.
  Wrapping wrapping;
  EXPECT_LT(std::ranges::max(rowOf(wrapping, cases).windows->track), 1e-13);
  EXPECT_GT(wrapping.wrapped, 0u);
  const BaselineEngine shown = keepEngine(wrapping, entry, cases, baseline.starts, dt, nobody);
  for (std::size_t k = 0; k < shown.spaceWindows.size(); ++k) {
    const Responses &one = shown.spaceWindows[k].responses,
                    &whole = baseline.engines.front().spaceWindows[k].responses;
    for (std::size_t t = 0; t < one.size(); ++t)
      for (std::size_t i = 0; i < one[t].size(); ++i) EXPECT_NEAR(one[t][i], whole[t][i], 1e-10);
  }
}

TEST(CollisionChanges, Values_Changed_LargestRelativeFirst) {
  std::vector<KeptCollisions> before = {
      {"case", "", "", 1e-5, {0.0, 1.0}, {0.1, 0.1}, {{"e_n", {0.5, 0.5}}, {"psi_f", {0.0, 4.0}}}}};
  std::vector<KeptCollisions> now = before;
  const auto changes = [&] { return collisionChanges(before, now).changes; };
  EXPECT_EQ(equivalenceOf(changes()), Equivalence::sameBits);
  now[0].values["e_n"][1] = 0.5 + 5e-12;
  EXPECT_EQ(equivalenceOf(changes()), Equivalence::sameToRounding);
  now[0].values["psi_f"][0] = -0.002;  // 5e-4 of 4
  EXPECT_EQ(equivalenceOf(changes()), Equivalence::sameLaw);
  now[0].values["psi_f"][1] = 3.96;
  const auto found = changes();
  EXPECT_EQ(equivalenceOf(found), Equivalence::differs);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.front().quantity, "psi_f");
  EXPECT_EQ(found.front().changed, 2u);
  EXPECT_NEAR(found.front().largest, -0.04, 1e-15);
  EXPECT_NEAR(found.front().relative, 0.01, 1e-15);
  EXPECT_EQ(found.front().psi, 1.0);
  now[0].vn[1] = 0.2;
  EXPECT_THROW(changes(), BadInput);
  now[0].refusal = "of another law";
  EXPECT_EQ(collisionChanges(before, now).sweeps, 0u);
}

/// A pair that does not part any more has no value: that is as much of a change as there is.
TEST(CollisionChanges, Value_AbsentOnOneSide_CountsAsOne) {
  const std::vector<KeptCollisions> before = {
      {"case", "", "", 1e-5, {0.0}, {0.1}, {{"e_n", {0.5}}}}};
  std::vector<KeptCollisions> now = before;
  now[0].values["e_n"][0] = NAN;
  EXPECT_EQ(collisionChanges(before, now).changes.at(0).relative, 1.0);
  EXPECT_TRUE(collisionChanges(now, now).changes.empty());
  now[0].values.clear();
  EXPECT_EQ(collisionChanges(before, now).changes.at(0).relative, 1.0);
  EXPECT_EQ(collisionChanges(now, before).changes.at(0).relative, 1.0);
}

/// An answer to snapshot with two contacts, of 0 and 1 and of 2 and 3, listed in that order or not.
Exchange snapshotWith(double force, bool swapped = false) {
  ArrayWriter arrays;
  const auto listed = [&](auto a, auto b) {
    return swapped ? std::vector{b, a} : std::vector{a, b};
  };
  arrays.add("contacts.i", listed(std::int32_t{0}, std::int32_t{2}));
  arrays.add("contacts.j", listed(std::int32_t{1}, std::int32_t{3}));
  arrays.add("contacts.normal", listed(Vec2{1.0, 0.0}, Vec2{0.6, 0.8}));
  arrays.add("contacts.normal_force", listed(force, 4.0));
  Exchange exchange;
  exchange.request = {{"request", "snapshot"}, {"file", "/tmp/of-that-run"}};
  exchange.answer = {{"ok", true}, {"seconds", force}, {"arrays", arrays.list()}};
  exchange.received.assign(reinterpret_cast<const char*>(arrays.bytes().data()),
                           arrays.bytes().size());
  return exchange;
}

TEST(AnswerDifferences, Numbers_Differ_LargestIsNamed) {
  EXPECT_TRUE(answerDifferences(snapshotWith(1.0), snapshotWith(1.0), 0.0).empty());
  const auto found = answerDifferences(snapshotWith(1.0), snapshotWith(1.25), 0.0);
  ASSERT_EQ(found.size(), 1u);  // seconds are not compared
  EXPECT_EQ(found[0].field, "contacts.normal_force");
  EXPECT_EQ(found[0].place, " of 0 with 1");
  EXPECT_EQ(found[0].off, 0.25);
  EXPECT_EQ(found[0].differ, 1u);
  EXPECT_EQ(found[0].of, 2u);
  // In units of the largest of the array, 4.
  EXPECT_TRUE(answerDifferences(snapshotWith(1.0), snapshotWith(1.25), 0.0626).empty());
  EXPECT_FALSE(answerDifferences(snapshotWith(1.0), snapshotWith(1.25), 0.0624).empty());
  // Contacts in another order are alike.
  EXPECT_TRUE(answerDifferences(snapshotWith(1.0), snapshotWith(1.0, true), 0.0).empty());
  EXPECT_EQ(answerDifferences(snapshotWith(1.0), snapshotWith(2.0, true), 0.0).at(0).place,
            " of 0 with 1");
}

TEST(AnswerDifferences, Answer_MissingOrUnusable_IsReported) {
  Exchange none = snapshotWith(1.0);
  none.answer = nullptr;
  none.failure = "toy: ended";
  EXPECT_EQ(answerDifferences(none, snapshotWith(1.0), 0.0).at(0).then, "toy: ended");
  EXPECT_EQ(answerDifferences(snapshotWith(1.0), none, 0.0).at(0).now, "toy: ended");
  EXPECT_TRUE(answerDifferences(none, none, 0.0).empty());
  Exchange broken = snapshotWith(1.0);
  broken.received.resize(8);
  EXPECT_NE(answerDifferences(snapshotWith(1.0), broken, 0.0).at(0).now.find("is too short"),
            std::string::npos);
}

TEST(Recording, Exchanges_WrittenAndRead_AreTheSame) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "run.rec";
  Exchange failed{.request = {{"request", "advance"}, {"time", 0.1}}, .failure = "toy: ended"};
  const std::string whole = headText(recordingFormat, {{"engine", "toy"}}) +
                            textOf(recordOf(snapshotWith(1.0))) + textOf(recordOf(failed));
  writeFile(file, whole);
  RecordReader reader(file, recordingFormat);
  EXPECT_EQ(reader.head()["engine"], "toy");
  const Exchange first = exchangeOf(reader.require()), second = exchangeOf(reader.require());
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(first.answer, snapshotWith(1.0).answer);
  EXPECT_EQ(first.received, snapshotWith(1.0).received);
  EXPECT_FALSE(first.request.contains("file"));
  EXPECT_TRUE(second.answer.is_null());
  EXPECT_EQ(second.failure, "toy: ended");

  // Cut off anywhere, it ends between two records or is refused.
  int complete = 0;
  for (std::size_t kept = whole.size(); kept-- > 0;) {
    writeFile(file, whole.substr(0, kept));
    complete += test::refusalOf([&] {
                  RecordReader cut(file, recordingFormat);
                  while (cut.next()) {
                  }
                }).empty();
  }
  EXPECT_EQ(complete, 2);
}

}  // namespace
