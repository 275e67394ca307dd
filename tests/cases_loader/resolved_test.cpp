// `check --resolved`: every case that is shipped, printed with all layers merged, loads to itself
// from anywhere.
#include <gtest/gtest.h>

#include "cases/packing.hpp"
#include "cases/time_step.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

using Resolved = InFolder;

void expectSame(const Case& a, const Case& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.variant, b.variant);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.resolvedToml, b.resolvedToml);
  EXPECT_EQ(a.particles.file, b.particles.file);
  if (a.kind == CaseKind::couette) {
    EXPECT_EQ(packingHash(a, 0, 1e-5), packingHash(b, 0, 1e-5));
    ASSERT_EQ(a.averaging.margins.size(), b.averaging.margins.size());
    for (const auto& [field, margin] : a.averaging.margins) {
      EXPECT_EQ(margin.value, b.averaging.margins.at(field).value) << field;
      EXPECT_EQ(margin.why, b.averaging.margins.at(field).why);
    }
  }
  if (a.kind == CaseKind::collision) {
    EXPECT_EQ(a.collision.psi, b.collision.psi);
  }
}

TEST_F(Resolved, EveryShippedCaseLoadsToItself) {
  int count = 0;
  for (const char* const part : {"couette", "collision", "cost", "hard"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(CROSSGRAIN_CASES) / part)) {
      if (entry.path().extension() != ".toml") continue;
      const std::vector<Case> once = loadCase(entry.path());
      const std::string text = resolvedFile(once);
      write("again.toml", text);
      const std::vector<Case> again = loadCase("again.toml");
      ASSERT_EQ(once.size(), again.size()) << entry.path();
      for (std::size_t k = 0; k < once.size(); ++k) expectSame(once[k], again[k]);
      EXPECT_EQ(resolvedFile(again), text) << entry.path();
      ++count;
    }
  EXPECT_GT(count, 60);
}

TEST_F(Resolved, OverridesAreInIt) {
  write("case.toml", soundCase +
                         "[[variants]]\nname = \"a\"\nlaw.mu = 0.1\n"
                         "[[variants]]\nname = \"b\"\nparticles.small = 200\n");
  const auto once = loadCase("case.toml", {"law.mu=0.3"});
  write("again.toml", resolvedFile(once));
  const auto again = loadCase("again.toml");
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again[0].law.mu, 0.3);
  EXPECT_EQ(again[1].particles.small, 200);
  EXPECT_EQ(again[0].particles.small, 210);
}

TEST_F(Resolved, APackingFileIsNamedInFull) {
  write("sub/mine.h5", "");
  write("sub/case.toml", soundCase + "file = \"mine.h5\"\n[run]\ndt = 1e-5\n");
  const auto once = loadCase("sub/case.toml");
  write("again.toml", resolvedFile(once));
  EXPECT_EQ(std::filesystem::absolute(*once.front().particles.file),
            *loadCase("again.toml").front().particles.file);
}

}  // namespace
}  // namespace crossgrain::test
