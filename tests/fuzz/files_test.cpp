/// Result files of other programs are read to something sound or refused in one line, whatever was
/// done to them.
#include <gtest/gtest.h>

#include "adapters/files/frame.hpp"
#include "support/files.hpp"
#include "tests/files/samples.hpp"
#include "tests/fuzz/reading.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
using namespace crossgrain::files;
namespace fs = std::filesystem;

template <typename T>
void expectLength(const std::vector<T>& list, std::size_t length, std::uint64_t number) {
  EXPECT_TRUE(list.empty() || list.size() == length) << number;
}

void expectFinite(const std::vector<Vec3>& list, std::uint64_t number) {
  for (const Vec3& one : list) EXPECT_TRUE(one.allFinite()) << number;
}

void expectSound(const FileFrame& frame, std::uint64_t number) {
  const FileParticles& particles = frame.particles;
  EXPECT_EQ(particles.id.size(), particles.size()) << number;
  expectLength(particles.radius, particles.size(), number);
  expectLength(particles.velocity, particles.size(), number);
  expectLength(particles.spin, particles.size(), number);
  expectLength(particles.mass, particles.size(), number);
  expectLength(particles.kind, particles.size(), number);
  expectFinite(particles.position, number);
  expectFinite(particles.velocity, number);
  if (!frame.contacts) return;
  const FileContacts& contacts = *frame.contacts;
  EXPECT_EQ(contacts.second.size(), contacts.size()) << number;
  expectLength(contacts.normal, contacts.size(), number);
  expectLength(contacts.force, contacts.size(), number);
  expectLength(contacts.normalForce, contacts.size(), number);
  expectLength(contacts.tangentialForce, contacts.size(), number);
  expectLength(contacts.point, contacts.size(), number);
  expectLength(contacts.overlap, contacts.size(), number);
  expectLength(contacts.torque, contacts.size(), number);
  for (std::size_t k = 0; k < contacts.normal.size(); ++k)
    EXPECT_NEAR(contacts.normal[k].norm(), 1.0, 1e-12) << number;
  for (const std::int64_t id : contacts.first) EXPECT_GE(id, 0) << number;
}

/// A run of right files, of which one is damaged at a time.
struct Corpus {
  std::string format;
  std::vector<std::pair<std::string, std::string>> files;  ///< names, contents
  FileOptions options;
  bool binary = false;
};

void readDamaged(const std::vector<Corpus>& corpora, std::uint64_t usual) {
  const TemporaryFolder folder;
  const std::size_t before = test::mostMemory();
  test::readAll(usual, [&](std::uint64_t k, test::Draw& draw) {
    const Corpus& corpus = corpora[k % corpora.size()];
    const std::size_t which = k / corpora.size() % corpus.files.size();
    std::vector<fs::path> files;
    for (std::size_t f = 0; f < corpus.files.size(); ++f) {
      const auto& [name, content] = corpus.files[f];
      files.push_back(folder.path() / name);
      // Of text a third is damaged as bytes are, which cuts it, too.
      const bool bytes = corpus.binary || k % 3 == 0;
      test::write(files.back(), f != which ? content
                                : bytes    ? test::damagedBytes(content, draw)
                                           : test::damagedText(content, draw));
    }
    static_cast<void>(formatOf(files[which]));
    for (const auto& run : runsOf(corpus.format, files)) {
      const auto reader = openFrames(corpus.format, run, corpus.options);
      while (const auto frame = reader->next()) expectSound(*frame, k);
    }
  });
  EXPECT_LT(test::mostMemory() - before, test::modest);
}

Corpus samples(std::string format, const std::vector<std::string>& names, FileOptions options = {},
               bool binary = false) {
  Corpus corpus{std::move(format), {}, std::move(options), binary};
  for (const std::string& name : names)
    corpus.files.emplace_back(name, readFile(fs::path(CROSSGRAIN_SAMPLES) / name).value());
  return corpus;
}

