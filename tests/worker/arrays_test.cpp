#include "adapters/worker/arrays.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>

#include "engines/cpp/crossgrain_worker.hpp"
#include "support/files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

class ArrayFile : public ::testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "arrays.bin";

  std::string failureOf(const nlohmann::json& list) const {
    return test::refusalOf<std::runtime_error>([&] { ArrayReader reader(file_, list); });
  }
};

TEST_F(ArrayFile, WrittenAndRead_KeepsEveryBit) {
  const std::vector<double> numbers = {-0.0, 5e-324, 0.1, 1e308};
  const std::vector<std::int32_t> ids = {-2147483647 - 1, 7};
  const std::vector<std::uint8_t> flags = {0, 1, 255};
  const std::vector<Vec2> vectors = {{0.1, 0.2}, {-1.0 / 3.0, 4.0}};
  ArrayWriter writer;
  writer.add("flags", flags);
  writer.add("numbers", numbers);
  writer.add("ids", ids);
  writer.add("vectors", vectors);
  writer.add("nothing", std::vector<double>{});
  const ArrayReader reader(file_, writer.write(file_));

  const std::vector<double> readNumbers = reader.f64("numbers", 4);
  EXPECT_EQ(std::memcmp(readNumbers.data(), numbers.data(), 32), 0);
  EXPECT_EQ(reader.i32("ids", 2), ids);
  EXPECT_EQ(reader.u8("flags", 3), flags);
  EXPECT_EQ(reader.vectors<2>("vectors", 2), vectors);
  EXPECT_TRUE(reader.f64("nothing", 0).empty());
  EXPECT_FALSE(reader.has("other"));

  const auto* const bytes = reinterpret_cast<const char*>(writer.bytes().data());
  const ArrayReader content(std::string(bytes, writer.bytes().size()), "content", writer.list());
  EXPECT_EQ(content.vectors<2>("vectors", 2), vectors);
  EXPECT_THROW(ArrayReader(std::string(bytes, 8), "content", writer.list()), std::runtime_error);
}

TEST_F(ArrayFile, WorkersInCpp_ReadMaterialsAsNumbers) {
  ArrayWriter writer;
  writer.add("disks.mass", std::vector<double>{0.1, 1e-3});
  writer.add("disks.material", std::vector<std::int32_t>{0, 2, 1});
  const crossgrain_worker::Arrays arrays =
      crossgrain_worker::readArrays(file_, writer.write(file_));
  EXPECT_EQ(arrays.at("disks.mass"), (std::vector{0.1, 1e-3}));
  EXPECT_EQ(arrays.at("disks.material"), (std::vector{0.0, 2.0, 1.0}));
}

TEST_F(ArrayFile, Bytes_AreLittleEndianAndAligned) {
  ArrayWriter writer;
  writer.add("flag", std::vector<std::uint8_t>{7});
  writer.add("id", std::vector<std::int32_t>{0x01020304});
  const nlohmann::json list = writer.write(file_);
  EXPECT_EQ(list[1],
            nlohmann::json({{"name", "id"}, {"type", "i32"}, {"count", 1}, {"offset", 8}}));
  std::ifstream in(file_, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(bytes, std::string("\7\0\0\0\0\0\0\0\4\3\2\1", 12));
}

TEST_F(ArrayFile, ListThatDoesNotFit_IsRefused) {
  std::ofstream(file_) << "0123456789";  // 10 bytes
  const auto entry = [](const char* type, auto count, auto offset) {
    return nlohmann::json{{{"name", "x"}, {"type", type}, {"count", count}, {"offset", offset}}};
  };
  EXPECT_EQ(failureOf(entry("u8", 10, 0)), "");
  const std::string name = file_.filename().string();
  EXPECT_EQ(failureOf(entry("f64", 2, 0)),
            name + " is too short: x needs 2 × 8 bytes from byte 0, the file has 10 bytes");
  EXPECT_NE(failureOf(entry("u8", 1, 11)), "");
  // 2^61 × 8 bytes overflow a 64-bit product to zero.
  EXPECT_NE(failureOf(entry("f64", std::uint64_t{1} << 61, 0)), "");
  EXPECT_EQ(failureOf(entry("u8", -1, 0)), name + ": count of x is -1, not a whole number ≥ 0");
  EXPECT_EQ(failureOf(entry("f32", 1, 0)),
            name + ": x has the type 'f32' (it is one of: f64, i32, u8)");
}

TEST_F(ArrayFile, NanInfinityOrWrongCount_IsRefused) {
  ArrayWriter writer;
  writer.add("x", std::vector<double>{1.0, std::numeric_limits<double>::infinity()});
  writer.add("v", std::vector<Vec2>{{1.0, 2.0}});
  const ArrayReader reader(file_, writer.write(file_));
  const std::string name = file_.filename().string();
  const auto failure = [](auto read) { return test::refusalOf<std::runtime_error>(read); };
  EXPECT_EQ(failure([&] { reader.f64("x", 2); }), name + ": x[1] is inf");
  EXPECT_EQ(failure([&] { reader.vectors<2>("v", 2); }), name + ": v is 2 × f64, expected 4 × f64");
  EXPECT_EQ(failure([&] { reader.i32("x", 2); }), name + ": x is 2 × f64, expected 2 × i32");
  EXPECT_EQ(failure([&] { reader.f64("y", 2); }), name + " has no array 'y'");
}

namespace fs = std::filesystem;

class FileOfExchanges : public ::testing::Test {
 protected:
  const TemporaryFolder own_;
  const fs::path folder_ = own_.path();

  static ArrayWriter numbers(std::size_t count) {
    ArrayWriter arrays;
    arrays.add("numbers", std::vector<double>(count, 0.1));
    return arrays;
  }
};

TEST_F(FileOfExchanges, Kept_NextExchange_HoldsNoNumber) {
  ExchangeFile file(folder_ / "toy");
  const fs::path path = file.next(true);
  EXPECT_EQ(path, folder_ / "toy.bin");
  EXPECT_EQ(file.read(file.write(numbers(3))).f64("numbers", 3), std::vector(3, 0.1));
  file.done();
  EXPECT_EQ(file.next(true), path);
  EXPECT_EQ(readFile(path), std::string(24, '\xff'));
  EXPECT_THROW(file.read(numbers(3).list()).f64("numbers", 3), std::runtime_error);
}

TEST_F(FileOfExchanges, Kept_GrownTooLong_IsMadeAnew) {
  ExchangeFile file(folder_ / "toy");
  const fs::path path = file.next(true);
  fs::resize_file(path, (std::uintmax_t{16} << 20) + 1);
  EXPECT_EQ(file.next(true), path);
  EXPECT_EQ(fs::file_size(path), 0u);
}

TEST_F(FileOfExchanges, NotKept_EachExchange_HasAnotherFile) {
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
