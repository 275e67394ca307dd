#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/files/frame.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::files::sampled {

/// A folder of files for one test.
class Samples {
 public:
  explicit Samples(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path write(const std::string& name, std::string_view content) const;
  /// All times of some files, as one run.
  std::vector<FileFrame> read(std::string_view format, const std::vector<std::string>& names,
                              const FileOptions& options = {}) const;
  /// Message of their refusal, without the folder's name; empty if they are read.
  std::string refusal(std::string_view format, const std::vector<std::string>& names,
                      const FileOptions& options = {}) const;

 private:
  std::filesystem::path folder_;
};

/// A test and its folder.
class Sampled : public testing::Test {
 protected:
  TemporaryFolder folder_;
  Samples samples_{folder_.path()};
};

inline void expectNear(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " and " << b.transpose();
}

/// tests/files/samples.
Samples programs();

/// Two spheres of radius 0.5 that overlap by 0.02 along x, force 20 along and 3 across: the example
/// of the sheet of formats, as .data and .fstat.
inline constexpr std::string_view pairData =
    "2 0.5 0 0 0 4 4 4\n"
    "1.0 2 2  0.1 0 0  0.5  0 0 0  0 0 1  0\n"
    "1.98 2 2  0 0 0  0.5  0 0 0  0 0 0  0\n";
inline constexpr std::string_view pairFstat =
    "# 0.5 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n"
    "0.5 0 1  1.49 2 2  0.02 -0.001  20 3  -1 0 0  0 -1 0\n"
    "0.5 1 0  1.49 2 2  0.02 -0.001  20 3  1 0 0  0 1 0\n";

/// The same as ON-DEM's exporter would write it, with a floor below the first: body 7 touches the
/// wall 0 with 5 N. Some of it may be changed.
struct OnDemSample {
  double sign = 1.0;                 ///< of normal_force
  std::vector<std::string> without;  ///< datasets that are left out
};
void writeOnDem(const std::filesystem::path& file, const OnDemSample& sample = {});

}  // namespace crossgrain::files::sampled
