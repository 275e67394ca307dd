#include "cases/packing.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <new>
#include <random>

#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"
#include "support/random.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;

fs::path file(const char* name) {
  return fs::path(testing::TempDir()) / name;
}

Case kinds() {
  Case setup;
  couetteIn(setup).particles.smallRadius = 1.0;
  couetteIn(setup).particles.largeRadius = 2.0;
  couetteIn(setup).particles.smallMass = 3.0;
  couetteIn(setup).particles.largeMass = 7.0;
  return setup;
}

Packing packedDisks() {
  Packing packing;
  packing.disks.radius = {1.0, 2.0};
  packing.disks.mass = {3.0, 1.0 / 3.0};
  packing.disks.inertia = {0.1, 0.2};
  packing.disks.position = {Vec2(0.1, 0.2), Vec2(-5.0, 1e-17)};
  packing.disks.velocity = {Vec2(1.0, 0.0), Vec2(0.0, -1.0)};
  packing.disks.spin = {4.0, -0.0};
  packing.wheelAngle = 0.7;
  packing.hash = "abc";
  return packing;
}

TEST(Packing, File_KeepsEveryBit) {
  const Packing packing = packedDisks();
  writePacking(packing, file("packing.h5"));
  const Packing back = readPacking(file("packing.h5"), kinds());
  EXPECT_EQ(contentHash(back), contentHash(packing));  // of the bytes of all arrays and the angle
  EXPECT_TRUE(std::signbit(back.disks.spin[1]));
  EXPECT_EQ(back.hash, "abc");
}

/// Changes one value of an array of a file that is there.
void alter(const fs::path& path, const char* name, double factor) {
  const hid_t whole = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t set = H5Dopen2(whole, name, H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values.front() *= factor;
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  for (const hid_t id : {space, set, whole}) H5Idec_ref(id);
}

/// A packing in the cache is the one that was kept, for what it was kept, or it is not used.
TEST(Packing, Cached_AlteredOrAnother_IsNotUsed) {
  const Packing packing = packedDisks();
  const fs::path kept = file("kept.h5");
  std::string why;
  EXPECT_FALSE(keptPacking(file("no-such.h5"), "abc", kinds(), why));
  EXPECT_EQ(why, "");
  writePacking(packing, kept);
  const auto found = keptPacking(kept, "abc", kinds(), why);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->fromCache);
  EXPECT_FALSE(keptPacking(kept, "abd", kinds(), why));
  EXPECT_NE(why.find("another packing"), std::string::npos) << why;
  for (const char* name : {"radius", "mass", "inertia", "position", "velocity", "spin"}) {
    writePacking(packing, kept);
    alter(kept, name, 3.0);
    EXPECT_FALSE(keptPacking(kept, "abc", kinds(), why)) << name;
    EXPECT_NE(why.find("is not what was kept"), std::string::npos) << why;
    // The user's own file is the user's to change.
    EXPECT_NO_THROW(readPacking(kept, kinds())) << name;
  }
}

