// Jobs of a plan, and what is said of results that are not as planned.
#include "studies/plan/job_plan.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "studies/core/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::inline studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Texts = std::vector<std::string>;

/// A case whose text is its overrides.
Case caseWith(const Texts& overrides) {
  Case setup;
  setup.name = "a cell";
  for (const std::string& each : overrides) setup.resolvedToml += each + '\n';
  return setup;
}

JobRequest request() {
  JobRequest request;
  request.file = "/cases/a cell.toml";
  request.engines = {"grain", "yade", "lammps"};
  request.said = {"grain", "/my engines/yade.toml", "lammps"};
  request.overrides = {"run.mirrors=false"};
  request.sweeps = {"law.mu=0.2", "law.mu=0.4"};
  request.seeds = {"1", "2"};
  return request;
}

TEST(PlanJobs, SettingsSeedsEngines_MakeAJobEach) {
  const JobPlan plan = planJobs(request(), caseWith);
  ASSERT_EQ(plan.jobs.size(), 2u * 2u * 2u);
  EXPECT_EQ(plan.program, thisProgram());
  EXPECT_EQ(plan.jobs[0].name, "001-a-cell-grain+yade-law.mu=0.2-seed=1");
  EXPECT_EQ(
      plan.jobs[0].words,
      (Texts{"compare", "/cases/a cell.toml", "--engines=grain", "--engines=/my engines/yade.toml",
             "--set=run.mirrors=false", "--set=law.mu=0.2", "--set=preparation.seed=1",
             "--out=results/001-a-cell-grain+yade-law.mu=0.2-seed=1", "--resume", "--quiet"}));
  EXPECT_EQ(plan.jobs[7].name, "008-a-cell-grain+lammps-law.mu=0.4-seed=2");
  EXPECT_EQ(plan.jobs[0].setup, plan.jobs[1].setup);
  EXPECT_NE(plan.jobs[0].setup, plan.jobs[2].setup);
}

TEST(SweptSettings, SeveralKeys_AreCombined) {
  EXPECT_EQ(sweptSettings({}), (std::vector<Texts>{{}}));
  EXPECT_EQ(sweptSettings({"a=1", "b=x", "a=2"}),
            (std::vector<Texts>{{"a=1", "b=x"}, {"a=2", "b=x"}}));
  for (const Texts& wrong : std::vector<Texts>{{"a"}, {"=1"}, {"a="}, {"a=1", "a=1"}})
    EXPECT_THROW(sweptSettings(wrong), BadInput);
}

TEST(PlanJobs, RepeatedSeedOrUsedFolder_Throws) {
  JobRequest twice = request();
  twice.seeds = {"1", "1"};
  EXPECT_THROW(planJobs(twice, caseWith), BadInput);
  const TemporaryFolder folder;
  writeFile(folder.path() / "mine", "");
  EXPECT_THROW(writeSlurm(planJobs(request(), caseWith), folder.path(), "/x"), BadInput);
}

TEST(WriteSlurm, WordsOfTheUser_AreInNoScriptAndReadBack) {
  const TemporaryFolder folder;
  const fs::path slurm = folder.path() / "jobs";
  JobRequest nasty = request();
  nasty.overrides = {"case.name=$(touch pwned)\n`x`'\""};
  const JobPlan plan = planJobs(nasty, caseWith);
  writeSlurm(plan, slurm, "/bin/cross grain");
  const JobPlan back = readPlan(slurm);
  ASSERT_EQ(back.jobs.size(), plan.jobs.size());
  EXPECT_EQ(back.jobs[3].words, plan.jobs[3].words);
  for (const char* script : {"array.sh", "merge.sh", "submit"}) {
    const std::string text = readFile(slurm / script).value();
    for (const char* own : {"touch", "cell", "grain+", "/bin/cross"})
      EXPECT_EQ(text.find(own), std::string::npos) << script << own;
  }
  std::string words = "/bin/cross grain";
  for (const std::string& word : plan.jobs[0].words) words += '\0' + word;
  EXPECT_EQ(readFile(slurm / "jobs" / "1").value(), words + '\0');
}

