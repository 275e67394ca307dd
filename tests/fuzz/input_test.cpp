/// Input of users, whatever it is, is read to something sound or refused in one line: case files,
/// packings and starts of their own, results of earlier runs. Inputs depend on their number alone;
/// README.md says how a million of each kind are read. Inputs that were once read wrongly are kept
/// in corpus/.
#include <gtest/gtest.h>

#include <hdf5.h>

#include <algorithm>
#include <functional>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "cases/start_file.hpp"
#include "results/conformance.hpp"
#include "results/schema.hpp"
#include "results/stability.hpp"
#include "support/files.hpp"
#include "tests/fuzz/reading.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

using test::write;

TEST(FuzzedInput, CasesLoadOrAreRefusedInOneLine) {
  const fs::path cases = CROSSGRAIN_CASES;
  const TemporaryFolder folder;
  fs::copy(cases / "laws", folder.path() / "laws");
  for (const char* name : {"couette", "hard", "collision", "assembly"})
    fs::create_directory(folder.path() / name);
  fs::copy(cases / "hard/restitution.toml", folder.path() / "hard");
  fs::copy(cases / "collision/figure-4-3.toml", folder.path() / "collision");
  std::vector<std::string> corpus;
  std::vector<fs::path> places;
  for (const char* name :
       {"couette/quick.toml", "hard/restart.toml", "hard/wedge.toml", "hard/copies.toml",
        "hard/restitution-of-a-wall.toml", "collision/wall-oblique.toml",
        "assembly/plane-shear.toml", "collision/chung-ooi-5.toml"}) {
    corpus.push_back(readFile(cases / name).value());
    places.push_back(folder.path() / fs::path(name).parent_path() / "fuzzed.toml");
  }
  test::readAll(10'000, [&](std::uint64_t k, test::Draw& draw) {
    const std::size_t which = k % corpus.size();
    write(places[which], test::damagedText(corpus[which], draw));
    const std::vector<Case> loaded = loadCase(places[which]);
    ASSERT_FALSE(loaded.empty());
    for (const Case& setup : loaded) {
      EXPECT_TRUE(std::isfinite(setup.law.kn) && setup.law.kn >= 0.0) << k;
      EXPECT_TRUE(std::isfinite(setup.law.mu) && setup.law.mu >= 0.0) << k;
    }
    if (k % 16 != 0) return;  // what is taken says of itself what it is
    const fs::path again = places[which].parent_path() / "again.toml";
    write(again, resolvedFile(loaded));
    EXPECT_EQ(loadCase(again).size(), loaded.size()) << k;
  });
}

/// Accepted disks can be run without further checks.
void expectSound(const Disks& disks, std::uint64_t number) {
  for (std::size_t i = 0; i < disks.size(); ++i) {
    EXPECT_TRUE(std::isfinite(disks.radius[i]) && disks.radius[i] > 0.0) << number;
    EXPECT_TRUE(std::isfinite(disks.mass[i]) && disks.mass[i] > 0.0) << number;
    EXPECT_TRUE(std::isfinite(disks.inertia[i]) && disks.inertia[i] > 0.0) << number;
    EXPECT_TRUE(disks.position[i].allFinite() && disks.velocity[i].allFinite()) << number;
    EXPECT_TRUE(std::isfinite(disks.spin[i])) << number;
  }
}

/// Files of corpus/KIND, by name.
std::vector<fs::path> keptIn(const char* kind) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(CROSSGRAIN_CORPUS) / kind))
    files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

DiskDefaults defaults() {
  return {[](double radius) { return radius * radius; }, 0.5, 1000};
}

/// @param damaged  what is in the file then  @param disksOf  reads it
void readDamaged(const fs::path& file, std::uint64_t usual,
                 const std::function<std::string(test::Draw&)>& damaged,
                 const std::function<Disks()>& disksOf) {
  test::readAll(usual, [&](std::uint64_t k, test::Draw& draw) {
    write(file, damaged(draw));
    expectSound(disksOf(), k);
  });
}

TEST(FuzzedInput, PackingsAreSoundOrRefusedInOneLine) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "packing.h5";
  Packing packing;
  for (int i = 0; i < 5; ++i) {
    packing.disks.radius.push_back(0.1);
    packing.disks.mass.push_back(1.0 + i);
    packing.disks.inertia.push_back(0.005);
    packing.disks.position.emplace_back(0.3 * i, 0.1);
    packing.disks.velocity.emplace_back(0.1, -0.2);
    packing.disks.spin.push_back(2.0);
  }
  packing.hash = "0123456789abcdef";
  writePacking(packing, file);
  const std::string whole = readFile(file).value();
  const std::size_t before = test::mostMemory();
  readDamaged(
      file, 1'000, [&](test::Draw& draw) { return test::damagedBytes(whole, draw); },
      [&] { return readPacking(file, defaults()).disks; });
  // A handle left open would keep its file's content, damaged file by damaged file.
  EXPECT_EQ(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
  EXPECT_LT(test::mostMemory() - before, test::modest);
}

/// Each was accepted, or worse, before it was kept in corpus/.
TEST(FuzzedInput, WhatWasOnceReadWronglyIsRefused) {
  test::Reading reading;
  std::uint64_t number = 0;
  const std::size_t before = test::mostMemory();
  for (const fs::path& kept : keptIn("packings"))
    reading.read(number++, [&] { expectSound(readPacking(kept, defaults()).disks, number); });
  EXPECT_GT(number, 0u);
  EXPECT_EQ(reading.refused, number);
  EXPECT_LT(test::mostMemory() - before, test::modest);
}

TEST(FuzzedInput, StartsAreSoundOrRefusedInOneLine) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "start.csv";
  const std::string whole =
      "# three disks\nx, y, radius, vx, vy, spin, mass, inertia, fixed\n"
      "0.0, 0.0, 0.1, 0.1, 0.0, 2.0, 1.0, 0.005, 0\n\n0.3, 0.0, 0.1, 0, 0, 0, 1e-3, 5e-6, 0\n"
      "0.6, 0.1, 0.15, 0, 0, 0, 1, 0.01, 1\n";
  readDamaged(
      file, 10'000, [&](test::Draw& draw) { return test::damagedText(whole, draw); },
      [&] { return readStart<2>(file, defaults()).disks; });
}

TEST(FuzzedInput, ResultsAreReadOrRefusedInOneLine) {
  const nlohmann::json corpus[] = {toJson(sample::stabilityResults()),
                                   toJson(sample::collideResults()),
                                   toJson(sample::lockstepResults())};
  const auto read = [](const nlohmann::json& document) {
    checkSchema(document, "results.json");
    const std::string kind = document.at("kind");
    if (kind == kindStability)
      toText(toJson(fromJson<StabilityResults>(document)));
    else if (kind == kindCollide)
      toText(toJson(fromJson<CollideResults>(document)));
    else if (kind == kindLockstep)
      toText(toJson(fromJson<LockstepResults>(document)));
  };
  test::readAll(10'000, [&](std::uint64_t k, test::Draw& draw) {
    read(test::damagedJson(corpus[k % std::size(corpus)], draw));
  });
}

}  // namespace