TEST(DamagedFiles, MercuryDpm) {
  const std::string later = "1 0.75 0 0 4 4\n1 2 0 0 0.5 0 0 0\n";
  readDamaged(
      {{"mercurydpm",
        {{"a.data", std::string(files::sampled::pairData) + later},
         {"a.fstat", std::string(files::sampled::pairFstat)}},
        {},
        false},
       {"mercurydpm",
        {{"a.data",
          "2 0 0 0 0 4 4 4\n0.1 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n3.12 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n"},
         {"a.fstat",
          "# 0 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n0 1 2 3.61 2 2 0.02 0 20 0 -1 0 0 0 0 0\n"
          "0 0 3 -0.39 2 2 0.02 0 20 0 1 0 0 0 0 0\n0 0 -1 1 2 2 0.02 0 20 3 1 0 0 0 1 0\n"}},
        {},
        false},
       {"mercurydpm",
        {{"a.data",
          "2 0 0 0 0 4 4 4\n0.1 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n3.12 2 2 0 0 0 0.5 0 0 0 0 0 0 0\n"},
         {"a.fstat",
          "# 0 1\n# 0 0 0 4 4 4\n# 0.5 0.5 0 0 0 0\n0 0 3 -0.39 2 2 0.02 0 20 0 1 0 0 0 0 0\n"}},
        {"", FileBox{{0, 0, 0}, {4, 4, 4}, {true, true, false}}},
        false}},
      10'000);
}

TEST(DamagedFiles, Lammps) {
  readDamaged(
      {samples("lammps", {"lammps.2.dump", "lammps.2.local", "lammps.4.dump", "lammps.4.local"}),
       samples(
           "lammps", {"liggghts.2.dump", "liggghts.2.local"},
           {"c_c=pair/gran/"
            "local,pos,id,force,force_normal,force_tangential,torque,history,delta,contactPoint"})},
      10'000);
}

TEST(DamagedFiles, YadeText) {
  readDamaged({samples("yade-text", {"yade.4.txt"}), samples("yade-text", {"yade-attrs.4.txt"})},
              10'000);
}

/// Two spheres whose numbers are binary, the highest byte first: radii of 0.5, 1 m apart.
std::string binarySpheres() {
  using namespace std::string_literals;
  return "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\nPOINTS 2 float\n"s +
         "\0\0\0\0\0\0\0\0\0\0\0\0\x3f\x80\0\0\0\0\0\0\0\0\0\0\nVERTICES 2 4\n"s +
         "\0\0\0\1\0\0\0\0\0\0\0\1\0\0\0\1\nPOINT_DATA 2\nSCALARS radius float 1\n"s +
         "LOOKUP_TABLE default\n\x3f\0\0\0\x3f\0\0\0\n"s;
}

TEST(DamagedFiles, Vtk) {
  readDamaged(
      {samples("vtk", {"yade-export-spheres-00000004.vtk", "yade-export-intrs-00000004.vtk"}),
       samples("vtk", {"yade-two-spheres.0.vtu", "yade-two-intrs.0.vtp"}),
       samples("vtk", {"yade-spheres.0.vtu"}, {}, true),
       {"vtk", {{"spheres.1.vtk", binarySpheres()}}, {}, true}},
      10'000);
}

TEST(DamagedFiles, Csv) {
  readDamaged({{"csv",
                {{"particles.csv",
                  "t,id,x,y,radius,spin\n0,5,1,2,0.5,0\n0,6,1.98,2,0.5,0\n1,5,1,2,0.5,3\n1,6,1.98,"
                  "2,0.5,0\n"},
                 {"contacts.csv",
                  "t,first,second,nx,ny,normal_force,tx,ty\n0,5,6,-1,0,20,0,-3\n0,-1,5,0,-1,4,1,"
                  "0\n1,5,6,-1,0,7,0,0\n"}},
                {},
                false}},
              10'000);
}

/// Each is a process: fewer.
TEST(DamagedFiles, OnDem) {
  const TemporaryFolder folder;
  files::sampled::writeOnDem(folder.path() / "a.vtkhdf");
  readDamaged({{"ondem", {{"a.vtkhdf", readFile(folder.path() / "a.vtkhdf").value()}}, {}, true}},
              500);
}

}  // namespace
