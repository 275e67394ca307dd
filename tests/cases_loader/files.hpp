#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cases/loader.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::test {

/// A folder of its own for one test, and the current one while the test runs, so that messages name
/// files as they were written.
class InFolder : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::current_path(folder_.path()); }
  void TearDown() override { std::filesystem::current_path(before_); }
  static void write(const std::filesystem::path& file, const std::string& text) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

 private:
  const std::filesystem::path before_ = std::filesystem::current_path();
  const TemporaryFolder folder_;
};

/// A couette case with nothing left out that must be there, and nothing else.
inline const std::string soundCase = R"([case]
kind = "couette"
[law]
kn = 352.1
gn = 0.19
mu = 0.44
kt = 267.1
gt = 0.15
tangential = "spring_dashpot"
[cell]
inner_radius = 0.03
outer_radius = 0.075
wall_radius = 0.00125
wall_spacing = 0.0025
height = 0.006
omega = 1.0
[particles]
small = 210
large = 34
small_radius = 0.0037
large_radius = 0.004495
small_mass = 0.275e-3
large_mass = 0.490e-3
)";

/// A collision of a soft law, likewise.
inline const std::string soundCollision = R"([case]
kind = "collision"
[law]
kn = 352.1
gn = 0.19
mu = 0.44
tangential = "coulomb"
[collision]
psi = [0.0, 1.0]
vn = 0.01
radius = 0.0037
mass = 0.275e-3
)";

/// An assembly of one disk, likewise.
inline const std::string soundAssembly = R"([case]
kind = "assembly"
[law]
kn = 100.0
gn = 0.0
tangential = "none"
[assembly]
contact_times = 3
[[assembly.disks]]
position = [0.0, 1.0]
radius = 0.5
mass = 2.0
)";

/// The text with one line (counted from 1) replaced.
inline std::string withLine(const std::string& text, int number, const std::string& line) {
  std::size_t from = 0;
  for (int k = 1; k < number; ++k) from = text.find('\n', from) + 1;
  return text.substr(0, from) + line + text.substr(text.find('\n', from));
}

/// The message that loading the file ends in; empty if it loads.
inline std::string messageOf(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {}) {
  return refusalOf([&] { loadCase(file, overrides); });
}

/// Of a case file of that text.
inline std::string messageOfText(const std::string& text) {
  std::ofstream("case.toml") << text;
  return messageOf("case.toml");
}

inline void expectMessage(const std::string& text, const std::string& part) {
  const std::string message = messageOfText(text);
  EXPECT_NE(message.find(part), std::string::npos) << message << "\nis not: " << part;
}

using LoaderErrors = InFolder;

struct Bad {
  std::string text;     ///< of case.toml
  std::string message;  ///< all of it
};

inline void expectMessages(const std::vector<Bad>& bads) {
  for (const Bad& bad : bads) {
    std::ofstream("case.toml") << bad.text;
    EXPECT_EQ(messageOf("case.toml"), bad.message) << bad.text;
  }
}

/// The sound case with one line replaced, or with lines added from line 24 on.
inline std::string line(int number, const std::string& text) {
  return withLine(soundCase, number, text);
}
inline std::string plus(const std::string& lines) {
  return soundCase + lines;
}

/// The sound collision likewise; lines are added from line 13 on.
inline std::string collision(int number, const std::string& text) {
  return withLine(soundCollision, number, text);
}

}  // namespace crossgrain::test
