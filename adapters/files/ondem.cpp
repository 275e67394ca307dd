/// ON-DEM's VTKHDF (https://github.com/ON-DEM/ON-DEM-WG3-FileFormat), one time a file, in its
/// layouts of June 2026 (one body of points) and October 2026 (blocks of bodies).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"
#include "support/input_file.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

/// Paths of a file's data.
struct Layout {
  std::string points = "/VTKHDF/Points", ofPoints = "/VTKHDF/PointData/";
  std::string interactions = "/ONDEM/Interactions/";
  std::vector<std::string> walls = {"/ONDEM/Bodies/Walls/body_id", "/ONDEM/Bodies/Facets/body_id",
                                    "/ONDEM/Bodies/Boxes/body_id"};
  bool traction = false;  ///< normal_force > 0 pulls
};
const Layout ofJune;
const Layout ofBlocks{"/VTKHDF/Points/Points",
                      "/VTKHDF/Points/PointData/",
                      "/ONDEM/Interactions/contact/",
                      {"/VTKHDF/Others/PointData/body_id"},
                      true};

/// Arrays of a file, of the length that they should have.
class Arrays {
 public:
  explicit Arrays(const fs::path& file) : file_(Hdf5File::open(file)), name_(file.string()) {}

  /// Absent: empty. @param missing  what stands for NaN, which then says that a body has none
  /// @throws BadInput
  std::vector<double> numbers(const std::string& path, std::size_t rows, std::size_t columns = 1,
                              std::optional<double> missing = {}) const {
    std::optional<std::vector<double>> found = file_.read(path);
    if (!found) return {};
    if (missing)
      for (double& value : *found)
        if (std::isnan(value)) value = *missing;
    if (found->size() != rows * columns)
      fail(fmt::format("{} has {} numbers, there should be {}", path, found->size(),
                       rows * columns));
    for (const double value : *found)
      if (!std::isfinite(value)) fail(fmt::format("{}: {} is not finite", path, value));
    return *found;
  }
  std::vector<double> needNumbers(const std::string& path, std::size_t rows,
                                  std::size_t columns = 1) const {
    need(path);
    return numbers(path, rows, columns);
  }
  std::vector<Vec3> vectors(const std::string& path, std::size_t rows, double sign = 1.0) const {
    std::vector<Vec3> list;
    const std::vector<double> values = numbers(path, rows, 3);
    for (std::size_t k = 0; k < values.size(); k += 3)
      list.emplace_back(sign * values[k], sign * values[k + 1], sign * values[k + 2]);
    return list;
  }
  std::vector<std::int64_t> wholeNumbers(const std::string& path, std::size_t rows) const {
    std::vector<std::int64_t> list;
    for (const double value : numbers(path, rows)) {
      if (value < 0.0 || value > 0x1p53 || value != std::floor(value))
        fail(fmt::format("{}: {} should be a whole number, 0 or more", path, value));
      list.push_back(static_cast<std::int64_t>(value));
    }
    return list;
  }
  void need(const std::string& path) const {
    if (!file_.holds(path))
      fail(fmt::format("there is no {}: the exporter left it out (it prints \"SKIPPED\" then)",
                       path));
  }
  bool holds(const std::string& path) const { return file_.holds(path); }
  std::size_t length(const std::string& path) const {
    need(path);
    return file_.length(path).value_or(0);
  }
  std::optional<double> attribute(const std::string& path, const std::string& name) const {
    return file_.readAttributeOf(path, name);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", name_, what));
  }

 private:
  Hdf5File file_;
  std::string name_;
};

/// Bodies that are no spheres and so no points.
std::vector<std::int64_t> wallIds(const Arrays& arrays, const Layout& layout) {
  std::vector<std::int64_t> ids;
  for (const std::string& path : layout.walls) {
    if (!arrays.holds(path)) continue;
    const auto own = arrays.wholeNumbers(path, arrays.length(path));
    ids.insert(ids.end(), own.begin(), own.end());
  }
  std::ranges::sort(ids);
  return ids;
}

/// `normal` is from id1 to id2, normal_force n + shear_force acts on id2: so the exporter takes
/// them from YADE, and so they are in the sample files, where normal_force > 0 pushes. The schema
/// has it "positive in traction", and so have files of blocks.
void checkSign(const Arrays& arrays, const std::string& interactions,
               const std::vector<double>& normalForce, std::size_t rows) {
  const std::vector<double> overlap = arrays.numbers(interactions + "overlap", rows);
  double work = 0.0;
  for (std::size_t k = 0; k < overlap.size(); ++k) work += overlap[k] * normalForce[k];
  if (work < 0.0)
    arrays.fail(
        interactions +
        "normal_force is negative where bodies overlap: it counts traction as positive, the "
        "exporter's files count pressure so; say columns = normal_force=traction");
}

