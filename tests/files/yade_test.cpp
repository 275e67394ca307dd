/// Files of YADE's exporters: samples/yade_export.py and yade_recorder.py are the scripts, which
/// print YADE's own contacts.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "tests/files/samples.hpp"

namespace {

using namespace crossgrain::files;
using namespace crossgrain::files::sampled;

TEST(Yade, TextExt_IdsOfItsOwn) {
  const FileFrame frame = programs().read("yade-text", {"yade.4.txt"}).front();
  EXPECT_EQ(frame.step, 4);  // of its name
  EXPECT_FALSE(frame.time);
  EXPECT_EQ(frame.particles.id, (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(frame.particles.position[1], Vec3(3.40993, 2, 2));
  EXPECT_EQ(frame.particles.radius[3], 0.5);
  EXPECT_FALSE(frame.contacts);
}

TEST(Yade, TextExt_AttributesThatTheCommentNames) {
  const FileFrame frame = programs().read("yade-text", {"yade-attrs.4.txt"}).front();
  EXPECT_EQ(frame.particles.id[3], 3);
  EXPECT_EQ(frame.particles.velocity[2], Vec3(0, -0.0956752, -0.196134));
  EXPECT_EQ(frame.particles.spin[0], Vec3(0, 0, 0.00112227));
}

/// Printed: 2 and 3, n (0, .438424, .898768), F (0, 19.02, 38.991) on 3, overlap .0867653; 0 and 1
/// over the edge, n (−1, −.0004, 0), F = (−4.95003, −.001997, 0) + (0, .0754350, 0) on 1.
TEST(Yade, VtkExporter_NormalAndForceAreTurnedToTheFirst) {
  const FileFrame frame =
      programs()
          .read("vtk", {"yade-export-spheres-00000004.vtk", "yade-export-intrs-00000004.vtk"})
          .front();
  EXPECT_EQ(frame.step, 4);
  EXPECT_EQ(frame.particles.mass[0], 1.0);
  const FileContacts& contacts = *frame.contacts;
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts.first, (std::vector<std::int64_t>{2, 0}));
  EXPECT_EQ(contacts.second, (std::vector<std::int64_t>{3, 1}));
  expectNear(contacts.normal[0], Vec3(0, -0.438424, -0.898768), 1e-6);
  expectNear(contacts.force[0], Vec3(0, -19.02, -38.991), 1e-4);
  expectNear(contacts.force[1], Vec3(4.95006, -0.0734381, 0), 1e-4);
  EXPECT_EQ(contacts.overlap[0], 0.0867653);
  EXPECT_EQ(contacts.point[0], Vec3(2, 2.2, 0.89));
}

/// Packed by zlib, in base64: bits are YADE's own but for places, which are floats.
TEST(Yade, VtkRecorder_Spheres) {
  const auto frames = programs().read("vtk", {"yade-spheres.0.vtu", "yade-spheres.4.vtu"});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].step, 4);
  EXPECT_EQ(frames[0].particles.velocity[2], Vec3(0, -0.019211816010707206, -0.03938422282194979));
  EXPECT_EQ(frames[0].particles.position[1].x(), double(3.4099950790405273f));
  EXPECT_EQ(frames[0].particles.mass[3], 0.9999999999999998 + 2e-16);
}

/// 500 N/m · 0.02 m; the ends of the line are the spheres' centres, in floats too.
TEST(Yade, VtkRecorder_ContactsByTheirEnds) {
  const FileFrame frame =
      programs().read("vtk", {"yade-two-spheres.0.vtu", "yade-two-intrs.0.vtp"}).front();
  const FileContacts& contacts = *frame.contacts;
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts.first[0], 0);
  EXPECT_EQ(contacts.second[0], 1);
  EXPECT_EQ(contacts.normal[0], Vec3(-1, 0, 0));
  EXPECT_NEAR(contacts.normalForce[0], 10.0, 1e-12);
  EXPECT_GT(contacts.tangentialForce[0], 0.0);
  EXPECT_TRUE(contacts.force.empty());  // its direction is not there
}

