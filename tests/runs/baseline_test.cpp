// What a baseline keeps, and what a diff says of engines that do otherwise.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>

#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "results/lockstep_fields.hpp"
#include "runs/baseline/baseline_cases.hpp"
#include "runs/baseline/baseline_file.hpp"
#include "runs/baseline/collision_changes.hpp"
#include "runs/baseline/diff.hpp"
#include "runs/baseline/keep.hpp"
#include "support/files.hpp"
#include "support/hdf5_file.hpp"
#include "support/scratch_folder.hpp"
#include "tests/runs/planted_engine.hpp"
#include "tests/runs/quick_flow.hpp"

namespace {

using namespace crossgrain;

const auto nobody = [](double) {};

/// The quick cell's baseline of the in-house engine, from three starts, made once for all tests.
class BaselineDiff : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases_ = new std::vector(loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {}));
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

  static inline std::vector<Case>* cases_ = nullptr;
  static inline Baseline* baseline_ = nullptr;
};

TEST_F(BaselineDiff, TheSameEngineDoesTheSameBits) {
  const DiffRow row = rowOf([](Scene&) {});
  EXPECT_EQ(row.verdict, DiffVerdict::sameBits);
  EXPECT_EQ(row.windowsVerdict, DiffVerdict::sameBits);
  EXPECT_EQ(row.collisionsVerdict, DiffVerdict::sameBits);
  EXPECT_EQ(row.windows->starts, 3u);
  EXPECT_EQ(row.windows->track.back(), 0.0);
  EXPECT_EQ(row.sweeps, 1u);
  EXPECT_TRUE(row.declared.empty());
}

/// A build in which one constant is another, and says nothing of it.
TEST_F(BaselineDiff, AChangedConstantIsFoundAndNamed) {
  const DiffRow row = rowOf([](Scene& scene) { scene.law.kn *= 1.01; });
  EXPECT_EQ(row.verdict, DiffVerdict::differs);
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
  EXPECT_EQ(row.collisionsVerdict, DiffVerdict::differs);
}

TEST_F(BaselineDiff, AnotherIntegratorIsFoundAndNamed) {
  const DiffRow row =
      rowOf([](Scene& scene) { scene.law.conventions.integrator = Integrator::semiImplicitEuler; });
  EXPECT_EQ(row.verdict, DiffVerdict::differs);
  ASSERT_TRUE(row.windows->term);
  EXPECT_EQ(row.windows->term->name, "integrator = semi_implicit_euler");
  EXPECT_LT(row.windows->term->unexplained, 1e-6);
  const auto declared =
      std::ranges::find(row.declared, std::string("integrator"), &DeclaredChange::name);
  ASSERT_NE(declared, row.declared.end());
  EXPECT_EQ(declared->before, "position_verlet");
}

TEST_F(BaselineDiff, HalfTheStepIsFoundAndNamed) {
  const DiffRow row = rowOf([](Scene& scene) { scene.dt *= 0.5; });
  EXPECT_EQ(row.verdict, DiffVerdict::differs);
  ASSERT_TRUE(row.windows->term);
  EXPECT_EQ(row.windows->term->name, "dt = 2e-05 s");
}

/// A law that is the same to 3e-5 of k_n is the same law.
TEST_F(BaselineDiff, ALittleIsTheSameLaw) {
  const DiffRow row = rowOf([](Scene& scene) { scene.law.kn *= 1.0 + 3e-5; });
  EXPECT_EQ(row.verdict, DiffVerdict::sameLaw);
  EXPECT_EQ(row.windowsVerdict, DiffVerdict::sameLaw);
}

