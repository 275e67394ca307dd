// The cases that the thesis' claims are compared with, and the sweeps that order them.
#include "cases/thesis_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "oracle/collision_oracle.hpp"
#include "oracle/impact.hpp"
#include "tests/cases_loader/files.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain::test {
namespace {

namespace fs = std::filesystem;

const fs::path thesisFolder = fs::path(CROSSGRAIN_CASES) / "couette/thesis";

Case thesisCase(const std::string& name) {
  return loadCase(thesisFolder / (name + ".toml")).front();
}

bool isNoCase(const fs::path& file) {
  const std::string name = file.stem().string();
  return name.starts_with("ladder") || name == "claims" || name == "reasons";
}

TEST(ThesisCases, AllLoadAreNamedAsTheirFilesAndBeginWhenTheRingHasClosed) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(thesisFolder)) {
    if (entry.path().extension() != ".toml" || isNoCase(entry.path())) continue;
    const std::vector<Case> cases = loadCase(entry.path());
    ASSERT_EQ(cases.size(), 1u) << entry.path();
    EXPECT_EQ(cases.front().name, entry.path().stem());
    EXPECT_TRUE(cases.front().warnings.empty()) << entry.path();
    EXPECT_EQ(couetteIn(cases.front()).filling.rotations, 0.0) << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 17 + 1 + 15 + 8 + 7);  // packings, base, rates, twenty rotations, readings
}

TEST(ThesisCases, PackingsAreThoseOfTheTable) {
  for (const TableRow& row : table32) {
    char name[64];
    std::snprintf(name, sizeof name, "nu-%.3f-%d-%d", row.nu, row.small, row.large);
    const Case c = thesisCase(name);
    EXPECT_EQ(couetteIn(c).particles.small, row.small);
    EXPECT_EQ(couetteIn(c).particles.large, row.large);
    EXPECT_NEAR(volumeFraction(c), row.nu, 0.00075) << name;  // facts 1.1
    EXPECT_EQ(couetteIn(c).cell.omega, 0.1);
    EXPECT_EQ(couetteIn(c).times.settleRotations, 5.0);
    EXPECT_EQ(couetteIn(c).times.rotations, 3.0);
  }
}

TEST(ThesisCases, AnotherStiffnessKeepsRestitutionAndStepsPerContact) {
  const Case soft = thesisCase("kn-half"), own = thesisCase("nu-0.804-2511-410"),
             stiff = thesisCase("kn-double");
  const double mass = lightestReducedMass(own);
  EXPECT_DOUBLE_EQ(stiff.law.kn, 2.0 * own.law.kn);
  EXPECT_DOUBLE_EQ(soft.law.kn, 0.5 * own.law.kn);
  for (const Case& other : {soft, stiff}) {
    // Six digits of the constants in the files.
    EXPECT_NEAR(restitutionOfLinearLaw(other.law, mass), restitutionOfLinearLaw(own.law, mass),
                1e-5);
    EXPECT_NEAR(other.law.kt / other.law.kn, own.law.kt / own.law.kn, 1e-12);
    EXPECT_NEAR(other.law.gt / other.law.gn, own.law.gt / own.law.gn, 1e-5);
    EXPECT_NEAR(contactTime(other.law, mass) / timeStep(other),
                contactTime(own.law, mass) / timeStep(own), 1e-3);
  }
}

TEST(ThesisCases, InterpretationsDifferInOneThing) {
  const Case own = thesisCase("nu-0.804-2511-410");
  EXPECT_EQ(
      wallDiskCount(couetteIn(thesisCase("spacing-7mm")).cell, couetteIn(own).cell.innerRadius),
      93);
  EXPECT_EQ(couetteIn(thesisCase("large-mass-0.404g")).particles.largeMass, 0.404e-3);
  EXPECT_NEAR(volumeFraction(thesisCase("small-radius-3.71mm")), 0.8076, 0.00005);  // facts 1.1
  EXPECT_FALSE(thesisCase("no-bottom").bottom);
  EXPECT_EQ(thesisCase("no-friction").law.mu, 0.0);
}

TEST(Sweeps, OfTheThesisHoldEveryRowOfItsTableFirst_BeginningWithNineThatSpanIt) {
  const ThesisSweep sweep = loadSweep(thesisFolder / "ladder.toml");
  const auto steps = runsOf(sweep, {{"grain"}});
  std::multiset<std::pair<double, int>> first, table;
  std::set<double> nine;
  for (const TableRow& row : table32) {
    const SweepRun& step = steps[table.size()];
    const SweepCase& own = sweep.cases[step.setup];
    if (table.size() < 9) nine.insert(own.label);
    table.emplace(row.nu, row.small);
    first.emplace(own.label, couetteIn(own.setup).particles.small);
    EXPECT_EQ(step.packing, 0);
  }
  EXPECT_EQ(first, table);
  EXPECT_EQ(nine.size(), 9u);
  EXPECT_EQ(*nine.begin(), std::begin(table32)->nu);
  EXPECT_EQ(*nine.rbegin(), std::rbegin(table32)->nu);
}

TEST(Sweeps, HaveEveryFamilyAndLabelCasesByTheirDisks) {
  for (const char* file :
       {"ladder.toml", "ladder-quick.toml", "ladder-early.toml", "ladder-fast.toml"}) {
    const ThesisSweep sweep = loadSweep(thesisFolder / file);
    std::map<std::string, int> legs;
    for (const SweepCase& own : sweep.cases) {
      for (const std::string& family : own.families) ++legs[family];
      Case printed = own.setup;
      couetteIn(printed).particles.smallRadius = 0.0037;
      EXPECT_NEAR(volumeFraction(printed), own.label, 0.00075) << own.name;
    }
    for (const char* family : sweepFamilies) EXPECT_GE(legs[family], 2) << file << " " << family;
    std::set<std::size_t> run;
    for (const SweepRun& step : runsOf(sweep, {{"grain"}})) run.insert(step.setup);
    EXPECT_EQ(run.size(), sweep.cases.size()) << file << ": a case is in no stage";
  }
}

