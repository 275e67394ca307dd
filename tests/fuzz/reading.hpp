#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/bad_input.hpp"
#include "support/json_text.hpp"
#include "tests/fuzz/damage.hpp"
#include "tests/support/input_range.hpp"

namespace crossgrain::test {

/// Anew: some file systems wait for the disk where a file that is there is cut to nothing.
inline void write(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::remove(file);
  std::ofstream(file, std::ios::binary) << content;
}

/// Counts what became of inputs, and holds refusals to one line.
class Reading {
 public:
  template <typename Work>
  void read(std::uint64_t number, Work&& work) {
    try {
      work();
      ++taken;
    } catch (const BadInput& refusal) {
      expectLine(number, refusal.what());
    } catch (const FieldError& refusal) {
      expectLine(number, refusal.what());
    } catch (const std::exception& other) {
      ADD_FAILURE() << "input " << number << ": neither taken nor refused: " << other.what();
    }
  }
  std::uint64_t taken = 0, refused = 0;

 private:
  void expectLine(std::uint64_t number, const std::string& line) {
    EXPECT_FALSE(line.empty()) << "input " << number;
    EXPECT_EQ(line.find('\n'), std::string::npos) << "input " << number << ": " << line;
    ++refused;
  }
};

/// Reads the inputs asked for, `usual` unless others are, until one is read wrongly. Both happen,
/// or the inputs would be no test; of few there may be none.
/// @param work  (number, draws of that number): reads it, or throws why it is refused
/// @param leastRefused  a part of all
template <typename Work>
void readAll(std::uint64_t usual, Work&& work, double leastTaken = 0.01,
             double leastRefused = 0.1) {
  Reading reading;
  const InputRange all = inputs(usual);
  for (std::uint64_t k = all.from; k < all.to && !testing::Test::HasFailure(); ++k) {
    Draw draw(k);
    reading.read(k, [&] { work(k, draw); });
  }
  if (all.size() < 100) return;
  const auto size = static_cast<double>(all.size());
  EXPECT_GT(static_cast<double>(reading.taken), leastTaken * size);
  EXPECT_GT(static_cast<double>(reading.refused), leastRefused * size);
}

}  // namespace crossgrain::test