/// Motion to the bit, and half as much again of the forces that are reported.
TEST_F(BaselineDiff, ForcesThatAreReportedOtherwiseAreADifference) {
  const auto nothing = [](Scene&) {};
  const auto expect = [&](const std::function<void(Snapshot&)>& shown, DiffVerdict verdict) {
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
      DiffVerdict::differs);
  EXPECT_NEAR(contacts.forces->normal, 0.5, 1e-12);
  EXPECT_EQ(contacts.forces->walls, 0.0);
  const DiffRow walls = expect(
      [](Snapshot& snapshot) {
        for (BodySnapshot& body : snapshot.bodies) {
          if (body.force) *body.force *= 1.5;
          if (body.torque) *body.torque *= 1.5;
        }
      },
      DiffVerdict::differs);
  EXPECT_EQ(walls.forces->normal, 0.0);
  EXPECT_NEAR(walls.forces->walls, 0.5, 1e-12);
  expect(
      [](Snapshot& snapshot) {
        if (snapshot.contacts && snapshot.contacts->size() > 0)
          snapshot.contacts->normalForce.front() *= 1.0 + 1e-12;
      },
      DiffVerdict::sameToRounding);
}

/// What is compared over several starts has one step and one precision.
TEST_F(BaselineDiff, AStepThatChangesBetweenStartsIsAFailure) {
  int loads = 0;
  const DiffRow row = rowOf([&](Scene& scene) {
    if (++loads > 1) scene.dt *= 0.5;
  });
  EXPECT_NE(row.failure.find("from another"), std::string::npos) << row.failure;
  EXPECT_EQ(row.windows->starts, 1u);
}

/// A step that never comes by the times that were kept leaves the flow unmeasured, and collisions.
TEST_F(BaselineDiff, WhatMeetsNoTimeIsNotMeasured) {
  const DiffRow row = rowOf([](Scene& scene) { scene.dt *= 0.99; });
  EXPECT_EQ(row.windowsVerdict, DiffVerdict::notMeasured);
  EXPECT_NE(row.reason.find("meets the times"), std::string::npos) << row.reason;
  EXPECT_NE(row.verdict, DiffVerdict::sameBits);
}

TEST_F(BaselineDiff, AnEngineThatDiesIsTold) {
  int loads = 0;
  const DiffRow row = rowOf([&](Scene&) {
    if (++loads == 2) throw EngineFailure("gone");
  });
  EXPECT_EQ(row.failure, "gone");
  EXPECT_EQ(row.windows->starts, 1u);
}

TEST_F(BaselineDiff, AFileKeepsEveryBit) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b.h5", again = scratch.path / "again.h5";
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
  EXPECT_EQ(read.engines.front().collisions.front().values,
            baseline_->engines.front().collisions.front().values);
  writeBaseline(read, again);
  EXPECT_EQ(readFile(file), readFile(again));  // the same baseline, the same bytes
}