class SweepFiles : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write("cell.toml", soundCase);
    write("rules.toml", "");
  }

  std::string messageOf(const std::string& text) {
    write("ladder.toml", text);
    try {
      loadSweep("ladder.toml");
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  }

  const std::string head_ = "rules = \"rules.toml\"\n";
  const std::string leg_ =
      "[[legs]]\ncase = \"cell.toml\"\nnu = 0.75\nfamilies = [\"packings\"]\npurpose = \"all\"\n";
  const std::string rung_ = "[[rungs]]\nname = \"one\"\nlegs = [\"cell\"]\n";
};

TEST_F(SweepFiles, CasesAreNamedAfterTheirFilesAndChangedInLayers) {
  write("ladder.toml", head_ + "set = [\"cell.omega=2.0\", \"law.mu=0.1\"]\n" + leg_ +
                           "set = [\"cell.omega=3.0\"]\n" + rung_);
  const ThesisSweep sweep = loadSweep("ladder.toml", {"particles.large=30"});
  ASSERT_EQ(sweep.cases.size(), 1u);
  const SweepCase& own = sweep.cases.front();
  EXPECT_EQ(own.name, "cell");
  EXPECT_EQ(couetteIn(own.setup).cell.omega, 3.0);
  EXPECT_EQ(own.setup.law.mu, 0.1);
  EXPECT_EQ(couetteIn(own.setup).particles.large, 30);
  EXPECT_EQ(sweep.rules, "rules.toml");
}

TEST_F(SweepFiles, RunsGoStageByStagePackingByPackingAndNoneTwice) {
  write("ladder.toml", head_ + leg_ + "[[legs]]\nname = \"fast\"\n" + leg_.substr(9) +
                           "set = [\"cell.omega=2.0\"]\n" +
                           "[[rungs]]\nname = \"one\"\nlegs = [\"fast\"]\nengines = [\"grain\"]\n" +
                           "[[rungs]]\nname = \"all\"\nfamilies = [\"packings\"]\npackings = 2\n");
  const auto steps = runsOf(loadSweep("ladder.toml"), {{"yade"}, {"grain"}});
  std::vector<std::array<std::size_t, 3>> found;
  for (const SweepRun& step : steps)
    found.push_back({step.setup, step.engine, static_cast<std::size_t>(step.packing)});
  const std::vector<std::array<std::size_t, 3>> wanted = {
      {1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(found, wanted);
}

TEST_F(SweepFiles, WhatIsWrongIsOneLineThatSaysWhere) {
  write("two.toml", soundCase + "[[variants]]\nname = \"a\"\n[[variants]]\nname = \"b\"\n");
  write("pair.toml", soundCollision);
  const auto legOf = [&](const char* file) {
    return std::string("[[legs]]\ncase = \"") + file + "\"\n" + leg_.substr(leg_.find("nu"));
  };
  const std::map<std::string, std::string> wrong = {
      {head_ + legOf("two.toml") + rung_, "variants"},
      {head_ + legOf("pair.toml") + rung_, "no Couette cell"},
      {"rule = 1\n" + leg_ + rung_, "rules is missing"},
      {head_ + "ledgs = 1\n" + leg_ + rung_,
       "ladder.toml:2:1: unknown key ledgs (did you mean legs?)"},
      {"rules = \"rulse.toml\"\n" + leg_ + rung_, "rules = \"rulse.toml\": no such file"},
      {head_ + "collisions = \"cell.toml\"\n" + leg_ + rung_, "is no case of collisions"},
      {head_ + rung_, "legs is missing"},
      {head_ + leg_, "rungs is missing"},
      {head_ + "[[legs]]\nnu = 0.8\n" + rung_, "legs[0].case is missing"},
      {head_ + "[[legs]]\ncase = \"cel.toml\"\n" + rung_, "did you mean cell.toml?"},
      {head_ + leg_ + "sett = []\n" + rung_, "unknown key legs[0].sett (did you mean set?)"},
      {head_ + leg_ + "set = [\"cell.omega=0\"]\n" + rung_, "cell.omega = 0"},
      {head_ + leg_ + leg_ + rung_, "a leg \"cell\" is there twice"},
      {head_ + leg_ + "name = \"a b\"\n" + rung_, "must be of letters"},
      {head_ + "[[legs]]\ncase = \"cell.toml\"\nnu = 8\n" + rung_, "legs[0].nu = 8"},
      {head_ + leg_ + "[[rungs]]\nname = \"one\"\n", "rungs[0].legs is missing"},
      {head_ + leg_ + "[[rungs]]\nname = \"one\"\nlegs = [\"cel\"]\n", "did you mean cell?"},
      {head_ + leg_ + "[[rungs]]\nname = \"one\"\nfamilies = [\"rate\"]\n",
       "no leg belongs to them"},
      {head_ + leg_ + rung_ + "engines = [\"grian\"]\n",
       "there is no engine \"grian\" (did you mean grain?)"},
      {head_ + leg_ + rung_ + "packings = 0\n", "rungs[0].packings = 0"},
  };
  for (const auto& [text, message] : wrong) {
    const std::string found = messageOf(text);
    EXPECT_NE(found.find(message), std::string::npos) << found << "\nfor\n" << text;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

}  // namespace
}  // namespace crossgrain::test