class VtkText : public Sampled {
 protected:
  void writeXml(const std::string& name, const std::string& attributes, const std::string& radii,
                const std::string& rest = "") {
    samples_.write(
        name,
        "<VTKFile type=\"UnstructuredGrid\" " + attributes +
            "><UnstructuredGrid><Piece NumberOfPoints=\"2\"><PointData><DataArray "
            "Name=\"radii\" type=\"Float64\" " +
            radii +
            "</DataArray></PointData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
            "format=\"ascii\">1 2 3 4 5 6</DataArray></Points></Piece></UnstructuredGrid>" +
            rest + "</VTKFile>\n");
  }
  std::vector<double> radii(const std::string& name) {
    return samples_.read("vtk", {name}).front().particles.radius;
  }
  const std::vector<double> expected_{0.5, 0.25};
};

/// 16 bytes of 0.5 and 0.25, in each way that VTK writes them.
TEST_F(VtkText, Xml_EachEncoding) {
  writeXml("a.1.vtu", "", "format=\"ascii\"> 0.5\n 0.25 ");
  EXPECT_EQ(radii("a.1.vtu"), expected_);
  // The number of bytes by itself, or with what follows.
  writeXml("a.2.vtu", "", "format=\"binary\">EAAAAA==AAAAAAAA4D8AAAAAAADQPw==");
  EXPECT_EQ(radii("a.2.vtu"), expected_);
  writeXml("a.3.vtu", "", "format=\"binary\">EAAAAAAAAAAAAOA/AAAAAAAA0D8=");
  EXPECT_EQ(radii("a.3.vtu"), expected_);
  writeXml("a.4.vtu", "byte_order=\"BigEndian\" header_type=\"UInt64\"",
           "format=\"binary\">AAAAAAAAABA=P+AAAAAAAAA/0AAAAAAAAA==");
  EXPECT_EQ(radii("a.4.vtu"), expected_);
  using namespace std::string_literals;
  const std::string raw = "\x10\0\0\0\0\0\0\0\0\0\xe0\x3f\0\0\0\0\0\0\xd0\x3f"s;
  writeXml("a.5.vtu", "", "format=\"appended\" offset=\"0\">",
           "<AppendedData encoding=\"raw\">\n_" + raw + "\n</AppendedData>");
  EXPECT_EQ(radii("a.5.vtu"), expected_);
}

TEST_F(VtkText, WhatCannotBe_IsRefused) {
  writeXml("a.1.vtu", "", "format=\"binary\">EAAAAA==AAAAAAAA4D8AAAAA");
  EXPECT_EQ(
      samples_.refusal("vtk", {"a.1.vtu"}),
      "a.1.vtu: radii: its data end too early: the file was cut off, or the size in it is wrong");
  writeXml("a.1.vtu", "", "format=\"ascii\">0.5 0.25 3");
  EXPECT_EQ(samples_.refusal("vtk", {"a.1.vtu"}), "a.1.vtu: radii has 3 rows, there should be 2");
  writeXml("a.1.vtu", "compressor=\"vtkLZ4DataCompressor\"", "format=\"ascii\">0.5 0.25");
  EXPECT_EQ(samples_.refusal("vtk", {"a.1.vtu"}),
            "a.1.vtu: it is packed by vtkLZ4DataCompressor: vtkZLibDataCompressor is read");
  samples_.write("b.vtk", "# vtk DataFile Version 5.1\nx\nBINARY\n");
  EXPECT_EQ(samples_.refusal("vtk", {"b.vtk"}),
            "b.vtk:3: binary files are read of versions before 5: write version 4.2, or .vtp");
  samples_.write("b.vtk",
                 "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\nPOINTS 1 "
                 "double\n1234567");
  EXPECT_EQ(samples_.refusal("vtk", {"b.vtk"}),
            "b.vtk:5: 24 bytes should follow, the file has 7: it was cut off");
  samples_.write(
      "b.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 1 double\n1 2 x\n");
  EXPECT_EQ(samples_.refusal("vtk", {"b.vtk"}), "b.vtk:6: POINTS: \"x\" should be a finite number");
  samples_.write("b.txt", "#format x_y_z_r_attrs\n1 2 3 4 5\n");
  EXPECT_EQ(samples_.refusal("yade-text", {"b.txt"}),
            "b.txt:2: 5 columns, which the comment line before them should name: # x y z r id vx "
            "vy vz …");
}

