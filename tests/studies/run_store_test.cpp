#include "studies/core/run_store.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/scratch_folder.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;
using Cases = std::map<std::string, CaseKeys>;

const CaseKeys key = {{"engine", "a"}, {"engine version", "1"}};
const Cases rings20 = {{"", {{"averaging.rings", "20"}, {"law.mu", "0.44"}}}};
const Cases rings40 = {{"", {{"averaging.rings", "40"}, {"law.kn", "1.0"}}}};

class RunStoreTest : public testing::Test {
 protected:
  RunStoreTest() { command_.out = folder_.path() / "out"; }

  /// A command that finishes one run.
  void finish(const std::string& name = "compare", const Cases& cases = rings20) {
    RunStore store(command_, name, cases);
    store.begin();
    store.keep("a-p0", key, {{"value", 0.1}});
  }

  std::string refusal(const std::string& name, const Cases& cases) {
    return test::refusalOf([&] { const RunStore store(command_, name, cases); });
  }

  bool isFinished() { return fs::exists(command_.out / "runs" / "a-p0.json.gz"); }

  const TemporaryFolder folder_;
  RunCommand command_;
};

TEST_F(RunStoreTest, SameCase_LoadsFinishedRuns) {
  finish();
  const RunStore again(command_, "compare", rings20);
  ASSERT_TRUE(again.find("a-p0", key));
  EXPECT_EQ((*again.find("a-p0", key))["value"], 0.1);
  EXPECT_FALSE(again.find("a-p1", key));
}

TEST_F(RunStoreTest, ChangedCaseOrCommand_ThrowsWithEveryKey) {
  finish();
  const std::string why = refusal("compare", rings40);
  test::expectSays(
      why, {"averaging.rings: 20 → 40; law.kn: none → 1.0; law.mu: 0.44 → none", "--fresh"});
  const std::string other = refusal("collide", {});
  EXPECT_NE(other.find("'crossgrain compare', not of 'collide'"), std::string::npos) << other;
  EXPECT_TRUE(isFinished());
}

TEST_F(RunStoreTest, ReportWithoutRuns_BelongsToItsCommand) {
  {
    RunStore store(command_, "average", {});
    store.begin();
  }
  std::ofstream(command_.out / "results.json") << "{}";
  EXPECT_EQ(refusal("average", {}), "");
  EXPECT_NE(refusal("rev", {}).find("'crossgrain average'"), std::string::npos);
}

TEST_F(RunStoreTest, OtherBuild_ThrowsNamingBoth) {
  finish();
  const fs::path marker = command_.out / ".crossgrain";
  auto said = nlohmann::json::parse(*readFile(marker));
  const std::string own = said["program"];
  said["program"] = "0.0.9 (abc)";
  std::ofstream(marker) << said;
  const std::string why = refusal("compare", rings20);
  test::expectSays(why, {"another build of crossgrain: 0.0.9 (abc) → " + own});
}

TEST_F(RunStoreTest, OtherEngineVersion_ThrowsNamingBoth) {
  finish();
  const RunStore again(command_, "compare", rings20);
  const std::string why = test::refusalOf([&] {
    again.find("a-p0", {{"engine", "a"}, {"engine version", "2"}});
  });
  test::expectSays(why, {"a-p0", "engine version: 1 → 2"});
  // An engine that did not answer is not known to be another.
  EXPECT_TRUE(again.find("a-p0", {{"engine", "a"}, {"engine version", ""}}));
}

TEST_F(RunStoreTest, FurtherCase_IsTakenAndEarlierOnesStay) {
  finish("collide", {{"one", {{"law.mu", "0.1"}}}});
  {
    RunStore store(command_, "collide", {{"two", {{"law.mu", "0.2"}}}});
    store.begin();
  }
  EXPECT_EQ(refusal("collide", {{"two", {{"law.mu", "0.2"}}}}), "");
  EXPECT_NE(refusal("collide", {{"one", {{"law.mu", "0.3"}}}}).find("law.mu: 0.1 → 0.3"),
            std::string::npos);
}

TEST_F(RunStoreTest, NothingFinished_TakesAnyCommand) {
  {
    RunStore store(command_, "compare", rings20);
    store.begin();
  }
  EXPECT_EQ(refusal("compare", rings40), "");
  EXPECT_EQ(refusal("collide", {}), "");
}

