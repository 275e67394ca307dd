#include <gtest/gtest.h>

#include "tests/files/samples.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;
namespace fs = std::filesystem;

class Formats : public Sampled {
 protected:
  /// Names of each run's files.
  std::vector<std::vector<std::string>> runs(std::string_view format,
                                             const std::vector<std::string>& names) {
    std::vector<fs::path> files;
    for (const std::string& name : names) files.push_back(folder_.path() / name);
    std::vector<std::vector<std::string>> found;
    for (const auto& run : runsOf(format, files)) {
      found.emplace_back();
      for (const fs::path& file : run)
        found.back().push_back(fs::relative(file, folder_.path()).string());
    }
    return found;
  }
  using Runs = std::vector<std::vector<std::string>>;
};

TEST_F(Formats, KnownByTheirBeginning) {
  const auto format = [&](std::string_view content) {
    return formatOf(samples_.write("file", content));
  };
  EXPECT_EQ(format(pairData), "mercurydpm");
  EXPECT_EQ(format(pairFstat), "mercurydpm");
  EXPECT_EQ(format("0 0 0 0 1 1\n"), "mercurydpm");
  EXPECT_EQ(format("ITEM: UNITS\nsi\n"), "lammps");
  EXPECT_EQ(format("#format x_y_z_r\n1 2 3 4\n"), "yade-text");
  EXPECT_EQ(format("# vtk DataFile Version 3.0.\n"), "vtk");
  EXPECT_EQ(format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">"), "vtk");
  EXPECT_EQ(format("# mine\nx,y,radius\n1,2,3\n"), "csv");
  // Names that the case says the meaning of, above rows of numbers.
  EXPECT_EQ(format("a;b;c\n1;2;x\n"), "csv");
  EXPECT_EQ(format("2\nProperties=pos:R:3 Time=1\n1 2 3\n"), "xyz");
  EXPECT_EQ(format("2\nof plain XYZ nobody knows the columns\nAr 1 2 3\n"), std::nullopt);
  EXPECT_EQ(format("a,b,c\n1,x,y\n"), std::nullopt);
  EXPECT_EQ(format("1,2,3\n1,2,3\n"), std::nullopt);
  EXPECT_EQ(format("#t 1\n"), std::nullopt);
  EXPECT_EQ(format("\x89HDF\r\n\x1a\n"), std::nullopt);  // snapshots of ours
  EXPECT_EQ(format("hello, world\n"), std::nullopt);
  EXPECT_EQ(format(""), std::nullopt);
  EXPECT_EQ(formatOf(folder_.path() / "none"), std::nullopt);
  EXPECT_EQ(formatOf(fs::path(CROSSGRAIN_SAMPLES) / "yade-spheres.0.vtu"), "vtk");
}

TEST_F(Formats, Runs_MercuryDpm) {
  for (const char* name : {"run10.data", "run2.data", "n.data.0010", "n.data.0009"})
    samples_.write(name, pairData);
  for (const char* name : {"run10.fstat", "n.fstat.0009"}) samples_.write(name, pairFstat);
  EXPECT_EQ(runs("mercurydpm", {"run10.data", "run10.fstat", "run2.data", "n.data.0010",
                                "n.data.0009", "n.fstat.0009"}),
            (Runs{{"n.data.0009", "n.data.0010", "n.fstat.0009"},
                  {"run2.data"},
                  {"run10.data", "run10.fstat"}}));
}