/// Numbers as VTK writes them in binary, the highest byte first.
template <typename T>
std::string bigEndian(std::initializer_list<T> numbers) {
  std::string bytes;
  for (const T number : numbers) {
    std::array<char, sizeof(T)> one;
    std::memcpy(one.data(), &number, sizeof(T));
    std::ranges::reverse(one);
    bytes.append(one.data(), one.size());
  }
  return bytes + "\n";
}

/// The same two spheres in contact as text would have them, with a line end among the numbers:
/// 0x0A0A0A0A is 168430090.
TEST_F(VtkText, Legacy_Binary) {
  const std::string head = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\n";
  samples_.write("e-spheres-1.vtk",
                 head + "POINTS 2 float\n" + bigEndian<float>({0, 0, 0, 1, 0, 0}) +
                     "VERTICES 2 4\n" + bigEndian<std::int32_t>({1, 0, 1, 1}) +
                     "POINT_DATA 2\nSCALARS radius double 1\nLOOKUP_TABLE default\n" +
                     bigEndian<double>({0.5, 0.625}) + "SCALARS id int 1\nLOOKUP_TABLE default\n" +
                     bigEndian<std::int32_t>({168430090, 7}) +
                     "FIELD FieldData 1\nvelocity 3 2 "
                     "float\n" +
                     bigEndian<float>({1, 2, 3, 4, 5, 6}));
  samples_.write("e-intrs-1.vtk", head + "POINTS 2 float\n" + bigEndian<float>({0, 0, 0, 1, 0, 0}) +
                                      "LINES 1 3\n" + bigEndian<std::int32_t>({2, 0, 1}) +
                                      "CELL_DATA 1\nSCALARS id1 int 1\nLOOKUP_TABLE default\n" +
                                      bigEndian<std::int32_t>({168430090}) +
                                      "SCALARS id2 int 1\nLOOKUP_TABLE default\n" +
                                      bigEndian<std::int32_t>({7}) + "VECTORS n double\n" +
                                      bigEndian<double>({1, 0, 0}) + "VECTORS F double\n" +
                                      bigEndian<double>({20, 3, 0}));
  const FileFrame frame = samples_.read("vtk", {"e-spheres-1.vtk", "e-intrs-1.vtk"}).front();
  EXPECT_EQ(frame.particles.id, (std::vector<std::int64_t>{168430090, 7}));
  EXPECT_EQ(frame.particles.radius, (std::vector{0.5, 0.625}));
  EXPECT_EQ(frame.particles.velocity[1], Vec3(4, 5, 6));
  EXPECT_EQ(frame.contacts->first, (std::vector<std::int64_t>{168430090}));
  EXPECT_EQ(frame.contacts->second, (std::vector<std::int64_t>{7}));
  EXPECT_EQ(frame.contacts->normal[0], Vec3(-1, 0, 0));
  EXPECT_EQ(frame.contacts->force[0], Vec3(-20, -3, 0));
}

