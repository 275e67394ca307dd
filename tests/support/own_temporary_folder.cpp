#include <gtest/gtest.h>
#include <stdlib.h>

#include <optional>

#include "tests/support/temporary_folder.hpp"

/// Every run of a test program has a folder of its own for what it writes: ctest runs the tests of
/// one program side by side, and a file that two of them write is read half written by one.
namespace {

class OwnTemporaryFolder : public testing::Environment {
 public:
  void SetUp() override {
    folder_.emplace();
    ::setenv("TEST_TMPDIR", folder_->path().c_str(), 1);  // testing::TempDir()
    ::setenv("TMPDIR", folder_->path().c_str(), 1);       // std::filesystem's
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::optional<TemporaryFolder> folder_;
};

const testing::Environment* const ownTemporaryFolder =
    testing::AddGlobalTestEnvironment(new OwnTemporaryFolder);

}  // namespace
