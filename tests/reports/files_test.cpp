#include "support/files.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "reports/report.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& dir) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(dir), {}));
}

TEST(WriteFile, OldFile_IsReplacedAndNothingLeftBeside) {
  const TemporaryFolder folder;
  writeFile(folder.path() / "a.txt", "old and longer");
  writeFile(folder.path() / "a.txt", "new");
  EXPECT_EQ(readFile(folder.path() / "a.txt"), "new");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(WriteFile, MissingFolder_NamesTheFileAndTheReason) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "missing" / "a.txt";
  EXPECT_EQ(test::refusalOf<std::runtime_error>([&] { writeFile(file, "x"); }),
            file.string() + ": cannot be written: No such file or directory");
}

/// A limit on the size of files stands for a full disk. It holds for a whole process, hence the
/// child.
[[noreturn]] void writeBeyondTheLimit(const fs::path& file) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, 1000};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message =
      test::refusalOf<std::runtime_error>([&] { writeFile(file, std::string(5000, 'x')); });
  const bool intact = readFile(file) == "old" && entries(file.parent_path()) == 1;
  std::fprintf(stderr, "%s%s\n", message.c_str(), intact ? " (old file intact)" : "");
  std::_Exit(7);  // exit() would take the folder of the whole test program along
}

TEST(WriteFile, FullDisk_LeavesTheOldFileAndNoHalfOne) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  writeFile(file, "old");
  EXPECT_EXIT(writeBeyondTheLimit(file), testing::ExitedWithCode(7),
              "a.txt: cannot be written: File too large .old file intact.");
}

TEST(WriteReport, FolderThatCannotBeMade_IsOneLine) {
  const TemporaryFolder folder;
  writeFile(folder.path() / "file", "");
  const fs::path dir = folder.path() / "file" / "out";
  EXPECT_EQ(
      test::refusalOf<std::runtime_error>([&] { writeReport(sample::collideResults(), dir); }),
      dir.string() + ": cannot be written: Not a directory");
}

TEST(Results, WrittenAndRead_AreTheSame) {
  const TemporaryFolder folder;
  const nlohmann::json results = toJson(sample::compareResults(2, 50));
  writeFile(folder.path() / "results.json", toText(results));
  EXPECT_EQ(readResults(folder.path()), results);
}

TEST(Results, BytesThatAreNotUtf8_AreWritten) {
  CollideResults results = sample::collideResults();
  results.head.command = "latin1 \xe9";
  EXPECT_TRUE(nlohmann::json::accept(toText(toJson(results))));
}

TEST(Results, FolderWithoutThem_SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "results.json").string();
  const auto message = [&] {
    return test::refusalOf<BadInput>([&] { static_cast<void>(readResults(folder.path())); });
  };
  EXPECT_EQ(message(),
            file +
                ": cannot be read; a folder that compare, collide, lockstep, effects, cost, "
                "stability, conformance, average or rev wrote has it");
  writeFile(file, "{\"schema\": ");
  EXPECT_TRUE(message().starts_with(file + ": is not JSON, byte ")) << message();
  writeFile(file, "{\"schema\": \"crossgrain-results-9\"}");
  EXPECT_EQ(message(), file +
                           ": has schema \"crossgrain-results-9\", this crossgrain reads "
                           "\"crossgrain-results-1\"");
  writeFile(file, "{\"schema\": \"crossgrain-results-1\", \"kind\": \"dance\"}");
  EXPECT_EQ(message(), file +
                           ": has kind \"dance\", a report is made of one of \"compare\", "
                           "\"collide\", \"lockstep\", \"effects\", \"cost\", \"average\", "
                           "\"rev\", \"stability\", \"conformance\"");
}

}  // namespace
}  // namespace crossgrain::reports