/// As each process of a parallel run writes one: a contact of each, its ends counted in its piece.
TEST_F(VtkText, Xml_SeveralPieces) {
  const auto piece = [](const char* x, const char* radius, const char* line, const char* force) {
    return "<Piece NumberOfPoints=\"2\" NumberOfLines=\"1\"><PointData><DataArray Name=\"radii\" "
           "type=\"Float64\" format=\"ascii\">" +
           std::string(radius) +
           "</DataArray></PointData><CellData><DataArray Name=\"normal_force\" type=\"Float64\" "
           "format=\"ascii\">" +
           force +
           "</DataArray></CellData><Points><DataArray "
           "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
           x +
           "</DataArray></Points><Lines><DataArray Name=\"connectivity\" type=\"Int32\" "
           "format=\"ascii\">" +
           line + "</DataArray></Lines></Piece>";
  };
  const auto file = [&](const char* first, const char* second) {
    return "<VTKFile type=\"PolyData\"><PolyData>" + piece("0 0 0 1 0 0", first, "0 1", "20") +
           piece("9 0 0 8 0 0", second, "1 0", "30") + "</PolyData></VTKFile>";
  };
  samples_.write(
      "p-spheres.1.vtp",
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
      "<Piece NumberOfPoints=\"4\"><PointData><DataArray Name=\"radii\" "
      "type=\"Float64\" format=\"ascii\">1 2 3 4</DataArray></PointData><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 "
      "9 0 0 8 0 0</DataArray></Points></Piece></UnstructuredGrid></VTKFile>");
  samples_.write("p-intrs.1.vtp", file("1 2", "3 4"));
  const FileContacts contacts =
      *samples_.read("vtk", {"p-spheres.1.vtp", "p-intrs.1.vtp"}).front().contacts;
  EXPECT_EQ(contacts.first, (std::vector<std::int64_t>{0, 3}));
  EXPECT_EQ(contacts.second, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(contacts.normalForce, (std::vector{20.0, 30.0}));
}

/// The index of a parallel run: its pieces are one time, their ghosts are other pieces' particles.
TEST_F(VtkText, Index_HasItsPiecesWithoutGhosts) {
  const auto piece = [](const char* points, const char* radii, const char* ids,
                        const char* ghosts) {
    const auto array = [](const char* name, const char* type, const char* values) {
      return fmt::format("<DataArray Name=\"{}\" type=\"{}\" format=\"ascii\">{}</DataArray>", name,
                         type, values);
    };
    return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\"><PointData>" +
           array("radius", "Float64", radii) + array("id", "Int64", ids) +
           array("vtkGhostType", "UInt8", ghosts) +
           "</PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
           "format=\"ascii\">" +
           points + "</DataArray></Points></Piece></PolyData></VTKFile>";
  };
  const std::string index =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\"><PPolyData "
      "GhostLevel=\"0\"><PPoints/><Piece Source=\"run_3_0.vtp\"/><Piece "
      "Source=\"run_3_1.vtp\"/></PPolyData></VTKFile>";
  const auto first = samples_.write("run_3_0.vtp", piece("0 0 0 1 0 0", "1 2", "4 5", "0 1"));
  const auto second = samples_.write("run_3_1.vtp", piece("1 0 0 9 0 0", "2 3", "5 6", "0 0"));
  const auto whole = samples_.write("run_3.pvtp", index);
  const auto frames = samples_.read("vtk", {"run_3.pvtp"});
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].step, 3);
  EXPECT_EQ(frames[0].particles.id, (std::vector<std::int64_t>{4, 5, 6}));
  EXPECT_EQ(frames[0].particles.radius, (std::vector{1.0, 2.0, 3.0}));
  EXPECT_TRUE(isBesideResults(first, {first, second, whole}));
  EXPECT_FALSE(isBesideResults(whole, {first, second, whole}));
  EXPECT_FALSE(isBesideResults(first, {first, second}));
  samples_.write("run_4.pvtp", index.substr(0, index.find("<Piece")) + "</PPolyData></VTKFile>");
  EXPECT_EQ(samples_.refusal("vtk", {"run_4.pvtp"}),
            "run_4.pvtp: it is an index without a <Piece>");
  std::filesystem::copy_file(whole, first, std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(samples_.refusal("vtk", {"run_3.pvtp"}),
            "run_3_0.vtp: is an index that another one names");
}

/// Bodies that are no spheres: a wall 5 below sphere 0, named as the first.
TEST_F(VtkText, Exporter_WallBecomesTheSecond) {
  const std::string head = "# vtk DataFile Version 3.0.\ncomment\nASCII\n\nDATASET POLYDATA\n";
  samples_.write("e-spheres-1.vtk", head +
                                        "POINTS 1 double\n0 0 0.48\n\nPOINT_DATA 1\nSCALARS radius "
                                        "double 1\nLOOKUP_TABLE default\n0.5\n");
  samples_.write("e-intrs-1.vtk", head +
                                      "POINTS 2 double\n0 0 0\n0 0 0.48\nLINES 1 2\n2 0 "
                                      "1\n\nCELL_DATA 1\n\nSCALARS id1 double 1\n"
                                      "LOOKUP_TABLE default\n5\n\nSCALARS id2 double "
                                      "1\nLOOKUP_TABLE default\n0\n\nVECTORS n double\n0 0 1\n\n"
                                      "VECTORS F double\n3 0 20\n");
  const FileContacts contacts =
      *samples_.read("vtk", {"e-spheres-1.vtk", "e-intrs-1.vtk"}).front().contacts;
  EXPECT_EQ(contacts.first[0], 0);
  EXPECT_EQ(contacts.second[0], -6);
  EXPECT_EQ(contacts.normal[0], Vec3(0, 0, 1));
  EXPECT_EQ(contacts.force[0], Vec3(3, 0, 20));
}