TEST_F(RunStoreTest, CommandThatDidNotBegin_LeavesNoFolder) {
  { const RunStore store(command_, "compare", rings20); }
  EXPECT_FALSE(fs::exists(command_.out));
  fs::create_directories(command_.out);
  { const RunStore store(command_, "compare", rings20); }
  EXPECT_TRUE(fs::exists(command_.out));
  EXPECT_EQ(refusal("collide", {}), "");
}

TEST_F(RunStoreTest, Fresh_SetsAsideWhatIsThere) {
  finish();
  std::ofstream(command_.out / "results.json") << "{}";
  command_.fresh = true;
  for (const char* number : {"1", "2"}) {
    testing::internal::CaptureStderr();
    RunStore store(command_, "collide", rings40);
    store.begin();
    const fs::path aside = command_.out / "earlier" / number;
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "what was there is now in " + aside.string() + "\n");
    EXPECT_FALSE(store.find("a-p0", key));
    EXPECT_TRUE(fs::exists(aside / "runs" / "a-p0.json.gz"));
    store.keep("a-p0", key, {{"value", 0.2}});
  }
  // A folder that was set aside is like any other.
  command_.fresh = false;
  command_.out /= "earlier/1";
  EXPECT_TRUE(RunStore(command_, "compare", rings20).find("a-p0", key));
  EXPECT_TRUE(fs::exists(command_.out / "results.json"));
}

TEST_F(RunStoreTest, FolderOfOthers_ThrowsEvenWithFresh) {
  fs::create_directories(command_.out / "runs");
  std::ofstream(command_.out / "runs" / "thesis.txt") << "ten years of work";
  for (const bool fresh : {false, true}) {
    command_.fresh = fresh;
    EXPECT_THROW(RunStore(command_, "compare", rings20), BadInput);
  }
  EXPECT_TRUE(fs::exists(command_.out / "runs" / "thesis.txt"));
  command_.fresh = false;
  command_.out /= "runs/thesis.txt/out";  // which cannot be made
  EXPECT_THROW(RunStore(command_, "compare", rings20), OutputError);
}

/// A member of the wrong type is named with its file; a pipe, which might never end, is not opened.
TEST_F(RunStoreTest, MalformedFile_ThrowsNamingFileAndMember) {
  finish();
  const fs::path run = command_.out / "runs" / "a-p0.json.gz",
                 marker = command_.out / ".crossgrain";
  const auto find = [&] { RunStore(command_, "compare", rings20).find("a-p0", key); };
  const std::string whole = *readFile(run);
  // Half a file is run anew.
  for (const std::string& half :
       {whole.substr(0, whole.size() / 2), packed(R"({"key": {"engine": "a"}, )")}) {
    writeFile(run, half);
    EXPECT_FALSE(RunStore(command_, "compare", rings20).find("a-p0", key));
  }
  writeFile(run, packed(R"({"key": {"engine": 7}, "run": {}})"));
  EXPECT_EQ(test::refusalOf(find), run.string() + ": key.engine: is number, not a text");
  writeFile(run,
            packed(R"({"key": {"engine": "a", "engine version": "1"}, "run": {"value": "a"}})"));
  EXPECT_NE(
      test::refusalOf([&] {
        RunStore(command_, "compare", rings20).findAs<std::map<std::string, double>>("a-p0", key);
      }).find(run.string() + ": value: is string, not a number"),
      std::string::npos);
  fs::remove(run);
  ASSERT_EQ(::mkfifo(run.c_str(), 0600), 0);
  EXPECT_EQ(test::refusalOf(find), run.string() + ": is a named pipe, not a file");
  std::ofstream(marker) << R"({"command": 7})";
  EXPECT_EQ(refusal("compare", rings20), marker.string() + ": command: is number, not a text");
  fs::remove(marker);
  ASSERT_EQ(::mkfifo(marker.c_str(), 0600), 0);
  EXPECT_EQ(refusal("compare", rings20), marker.string() + ": is a named pipe, not a file");
}

