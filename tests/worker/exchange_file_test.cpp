#include "adapters/worker/exchange_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace crossgrain {
namespace {

namespace fs = std::filesystem;

class FileOfExchanges : public ::testing::Test {
 protected:
  fs::path folder_ = fs::path(::testing::TempDir()) / "crossgrain-exchange-file";
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FileOfExchanges() override { fs::remove_all(folder_); }

  static std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static ArrayWriter numbers(std::size_t count) {
    ArrayWriter arrays;
    arrays.add("numbers", std::vector<double>(count, 0.1));
    return arrays;
  }
};

TEST_F(FileOfExchanges, IsTheSameAndHoldsNoNumberBeforeEach) {
  ExchangeFile file(folder_ / "toy");
  const fs::path path = file.next(true);
  EXPECT_EQ(path, folder_ / "toy.bin");
  EXPECT_EQ(file.read(file.write(numbers(3))).f64("numbers", 3), std::vector(3, 0.1));
  file.done();
  EXPECT_EQ(file.next(true), path);
  EXPECT_EQ(contentOf(path), std::string(24, '\xff'));
  EXPECT_THROW(file.read(numbers(3).list()).f64("numbers", 3), std::runtime_error);
}

TEST_F(FileOfExchanges, IsMadeAnewWhereItHasGrownTooLong) {
  ExchangeFile file(folder_ / "toy");
  const fs::path path = file.next(true);
  fs::resize_file(path, (std::uintmax_t{16} << 20) + 1);
  EXPECT_EQ(file.next(true), path);
  EXPECT_EQ(fs::file_size(path), 0u);
}

TEST_F(FileOfExchanges, IsAnotherEachTimeForAWorkerThatDoesNotWriteOver) {
  ExchangeFile file(folder_ / "toy");
  for (const char* name : {"toy-1.bin", "toy-2.bin"}) {
    const fs::path path = file.next(false);
    EXPECT_EQ(path, folder_ / name);
    EXPECT_EQ(file.read(file.write(numbers(2))).f64("numbers", 2), std::vector(2, 0.1));
    file.done();
    EXPECT_FALSE(fs::exists(path));
  }
}

}  // namespace
}  // namespace crossgrain