std::optional<ContactTable> readInteractions(const Arrays& arrays, const Layout& layout,
                                             bool traction) {
  const std::string& interactions = layout.interactions;
  if (!arrays.holds(interactions + "id1")) return std::nullopt;
  const std::size_t rows = arrays.length(interactions + "id1");
  const std::vector<std::int64_t> walls = wallIds(arrays, layout);
  const auto id = [&](std::int64_t body) {
    return std::ranges::binary_search(walls, body) ? -body - 1 : body;
  };
  arrays.need(interactions + "id2");
  arrays.need(interactions + "normal");
  std::vector<double> normalForce = arrays.needNumbers(interactions + "normal_force", rows);
  if (traction)
    for (double& force : normalForce) force = -force;
  else
    checkSign(arrays, interactions, normalForce, rows);
  const auto first = arrays.wholeNumbers(interactions + "id1", rows),
             second = arrays.wholeNumbers(interactions + "id2", rows);
  const std::vector<Vec3> normal = arrays.vectors(interactions + "normal", rows),
                          shear = arrays.vectors(interactions + "shear_force", rows),
                          point = arrays.vectors(interactions + "contact_point", rows);
  const std::vector<double> overlap = arrays.numbers(interactions + "overlap", rows),
                            unreal = arrays.numbers(interactions + "virtual", rows);
  ContactTable table;
  FileContacts& contacts = table.contacts;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!unreal.empty() && unreal[k] != 0.0) continue;
    // A wall comes second; seen from the other body all is reversed.
    const bool turned = id(first[k]) < 0;
    const double sign = turned ? 1.0 : -1.0;
    contacts.first.push_back(id(turned ? second[k] : first[k]));
    contacts.second.push_back(id(turned ? first[k] : second[k]));
    if (contacts.first.back() < 0)
      arrays.fail(fmt::format("{}: row {} is of two walls", interactions, k));
    contacts.normal.push_back(sign * normal[k]);
    if (!shear.empty())
      contacts.force.push_back(sign * (normalForce[k] * normal[k] + shear[k]));
    else
      contacts.normalForce.push_back(normalForce[k]);
    if (!point.empty()) contacts.point.push_back(point[k]);
    if (!overlap.empty()) contacts.overlap.push_back(overlap[k]);
  }
  return table;
}

Part readScene(const fs::path& file, bool traction) {
  const Arrays arrays(file);
  Part part;
  part.frame.where = file.string();
  if (arrays.holds("/VTKHDF/Steps"))
    arrays.fail("/VTKHDF/Steps: several times in one file are not read");
  const Layout& layout = arrays.holds(ofBlocks.points) ? ofBlocks : ofJune;
  const std::string& ofPoints = layout.ofPoints;
  const std::size_t rows = arrays.length(layout.points) / 3;
  FileParticles& particles = part.frame.particles;
  particles.position = arrays.vectors(layout.points, rows);
  arrays.need(ofPoints + "body_id");
  if (arrays.holds(ofPoints + "dimensions"))
    arrays.fail(ofPoints + "dimensions: it holds boxes, and only spheres are read");
  particles.id = arrays.wholeNumbers(ofPoints + "body_id", rows);
  particles.radius = arrays.needNumbers(ofPoints + "radius", rows);
  particles.mass = arrays.numbers(ofPoints + "mass", rows, 1, 0.0);
  particles.velocity = arrays.vectors(ofPoints + "velocity", rows);
  particles.spin = arrays.vectors(ofPoints + "angular_velocity", rows);
  if (arrays.holds(ofPoints + "material_id"))
    particles.kind = arrays.wholeNumbers(ofPoints + "material_id", rows);
  for (const auto& [name, time] : {std::pair("time", &part.frame.time),
                                   {"velocity_time", &part.frame.velocityTime},
                                   {"contact_time", &part.frame.contactTime}}) {
    *time = arrays.attribute("/ONDEM/Scene", name);
    if (*time && !std::isfinite(**time))
      arrays.fail(fmt::format("/ONDEM/Scene/{} is not finite", name));
  }
  part.table = readInteractions(arrays, layout, traction || layout.traction);
  return part;
}

/// Reads a file; errors of HDF5 become BadInput.
Part readChecked(const fs::path& file, bool traction) {
  if (const std::string why = fileFault(file); !why.empty())
    throw BadInput(fmt::format("{}: {}", file.string(), why));
  tryReading(file, [&] { readScene(file, traction); });
  try {
    return readScene(file, traction);
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
}

}  // namespace

std::unique_ptr<FrameReader> openOnDem(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  bool traction = false;
  if (const auto* const said = columns->wordsOf("normal_force")) {
    if (*said != std::vector<std::string>{"traction"})
      throw BadInput("columns: of normal_force can be said that it is traction, else nothing");
    traction = true;
  }
  return joinParts(
      std::make_unique<WholeFiles>(
          files, [traction](const fs::path& file) { return readChecked(file, traction); }),
      {}, columns);
}

}  // namespace crossgrain::files