TEST_F(RunStoreTest, Scratch_GoesWithTheStoreButForWhatFailed) {
  for (const bool fails : {true, false}) {
    {
      RunStore store(command_, "compare", rings20);
      store.begin();
      for (const char* name : {"ask-a", "a-p0", "a-p1"})
        fs::create_directories(store.scratch(name));
      if (fails) store.failed("a-p1");
    }
    EXPECT_EQ(fs::exists(command_.out / "scratch"), fails);
    EXPECT_EQ(fs::exists(command_.out / "scratch" / "a-p1"), fails);
    EXPECT_FALSE(fs::exists(command_.out / "scratch" / "ask-a"));
  }
}

/// gzip's own format (RFC 1952), which other programs read.
TEST(Files, PackedText_IsReadBackWholeOrNotAtAll) {
  std::string text;
  for (int k = 0; k < 300'000; ++k) text += fmt::format("{},", k * 0.1);
  ASSERT_GT(text.size(), std::size_t{1} << 20);
  const std::string content = packed(text);
  EXPECT_LT(content.size(), text.size() / 2);
  EXPECT_TRUE(content.starts_with("\x1f\x8b\x08"));
  EXPECT_EQ(unpacked(content), text);
  EXPECT_EQ(unpacked(packed("")), "");
  EXPECT_FALSE(unpacked(content, text.size() - 1));
  EXPECT_FALSE(unpacked(content.substr(0, content.size() - 1)));
  std::string damaged = content;
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_FALSE(unpacked(damaged));
  EXPECT_FALSE(unpacked("no such thing"));
}

TEST(Files, FileBeyondItsBoundOrNone_Throws) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path / "file";
  EXPECT_FALSE(readFile(file));
  writeFile(file, "0123456789");
  EXPECT_EQ(readFile(file, 10), "0123456789");
  EXPECT_THROW(readFile(file, 9), BadInput);
  EXPECT_THROW(readFile(scratch.path), BadInput);
  EXPECT_THROW(readFile("/dev/zero"), BadInput);
  EXPECT_GT(readFile("/proc/self/status")->size(), 0u);  // whose length is not given
  fs::resize_file(file, std::uintmax_t{50} << 30);       // sparse: it takes no room
  EXPECT_THROW(readFile(file), BadInput);
}

/// A parser that calls itself for each nested list would use up its stack.
TEST(JsonText, TooDeepOrMalformed_Throws) {
  EXPECT_EQ(parseJson("[[[1]]]", 3).dump(), "[[[1]]]");
  EXPECT_THROW(parseJson("[[[[1]]]]", 3), std::runtime_error);
  EXPECT_THROW(parseJson(std::string(1'000'000, '[')), std::runtime_error);
  EXPECT_THROW(parseJson(R"({"a": 1, "a": 2})"), std::runtime_error);
  EXPECT_THROW(parseJson("{"), NotJson);
  EXPECT_EQ(test::refusalOf([] {
              understood("run.json",
                         [] { return member<double>(parseJson(R"({"dt": "1"})"), "dt"); });
            }),
            "run.json: dt: type must be number, but is string");
}

TEST_F(RunStoreTest, DryRun_WritesNothing) {
  command_.dryRun = true;
  {
    RunStore store(command_, "compare", rings20);
    store.begin();
  }
  EXPECT_FALSE(fs::exists(command_.out));
  command_.dryRun = false;
  finish();
  command_.dryRun = true;
  EXPECT_TRUE(RunStore(command_, "compare", rings20).find("a-p0", key));
  EXPECT_NE(refusal("compare", rings40), "");
  command_.fresh = true;
  EXPECT_FALSE(RunStore(command_, "compare", rings40).find("a-p0", key));
  EXPECT_TRUE(isFinished());
}

TEST_F(RunStoreTest, FolderInUse_ThrowsNamingTheProcess) {
  const RunStore store(command_, "compare", rings20);
  const std::string why = refusal("compare", rings20);
  EXPECT_NE(why.find(fmt::format("in use by crossgrain compare, process {}, since ", ::getpid())),
            std::string::npos)
      << why;
}

TEST_F(RunStoreTest, LockOfDeadProcess_IsIgnored) {
  finish();
  std::ofstream(command_.out / FolderLock::name) << "crossgrain compare, process 1, since long ago";
  EXPECT_EQ(refusal("compare", rings20), "");
  EXPECT_FALSE(fs::exists(command_.out / FolderLock::name));
}

}  // namespace