/// A link out of the file may lead to a pipe, which never ends, or to private data.
TEST(Packing, Links_IntoOtherFiles_AreNotFollowed) {
  ::unlink(file("pipe").c_str());
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  {
    Hdf5File out = Hdf5File::create(file("links.h5"));
    out.write("position", std::vector<double>{0.0, 0.0});
    out.save();
    const hid_t whole = H5Fopen(file("links.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    hid_t link = H5P_LINK_CREATE;
    link = H5Pcreate(link);
    // The library's own class of such links is gone, so that it is put there as its bytes.
    const std::string value =
        std::string(1, '\0') + file("pipe").string() + '\0' + "/radius" + '\0';
    H5L_class_t external{};
    external.version = H5L_LINK_CLASS_T_VERS;
    external.id = H5L_TYPE_EXTERNAL;
    external.trav_func = [](const char*, hid_t, const void*, std::size_t, hid_t, hid_t) -> hid_t {
      return -1;
    };
    H5Lregister(&external);
    H5Lcreate_ud(whole, "radius", H5L_TYPE_EXTERNAL, value.data(), value.size(), link, H5P_DEFAULT);
    H5Lunregister(H5L_TYPE_EXTERNAL);
    for (const hid_t id : {link, whole}) H5Idec_ref(id);
  }
  EXPECT_THROW(readPacking(file("links.h5"), kinds()), BadInput);
}

std::vector<double> drawn(std::uint64_t seed, std::uint64_t index) {
  const Random random = randomStream(seed, index);
  std::vector<double> numbers;
  for (int k = 0; k < 1000; ++k) numbers.push_back(gsl_rng_uniform(random.get()));
  return numbers;
}

/// Seed + index would give (1, 1) and (2, 0) the same packing.
TEST(RandomStreams, SeedsAndIndices_AreIndependent) {
  std::vector<std::vector<double>> streams;
  for (const std::uint64_t seed : {0u, 1u, 2u, 3u})
    for (const std::uint64_t index : {0u, 1u, 2u, 3u}) streams.push_back(drawn(seed, index));
  for (std::size_t a = 0; a < streams.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double correlation = 0.0;  // of 1000 pairs: 0 ± 1/√1000
      for (std::size_t k = 0; k < streams[a].size(); ++k)
        correlation += 12.0 * (streams[a][k] - 0.5) * (streams[b][k] - 0.5) / 1000.0;
      EXPECT_LT(std::abs(correlation), 5.0 / std::sqrt(1000.0)) << a << ' ' << b;
    }
}

TEST(RandomStreams, SameOnEveryMachine) {
  EXPECT_EQ(drawn(1, 1), drawn(1, 1));
  // The standard's own twister, seeded by its own seed_seq.
  std::seed_seq words{7u, 0u, 3u, 0u};
  std::mt19937_64 twister(words);
  EXPECT_EQ(drawn(7, 3).front(), static_cast<double>(twister() >> 11) / 0x1p53);
  const Random plain = seededRandom(7);  // stream 0: packings kept from before stay what they are
  EXPECT_EQ(drawn(7, 0).front(), gsl_rng_uniform(plain.get()));
}

TEST(Packing, UserFile_NeedsRadiiAndPositionsOnly) {
  {
    Hdf5File out = Hdf5File::create(file("user.h5"));
    const std::vector<double> position = {0.0, 0.0, 5.0, 0.0};
    out.write("radius", std::vector<double>{1.0, 2.0});
    out.write("position", position.data(), 2, 2);
    out.save();
  }
  const Packing packing = readPacking(file("user.h5"), kinds());
  EXPECT_EQ(packing.disks.mass, (std::vector<double>{3.0, 7.0}));  // by kind, from the case
  EXPECT_EQ(packing.disks.inertia, (std::vector<double>{0.5 * 3.0 * 1.0, 0.5 * 7.0 * 4.0}));
  EXPECT_EQ(packing.disks.velocity[1], Vec2::Zero());
}

TEST(Packing, BadFiles_AreBadInput) {
  EXPECT_THROW(readPacking(file("none.h5"), kinds()), BadInput);
  {
    Hdf5File out = Hdf5File::create(file("short.h5"));
    out.write("radius", std::vector<double>{1.0, 2.0});
    out.write("position", std::vector<double>{0.0, 0.0});
    out.save();
  }
  test::expectSays(test::refusalOf([&] { readPacking(file("short.h5"), kinds()); }),
                   {"position has 2 values for 2 disks; 4 are needed"});
  std::ofstream(file("text.h5")) << "not HDF5";
  EXPECT_THROW(readPacking(file("text.h5"), kinds()), BadInput);
}

/// A file of one disk with an attribute of that type and number of values.
void writeWithAttribute(const fs::path& path, const char* name, hid_t type, hsize_t count,
                        const void* values) {
  Hdf5File out = Hdf5File::create(path);
  out.write("radius", std::vector<double>{1.0});
  out.write("position", std::vector<double>{0.0, 0.0});
  out.save();
  const hid_t whole = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t attribute = H5Acreate2(whole, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, values);
  for (const hid_t id : {attribute, space, whole}) H5Idec_ref(id);
}

/// Writes a file with a dataset of that type and size, without data.
void writeClaim(const fs::path& path, const char* name, hid_t type, hsize_t count) {
  Hdf5File::create(path).save();
  const hid_t whole = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t set = H5Dcreate2(whole, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  for (const hid_t id : {set, space, whole}) H5Idec_ref(id);
}

/// HDF5 would take room for all of it first.
TEST(Packing, ClaimBeyondTheFile_IsDamage) {
  writeClaim(file("claims.h5"), "radius", H5T_NATIVE_DOUBLE, 50'000'000);
  const Hdf5File claims = Hdf5File::open(file("claims.h5"));
  EXPECT_THROW(claims.length("radius"), std::runtime_error);
}

TEST(Packing, Numbers_OfTheSizeOfNumbers) {
  const hid_t longText = H5Tcopy(H5T_C_S1), opaque = H5Tcreate(H5T_OPAQUE, 1'000'000'000);
  H5Tset_size(longText, 1'000'000'000);
  for (const hid_t type : {longText, opaque}) {
    writeClaim(file("long.h5"), "radius", type, 1);
    const Hdf5File claims = Hdf5File::open(file("long.h5"));
    EXPECT_EQ(claims.length("radius"), 1u);
    EXPECT_THROW(claims.read("radius"), std::runtime_error);
  }
  writeClaim(file("integers.h5"), "radius", H5T_NATIVE_INT8, 2);
  EXPECT_EQ(Hdf5File::open(file("integers.h5")).read("radius"), (std::vector<double>{0.0, 0.0}));
  for (const hid_t type : {longText, opaque}) H5Idec_ref(type);
}

/// As HDF5 does with some damaged files (tests/fuzz/corpus/packings).
TEST(Trial, CrashOrAllMemory_IsOneLine) {
  const auto said = [](const std::function<void()>& read) {
    return test::refusalOf<std::exception>([&] { tryReading("file.h5", read); });
  };
  const char* lost = "file.h5: is damaged: HDF5 does not get to the end of it";
  EXPECT_EQ(said([] { std::abort(); }), lost);
  EXPECT_EQ(said([] { throw std::bad_alloc(); }), lost);
  EXPECT_EQ(said([] { throw std::runtime_error("file.h5: too short"); }), "file.h5: too short");
  int changed = 0;
  EXPECT_EQ(said([&] { changed = 1; }), "");
  EXPECT_EQ(changed, 0);  // it was another process
}

TEST(Packing, Attributes_OneNumberAndOneText) {
  const double angles[] = {0.5, 1.0, 2.0, 3.0};
  writeWithAttribute(file("one.h5"), "wheel_angle", H5T_NATIVE_DOUBLE, 1, angles);
  EXPECT_EQ(readPacking(file("one.h5"), kinds()).wheelAngle, 0.5);
  // Room is for one.
  writeWithAttribute(file("four.h5"), "wheel_angle", H5T_NATIVE_DOUBLE, 4, angles);
  EXPECT_THROW(readPacking(file("four.h5"), kinds()), BadInput);
  writeWithAttribute(file("number.h5"), "hash", H5T_NATIVE_DOUBLE, 1, angles);
  EXPECT_THROW(readPacking(file("number.h5"), kinds()), BadInput);

  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, H5T_VARIABLE);
  const char* const hash = "as Python writes it";
  writeWithAttribute(file("text.h5"), "hash", text, 1, &hash);
  H5Tclose(text);
  EXPECT_EQ(readPacking(file("text.h5"), kinds()).hash, hash);
}

}  // namespace