TEST(ReadPlan, MalformedPlan_Throws) {
  const TemporaryFolder folder;
  EXPECT_THROW(readPlan(folder.path()), BadInput);
  const auto refused = [&](const json& document) {
    writeFile(folder.path() / planFile, document.dump());
    EXPECT_THROW(readPlan(folder.path()), BadInput) << document;
  };
  const auto job = [](const char* name, const char* setup) {
    return json{{"name", name}, {"words", json::array()}, {"setup", setup}, {"engines", {"grain"}}};
  };
  const auto plan = [&](const json& jobs) {
    return json{{"schema", "crossgrain-plan-1"}, {"program", "p"}, {"jobs", jobs}};
  };
  refused(1);
  refused({{"schema", "other"}});
  refused(plan({job("../a", "1")}));
  refused(plan({job("", "1")}));
  refused(plan({job("..", "1")}));
  refused(plan({job("a", "1"), job("a", "2")}));
  refused(plan({job("a", "1"), job("b", "1")}));
  refused(plan({{{"name", 1}}}));
}

/// A plan of three jobs of grain with yade, and results as its jobs leave them.
class JobOutcomes : public testing::Test {
 protected:
  JobOutcomes() {
    JobRequest three = request();
    three.engines = {"grain", "yade"};
    three.said = three.engines;
    three.sweeps = {};
    three.seeds = {"1", "2", "3"};
    plan = planJobs(three, caseWith);
    for (std::size_t k = 0; k < 3; ++k) leave(k, k);
  }

  fs::path folderOf(std::size_t k) const { return folder.path() / "results" / plan.jobs[k].name; }

  /// In the folder of job k what job `of` makes.
  void leave(std::size_t k, std::size_t of, const std::string& program = thisProgram(),
             const std::string& version = "1", int failed = 0) {
    const std::string toml = fmt::format("run.mirrors=false\npreparation.seed={}\n", of + 1);
    json runs = json::array();
    for (int r = 0; r < 4; ++r) runs.push_back({{"status", r < failed ? "failed" : "finished"}});
    const json document = {{"schema", "crossgrain-results-1"},
                           {"kind", "compare"},
                           {"case", {{"toml", toml}}},
                           {"engines",
                            {{{"name", "grain"}, {"version", "1"}},
                             {{"name", "yade"}, {"version", version}},
                             {{"name", "grain-as-yade"}, {"version", "1"}, {"mirrors", "yade"}}}},
                           {"runs", runs}};
    makeDirectory(folderOf(k));
    writeFile(folderOf(k) / "results.json", document.dump());
    writeFile(folderOf(k) / ".crossgrain", json{{"program", program}}.dump());
  }

  /// The second job's results are as they are: the trouble begins so, and the others are merged.
  void expectTrouble(const std::string& trouble, bool merged = false) const {
    const auto outcomes = lookAtJobs(plan, folder.path());
    EXPECT_TRUE(outcomes.at(1).trouble.starts_with(trouble)) << outcomes[1].trouble;
    EXPECT_EQ(outcomes[1].results, merged ? folderOf(1) : fs::path());
    for (const std::size_t k : {0u, 2u}) {
      EXPECT_EQ(outcomes.at(k).trouble, "");
      EXPECT_EQ(outcomes[k].results, folderOf(k));
    }
  }

  TemporaryFolder folder;
  JobPlan plan;
};

TEST_F(JobOutcomes, ResultsThatAreNotAsPlanned_AreReportedAndNotMerged) {
  expectTrouble("", true);
  for (const char* text : {"", "{\"schema\": ", "[]", "{\"schema\": \"crossgrain-results-1\"}",
                           "{\"schema\": \"crossgrain-results-1\", \"kind\": \"compare\"}",
                           "{\"schema\": \"crossgrain-results-1\", \"kind\": \"collide\"}"}) {
    writeFile(folderOf(1) / "results.json", text);
    expectTrouble("broken: ");
  }
  leave(1, 0);
  expectTrouble("doubled: its folder holds the results of " + plan.jobs[0].name);
  leave(1, 7);
  expectTrouble("holds the results of another case than its own");
  leave(1, 1, "0.0.9 (abc)");
  expectTrouble("of another version: of crossgrain 0.0.9 (abc), and the plan is of " +
                thisProgram());
  leave(1, 1, "");
  expectTrouble("of another version: of an unknown build");
  leave(1, 1, thisProgram(), "2");
  expectTrouble("of another version: of yade 2, and " + plan.jobs[0].name + " is of 1");
  leave(1, 1, thisProgram(), "1", 2);
  expectTrouble("2 of 4 runs failed; the others are merged", true);
  fs::remove(folderOf(1) / "results.json");
  expectTrouble("unfinished: ");
  fs::remove_all(folderOf(1));
  expectTrouble("missing: it has not begun");
  makeDirectory(folder.path() / "results" / "004-more");
  EXPECT_EQ(lookAtJobs(plan, folder.path()).at(3).trouble, "belongs to no job of this plan");
}

}  // namespace
}  // namespace crossgrain::inline studies