/// A .vtu as MercuryDPM's SphericalParticleVtkWriter writes it, and the points of contacts of its
/// InteractionVTKWriter, which name no particles.
TEST_F(VtkText, MercuryDpm_HasRadiusWithACapital) {
  const auto write = [&](const char* name, const std::string& arrays) {
    samples_.write(name,
                   "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                   "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"2\" "
                   "NumberOfCells=\"0\">\n<Points>\n<DataArray type=\"Float32\" Name=\"Position\" "
                   "NumberOfComponents=\"3\" format=\"ascii\">\n1 2 2\n1.98 2 2\n</DataArray>\n"
                   "</Points>\n<PointData Vectors=\"vector\">\n" +
                       arrays + "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  };
  const auto array = [](const std::string& name, int components, const std::string& values) {
    return "<DataArray type=\"Float32\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(components) + "\" format=\"ascii\">\n" + values + "\n</DataArray>\n";
  };
  write("runParticle_3.vtu", array("Velocity", 3, "1 2 3\n0 0 0") + array("Radius", 1, "0.5\n0.5") +
                                 array("speciesType", 1, "0\n1"));
  const FileFrame frame = samples_.read("vtk", {"runParticle_3.vtu"}).front();
  EXPECT_EQ(frame.particles.radius, (std::vector{0.5, 0.5}));
  EXPECT_EQ(frame.particles.velocity.at(0), Vec3(1, 2, 3));
  EXPECT_EQ(frame.particles.kind, (std::vector<std::int64_t>{0, 1}));
  write("runInteraction_3.vtu",
        array("Normal", 3, "1 0 0\n0 0 1") + array("ContactRadius", 1, "1\n1"));
  EXPECT_NE(samples_.refusal("vtk", {"runInteraction_3.vtu"}).find("contacts that do not name"),
            std::string::npos);
}

/// Zeros packed into a thousandth: what is more than the rows is no reason to take room for it.
TEST_F(VtkText, PackedNumbers_BeyondTheirRowsAreRefusedBeforeTheyAreUnpacked) {
  std::vector<unsigned char> zeros(std::size_t{1} << 23), packed(zeros.size() / 100);
  uLongf length = static_cast<uLongf>(packed.size());
  ASSERT_EQ(compress(packed.data(), &length, zeros.data(), static_cast<uLong>(zeros.size())), Z_OK);
  std::string raw;
  const auto add = [&](std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) raw += static_cast<char>(value >> shift & 255u);
  };
  for (const std::uint32_t value : {1u, 1u << 23, 0u, static_cast<std::uint32_t>(length)})
    add(value);
  raw.append(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(length));
  samples_.write(
      "a.vtu",
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" "
      "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"2\" "
      "NumberOfCells=\"0\"><Points><DataArray type=\"Float64\" Name=\"Points\" "
      "NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points></Piece>"
      "</UnstructuredGrid><AppendedData encoding=\"raw\">_" +
          raw + "</AppendedData></VTKFile>");
  EXPECT_EQ(
      samples_.refusal("vtk", {"a.vtu"}),
      "a.vtu: Points: 1 packed blocks of 8388608 bytes are more than the 48 bytes of its rows");
  samples_.write("a.vtu",
                 "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece "
                 "NumberOfPoints=\"5000000\" NumberOfCells=\"0\"><Points><DataArray "
                 "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\"></DataArray></Points>"
                 "</Piece></UnstructuredGrid></VTKFile>");
  EXPECT_EQ(samples_.refusal("vtk", {"a.vtu"}),
            "a.vtu: 5000000 points: there should be 4000000 at most");
}

}  // namespace
