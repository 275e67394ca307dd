#include "tests/files/samples.hpp"

#include <hdf5.h>

#include <algorithm>
#include <fstream>

#include "support/hdf5_file.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::files::sampled {
namespace fs = std::filesystem;

fs::path Samples::write(const std::string& name, std::string_view content) const {
  std::ofstream(folder_ / name, std::ios::binary) << content;
  return folder_ / name;
}

std::vector<FileFrame> Samples::read(std::string_view format, const std::vector<std::string>& names,
                                     const FileOptions& options) const {
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(folder_ / name);
  std::vector<FileFrame> frames;
  const auto reader = openFrames(format, files, options);
  while (auto frame = reader->next()) frames.push_back(std::move(*frame));
  return frames;
}

std::string Samples::refusal(std::string_view format, const std::vector<std::string>& names,
                             const FileOptions& options) const {
  std::string line = crossgrain::test::refusalOf([&] { read(format, names, options); });
  const std::string folder = folder_.string() + "/";
  for (std::size_t at; (at = line.find(folder)) != std::string::npos;)
    line.erase(at, folder.size());
  return line;
}

Samples programs() {
  return Samples(CROSSGRAIN_SAMPLES);
}

void writeOnDem(const fs::path& file, const OnDemSample& sample) {
  {
    Hdf5File out = Hdf5File::create(file);
    const auto put = [&](const std::string& path, std::vector<double> values,
                         std::size_t columns = 1) {
      if (std::ranges::find(sample.without, path) == sample.without.end())
        out.write(path, values.data(), values.size() / columns, columns);
    };
    const std::string points = "/VTKHDF/PointData/", contacts = "/ONDEM/Interactions/";
    put("/VTKHDF/Points", {1, 2, 2, 1.98, 2, 2}, 3);
    put(points + "body_id", {7, 9});
    put(points + "radius", {0.5, 0.5});
    put(points + "mass", {1, 1});
    put(points + "velocity", {0.1, 0, 0, 0, 0, 0}, 3);
    put(points + "angular_velocity", {0, 0, 1, 0, 0, 0}, 3);
    put("/ONDEM/Bodies/Walls/body_id", {0});
    put("/ONDEM/Scene/gravity", {0, 0, -9.81});
    put(contacts + "id1", {7, 0, 9});
    put(contacts + "id2", {9, 7, 7});
    put(contacts + "normal", {1, 0, 0, 0, 0, 1, -1, 0, 0}, 3);
    put(contacts + "normal_force", {20 * sample.sign, 5 * sample.sign, 0});
    put(contacts + "shear_force", {0, 3, 0, 0, 0, 0, 0, 0, 0}, 3);
    put(contacts + "contact_point", {1.49, 2, 2, 1, 2, 1.505, 0, 0, 0}, 3);
    put(contacts + "overlap", {0.02, 0.005, 0});
    put(contacts + "virtual", {0, 0, 1});
    out.save();
  }
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t scene = H5Gopen2(opened, "/ONDEM/Scene", H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
  const hid_t attribute =
      H5Acreate2(scene, "time", H5T_NATIVE_DOUBLE, one, H5P_DEFAULT, H5P_DEFAULT);
  const double time = 0.5;
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, &time);
  H5Aclose(attribute);
  H5Sclose(one);
  H5Gclose(scene);
  H5Fclose(opened);
}

}  // namespace crossgrain::files::sampled