/// Every refusal names the file and says what is amiss.
TEST_F(BaselineDiff, OtherFilesAreRefused) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b.h5";
  const auto refusal = [&] {
    try {
      readBaseline(file);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto has = [&](const char* what) {
    const std::string said = refusal();
    EXPECT_EQ(said.find(file.string()), 0u) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  };
  has("no such file");
  writeFile(file, "no HDF5");
  has("cannot be read as an HDF5 file");
  const auto attributes = [&](const std::vector<std::pair<const char*, const char*>>& all) {
    Hdf5File out = Hdf5File::create(file);
    for (const auto& [name, value] : all) out.writeAttribute(name, std::string(value));
    out.save();
  };
  attributes({{"hash", "of a packing"}});
  has("is no baseline");
  attributes({{"schema", "crossgrain-baseline-9"}});
  has("has schema \"crossgrain-baseline-9\", this crossgrain reads \"crossgrain-baseline-2\"");
  attributes({{"schema", baselineSchema}});
  has("is damaged: head is missing");
  attributes({{"schema", baselineSchema}, {"head", "{"}});
  has("head is not JSON");
  attributes({{"schema", baselineSchema}, {"head", R"({"engines": "two"})"}});
  has("head.engines: is string, not a whole number");
  attributes({{"schema", baselineSchema}, {"head", R"({"engines": 1000000})"}});
  has("engine-0 is missing");
  Baseline other = *baseline_;
  other.starts.front().start.wheelAngle += 1e-9;  // not what the hash is of
  writeBaseline(other, file);
  has("start 0 is not what its hash says");
}

/// Whatever of it is changed, it is no longer the baseline.
TEST_F(BaselineDiff, AFileThatWasAlteredIsRefused) {
  const ScratchFolder scratch;
  const auto file = scratch.path / "b.h5";
  const auto said = [&] {
    try {
      readBaseline(file);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (const char* name : {"position", "spin", "normal_force", "tangential_force", "sliding",
                           "walls", "yardstick", "time"}) {
    writeBaseline(*baseline_, file);
    EXPECT_EQ(said(), "none");
    const hid_t whole = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t set =
        H5Dopen2(whole, fmt::format("/engine-0/window-1/{}", name).c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.back() += 1.0;
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    for (const hid_t id : {space, set, whole}) H5Idec_ref(id);
    EXPECT_NE(said().find("is damaged: its content is not that of its checksum"), std::string::npos)
        << name << ": " << said();
  }
  // With a checksum of its own, too.
  Baseline other = *baseline_;
  other.engines.front().windows[1].frames[2].time = NAN;
  writeBaseline(other, file);
  EXPECT_NE(said().find("time has a value that is not finite"), std::string::npos) << said();
  std::swap(other.engines.front().windows[1].frames[2], other.engines.front().windows[1].frames[3]);
  other.engines.front().windows[1].frames[3].time = 0.0;
  writeBaseline(other, file);
  EXPECT_NE(said().find("times of a window"), std::string::npos) << said();
}

/// The packing file that a flow began with need not be there any more.
TEST_F(BaselineDiff, NeedsNoFileOfAPacking) {
  const ScratchFolder scratch;
  const auto packing = scratch.path / "mine.h5";
  writePacking(baseline_->starts.front().packing, packing);
  Baseline baseline = *baseline_;
  baseline.setup.toml = resolvedFile(
      loadCase(CROSSGRAIN_CASES "/couette/quick.toml", {"particles.file=" + packing.string()}));
  std::filesystem::remove(packing);
  EXPECT_EQ(casesOf(baseline, "b.h5", {"law.mu=0.3"}).front().law.mu, 0.3);
}

TEST(CollisionChanges, TellWhatChangedMostFirst) {
  KeptCollisions before{"case", "", 1e-5, "", {0.0, 1.0}, {0.1, 0.1}, {}};
  before.values = {{"e_n", {0.5, 0.5}}, {"psi_f", {0.0, 4.0}}};
  KeptCollisions now = before;
  EXPECT_EQ(verdictOf(collisionChanges(before, now)), DiffVerdict::sameBits);
  now.values["e_n"][1] = 0.5 + 5e-12;
  EXPECT_EQ(verdictOf(collisionChanges(before, now)), DiffVerdict::sameToRounding);
  now.values["psi_f"][0] = -0.002;  // 5e-4 of 4
  EXPECT_EQ(verdictOf(collisionChanges(before, now)), DiffVerdict::sameLaw);
  now.values["psi_f"][1] = 3.96;
  const auto changes = collisionChanges(before, now);
  EXPECT_EQ(verdictOf(changes), DiffVerdict::differs);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes.front().quantity, "psi_f");
  EXPECT_EQ(changes.front().changed, 2u);
  EXPECT_NEAR(changes.front().largest, -0.04, 1e-15);
  EXPECT_NEAR(changes.front().relative, 0.01, 1e-15);
  EXPECT_EQ(changes.front().psi, 1.0);
}

/// A pair that does not part any more has no value: that is as much of a change as there is.
TEST(CollisionChanges, CountWhatIsNotThereAnyMore) {
  const KeptCollisions before{"case", "", 1e-5, "", {0.0}, {0.1}, {{"e_n", {0.5}}}};
  KeptCollisions now = before;
  now.values["e_n"][0].reset();
  EXPECT_EQ(collisionChanges(before, now).front().relative, 1.0);
  now.values.clear();
  EXPECT_EQ(collisionChanges(before, now).front().relative, 1.0);
  EXPECT_EQ(collisionChanges(now, before).front().relative, 1.0);
}

}  // namespace