TEST_F(Formats, Runs_Lammps_TimesOrReplicates) {
  const auto dump = [](int step, const char* what) {
    return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF " + what + "\n0\n";
  };
  for (int step : {5, 10, 100}) {
    samples_.write("a." + std::to_string(step) + ".dump", dump(step, "ATOMS"));
    samples_.write("a." + std::to_string(step) + ".local", dump(step, "ENTRIES"));
  }
  EXPECT_EQ(
      runs("lammps",
           {"a.10.dump", "a.10.local", "a.100.dump", "a.100.local", "a.5.dump", "a.5.local"}),
      (Runs{{"a.5.dump", "a.10.dump", "a.100.dump", "a.5.local", "a.10.local", "a.100.local"}}));
  // Files that all begin at the same step are runs.
  for (const char* name : {"b1.dump", "b2.dump"}) samples_.write(name, dump(0, "ATOMS"));
  for (const char* name : {"b1.local", "b2.local"}) samples_.write(name, dump(0, "ENTRIES"));
  EXPECT_EQ(runs("lammps", {"b1.dump", "b2.dump", "b1.local", "b2.local"}),
            (Runs{{"b1.dump", "b1.local"}, {"b2.dump", "b2.local"}}));
  // Other names: a folder's only run.
  fs::create_directory(folder_.path() / "c");
  samples_.write("c/all.dump", dump(0, "ATOMS"));
  samples_.write("c/forces.dump", dump(0, "ENTRIES"));
  EXPECT_EQ(runs("lammps", {"c/forces.dump", "c/all.dump"}),
            (Runs{{"c/all.dump", "c/forces.dump"}}));
  EXPECT_EQ(crossgrain::test::refusalOf([&] {
              runs("lammps", {"b1.dump", "b2.dump", "a.5.local"});
            }),
            (folder_.path() / "a.5.local").string() +
                ": contacts of which run? the particles' files should have the same name, or a "
                "folder should be of one run");
}

TEST_F(Formats, ContactsAlone_AreRefused) {
  samples_.write("a.local", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\n");
  EXPECT_EQ(crossgrain::test::refusalOf([&] { runs("lammps", {"a.local"}); }),
            (folder_.path() / "a.local").string() +
                ": contacts alone: the file of the particles is missing before it");
}

TEST_F(Formats, BesidesOfMercuryDpm_AreKnownBesideTheirResults) {
  const std::vector<fs::path> all{"out/run.data", "out/run.fstat", "out/run.restart.0003",
                                  "out/run.ene"};
  EXPECT_TRUE(isBesideResults("out/run.ene", all));
  EXPECT_TRUE(isBesideResults("out/run.restart", all));
  EXPECT_TRUE(isBesideResults("out/run.restart.0003", all));
  EXPECT_FALSE(isBesideResults("out/run.data", all));
  EXPECT_FALSE(isBesideResults("out/other.ene", all));
  EXPECT_FALSE(isBesideResults("run.ene", all));
  EXPECT_FALSE(isBesideResults("out/run.txt", all));
  samples_.write("run.ene", "time kinetic\n0 1\n");
  EXPECT_EQ(samples_.refusal("mercurydpm", {"run.ene"}),
            "run.ene:1: should be a .data, which begins with N t xmin …, or an .fstat, with # t 1");
}

TEST_F(Formats, Runs_Vtk) {
  std::vector<std::string> names{"yade-spheres.4.vtu",
                                 "yade-spheres.0.vtu",
                                 "yade-two-intrs.0.vtp",
                                 "yade-two-spheres.0.vtu",
                                 "yade-export-intrs-00000004.vtk",
                                 "yade-export-spheres-00000004.vtk"};
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(fs::path(CROSSGRAIN_SAMPLES) / name);
  const auto found = runsOf("vtk", files);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].front().filename(), "yade-spheres.0.vtu");
  EXPECT_EQ(found[1].size(), 2u);
  EXPECT_EQ(found[2].size(), 2u);
}

TEST_F(Formats, WhatIsNoFile_IsRefused) {
  EXPECT_EQ(samples_.refusal("lammps", {"none.dump"}), "none.dump: no such file");
  EXPECT_EQ(samples_.refusal("lammps", {}), "no files: there is nothing to read");
  EXPECT_EQ(samples_.refusal("lamps", {}),
            "lamps: there is no such format (there are: mercurydpm, lammps, yade-text, vtk, ondem, "
            "csv, xyz)");
  samples_.write("p.csv", "x,y\n1,2\n");
  EXPECT_EQ(
      samples_.refusal("csv", {"p.csv"}, {"x"}),
      "columns: \"x\" should be NAME=MEANING, or NAME=MEANING,MEANING,… of NAME[1], NAME[2], …");
  EXPECT_EQ(samples_.refusal("csv", {"p.csv"}, {"x=y1"}),
            "columns: x=y1: there is no such meaning (did you mean y?)");
}

}  // namespace
