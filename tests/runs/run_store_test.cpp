#include "runs/run_store.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "cases/bad_input.hpp"
#include "cases/files.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

fs::path freshFolder(const char* name) {
  const fs::path folder = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder);
  return folder;
}

TEST(RunStore, GivesBackOnlyRunsOfTheSameKey) {
  const fs::path out = freshFolder("store");
  RunStore(out).keep("a-p0", "key", {{"value", 0.1}});
  const RunStore again(out);
  ASSERT_TRUE(again.find("a-p0", "key"));
  EXPECT_EQ((*again.find("a-p0", "key"))["value"], 0.1);
  EXPECT_FALSE(again.find("a-p0", "another key"));
  EXPECT_FALSE(again.find("a-p1", "key"));
  again.startAfresh();
  EXPECT_FALSE(again.find("a-p0", "key"));
}

TEST(RunStore, NeverTouchesAFolderThatIsNotItsOwn) {
  const fs::path out = freshFolder("foreign");
  fs::create_directories(out / "runs");
  std::ofstream(out / "runs" / "thesis.txt") << "ten years of work";
  EXPECT_THROW(RunStore{out}, BadInput);
  EXPECT_TRUE(fs::exists(out / "runs" / "thesis.txt"));
}

TEST(RunStore, ADamagedRunIsRunAgain) {
  const fs::path out = freshFolder("damaged");
  RunStore(out).keep("a-p0", "key", {{"value", 1}});
  std::ofstream(out / "runs" / "a-p0.json") << "{\"key\": \"key\", ";
  EXPECT_FALSE(RunStore(out).find("a-p0", "key"));
}

TEST(RunStore, AFolderThatCannotBeMadeIsAnOutputError) {
  const fs::path file = freshFolder("file");
  std::ofstream(file) << "not a folder";
  EXPECT_THROW(RunStore(file / "out"), OutputError);
}

}  // namespace
