/// VTK files: YADE's VTKRecorder (X-spheres.N.vtu, X-intrs.N.vtp) and export.VTKExporter
/// (X-spheres-N.vtk, X-intrs-N.vtk); others that name their arrays alike.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "adapters/files/readers.hpp"
#include "adapters/files/vtk_data.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

/// Names of arrays by what they are, whatever their capitals: MercuryDPM has Radius, Velocity. n,
/// F, normalForce and shearForce are YADE's i.geom.normal, their sum, i.phys.normalForce,
/// i.phys.shearForce: n from id1 to id2, forces on id2.
constexpr std::pair<std::string_view, std::string_view> roles[] = {{"radii", "radius"},
                                                                   {"linvelvec", "velocity"},
                                                                   {"vel", "velocity"},
                                                                   {"v", "velocity"},
                                                                   {"angvelvec", "spin"},
                                                                   {"angvel", "spin"},
                                                                   {"angularvelocity", "spin"},
                                                                   {"angular_velocity", "spin"},
                                                                   {"omega", "spin"},
                                                                   {"type", "kind"},
                                                                   {"materialid", "kind"},
                                                                   {"speciestype", "kind"},
                                                                   {"id1", "first"},
                                                                   {"id2", "second"},
                                                                   {"forcen", "normal_force"},
                                                                   {"absforcet", "tangential"},
                                                                   {"contactpoint", "point"},
                                                                   {"penetrationdepth", "overlap"}};

class Arrays {
 public:
  Arrays(const std::vector<VtkArray>& arrays, const ColumnOptions& options, std::string where)
      : where_(std::move(where)) {
    for (const VtkArray& array : arrays) {
      const auto* const said = options.wordsOf(array.name);
      // F and f are different arrays: names of one letter keep their capitals.
      const std::string own = array.name.size() > 1 ? lowered(array.name) : array.name;
      const auto* const known =
          std::ranges::find(roles, own, [](const auto& one) { return one.first; });
      roles_.emplace_back(said                       ? said->front()
                          : known != std::end(roles) ? std::string(known->second)
                                                     : own,
                          &array);
    }
  }

  /// Absent: null. @throws BadInput where it has other components, or numbers that are not finite
  const VtkArray* find(std::string_view role, std::size_t components) const {
    const auto found = std::ranges::find(roles_, role, [](const auto& one) { return one.first; });
    if (found == roles_.end()) return nullptr;
    const VtkArray& array = *found->second;
    if (array.components != components)
      fail(fmt::format("{} has {} components, it should have {}", array.name, array.components,
                       components));
    for (const double value : array.values)
      if (!std::isfinite(value)) fail(fmt::format("{}: {} is not finite", array.name, value));
    return &array;
  }
  const VtkArray* need(std::string_view role, std::size_t components, std::string_view hint) const {
    const VtkArray* const found = find(role, components);
    if (!found) fail(fmt::format("there is no array {}: {}", role, hint));
    return found;
  }
  std::vector<Vec3> vectors(std::string_view role, double sign = 1.0) const {
    std::vector<Vec3> list;
    if (const VtkArray* const found = find(role, 3))
      for (std::size_t k = 0; k < found->rows(); ++k) list.push_back(sign * found->vector(k));
    return list;
  }
  std::vector<double> numbers(std::string_view role) const {
    const VtkArray* const found = find(role, 1);
    return found ? found->values : std::vector<double>();
  }
  std::vector<std::int64_t> wholeNumbers(std::string_view role) const {
    std::vector<std::int64_t> list;
    for (const double value : numbers(role)) {
      if (value < 0.0 || value > 0x1p53 || value != std::floor(value))
        fail(fmt::format("{}: {} should be a whole number, 0 or more", role, value));
      list.push_back(static_cast<std::int64_t>(value));
    }
    return list;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", where_, what));
  }

 private:
  std::string where_;
  std::vector<std::pair<std::string, const VtkArray*>> roles_;
};

VtkData readVtk(const fs::path& file) {
  char first = 0;
  RegularFile(file).read(0, std::as_writable_bytes(std::span(&first, 1)));
  return first == '#' ? readVtkLegacy(file) : readVtkXml(file);
}

Part readSpheres(const fs::path& file, const ColumnOptions& options) {
  const VtkData data = readVtk(file);
  const Arrays arrays(data.pointArrays, options, file.string());
  Part part;
  part.frame.where = file.string();
  FileParticles& particles = part.frame.particles;
  for (const Vec3& point : data.points)
    if (!point.allFinite()) arrays.fail("a point is not finite");
  particles.position = data.points;
  arrays.need("radius", 1,
              arrays.find("contactradius", 1)
                  ? "these are contacts that do not name their particles, as MercuryDPM's "
                    "Interaction files are: .data and .fstat have both"
                  : "these are no spheres");
  particles.radius = arrays.numbers("radius");
  particles.id = arrays.wholeNumbers("id");
  for (std::size_t k = 0; particles.id.size() < particles.size(); ++k)
    particles.id.push_back(static_cast<std::int64_t>(k));
  particles.velocity = arrays.vectors("velocity");
  particles.spin = arrays.vectors("spin");
  particles.mass = arrays.numbers("mass");
  particles.kind = arrays.wholeNumbers("kind");
  return part;
}

Part readContacts(const fs::path& file, const ColumnOptions& options) {
  const VtkData data = readVtk(file);
  const Arrays arrays(data.lineArrays, options, file.string());
  Part part;
  part.frame.where = file.string();
  ContactTable& table = part.table.emplace();
  FileContacts& contacts = table.contacts;
  if (data.lines.empty()) return part;
  contacts.first = arrays.wholeNumbers("first");
  contacts.second = arrays.wholeNumbers("second");
  if (contacts.first.empty() || contacts.second.empty()) {
    contacts.first.assign(data.lines.size(), 0);
    contacts.second = contacts.first;
    for (const auto& [from, to] : data.lines)
      table.ends.emplace_back(data.points[from], data.points[to]);
  }
  contacts.normal = arrays.vectors("normal");
  if (contacts.normal.empty()) contacts.normal = arrays.vectors("n", -1.0);
  if (contacts.normal.empty())
    for (const auto& [from, to] : data.lines)
      table.branch.push_back(data.points[from] - data.points[to]);
  contacts.point = arrays.vectors("point");
  contacts.overlap = arrays.numbers("overlap");
  contacts.force = arrays.vectors("force");
  if (contacts.force.empty()) contacts.force = arrays.vectors("F", -1.0);
  if (contacts.force.empty()) {
    contacts.force = arrays.vectors("normalforce", -1.0);
    const std::vector<Vec3> shear = arrays.vectors("shearforce", -1.0);
    if (contacts.force.size() != shear.size())
      arrays.fail("normalForce and shearForce: one of both is missing");
    for (std::size_t k = 0; k < shear.size(); ++k) contacts.force[k] += shear[k];
  }
  if (!contacts.force.empty()) return part;
  arrays.need(
      "normal_force", 1,
      "export F=i.phys.normalForce+i.phys.shearForce, n=i.geom.normal, id1=i.id1, id2=i.id2");
  contacts.normalForce = arrays.numbers("normal_force");
  for (const Vec3& tangential : arrays.vectors("tangential"))
    contacts.tangentialForce.push_back(tangential.norm());
  if (contacts.tangentialForce.empty())
    contacts.tangentialForce = arrays.numbers("tangential_force");
  return part;
}

/// Ids of particles whose centres, rounded alike, the ends of the lines are.
void findEnds(ContactTable& table, const FileFrame& frame) {
  const FileParticles& particles = frame.particles;
  const auto key = [](const Vec3& at) { return std::array{at.x(), at.y(), at.z()}; };
  std::vector<std::pair<std::array<double, 3>, std::int64_t>> centres;
  for (std::size_t k = 0; k < particles.size(); ++k)
    centres.emplace_back(key(particles.position[k]), particles.id[k]);
  std::ranges::sort(centres);
  const auto idAt = [&](const Vec3& at) {
    const auto found =
        std::ranges::lower_bound(centres, key(at), {}, [](const auto& one) { return one.first; });
    if (found == centres.end() || found->first != key(at))
      throw BadInput(
          fmt::format("{}: a contact ends at ({}, {}, {}), which is no sphere's centre: a wall, or "
                      "over a periodic edge? Export id1=i.id1 and id2=i.id2 by export.VTKExporter",
                      frame.where, at.x(), at.y(), at.z()));
    return found->second;
  };
  for (std::size_t k = 0; k < table.ends.size(); ++k) {
    table.contacts.first[k] = idAt(table.ends[k].first);
    table.contacts.second[k] = idAt(table.ends[k].second);
  }
}

/// Bodies that are no spheres are not among the particles: walls, facets. As the first of a contact
/// they become the second, which turns directions and forces.
void findWalls(ContactTable& table, FileFrame& frame) {
  if (!table.ends.empty()) return findEnds(table, frame);
  const RowOfId rows(frame);
  FileContacts& contacts = table.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    std::int64_t &first = contacts.first[k], &second = contacts.second[k];
    if (rows[first] && !rows[second]) {
      second = -second - 1;
    } else if (rows[second] && !rows[first]) {
      first = std::exchange(second, -first - 1);
      for (std::vector<Vec3>* turned : {&contacts.normal, &contacts.force, &table.branch})
        if (!turned->empty()) (*turned)[k] = -(*turned)[k];
    }
  }
}

/// @param isPiece  an index names it
Content contentOf(const fs::path& file, bool isPiece) {
  if (isGzip(file))
    throw BadInput(fmt::format(
        "{}: is packed by gzip, which is read of text alone: unpack it before", file.string()));
  // In XML it stands before the numbers, which may have no line ends.
  std::string head(std::size_t{1} << 14, '\0');
  const RegularFile bytes(file);
  head.resize(bytes.read(0, std::as_writable_bytes(std::span(head))));
  if (head.starts_with('<')) {
    const bool isIndex = head.find("type=\"PUnstructuredGrid\"") != std::string::npos ||
                         head.find("type=\"PPolyData\"") != std::string::npos;
    if (isIndex && isPiece)
      throw BadInput(fmt::format("{}: is an index that another one names", file.string()));
    const std::vector<fs::path> pieces = isIndex ? piecesOfVtk(file) : std::vector<fs::path>();
    if (!pieces.empty()) return contentOf(pieces.front(), true);
    constexpr std::string_view lines = "NumberOfLines=\"";
    const std::size_t at = head.find(lines);
    const bool hasLines = at != std::string::npos && at + lines.size() < head.size() &&
                          head[at + lines.size()] != '0';
    return hasLines || head.find("\"forceN\"") != std::string::npos ? Content::contacts
                                                                    : Content::particles;
  }
  return legacyHasLines(file) ? Content::contacts : Content::particles;
}

}  // namespace

Content contentOfVtk(const fs::path& file) {
  return contentOf(file, false);
}

std::unique_ptr<FrameReader> openVtk(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  const auto reader = [&](Content content, Part (*read)(const fs::path&, const ColumnOptions&)) {
    return std::make_unique<WholeFiles>(
        filesOf(files, content, contentOfVtk),
        [columns, read](const fs::path& file) { return read(file, *columns); });
  };
  std::vector<std::unique_ptr<PartReader>> contacts;
  if (auto lines = reader(Content::contacts, readContacts); lines->bytes() > 0)
    contacts.push_back(std::move(lines));
  return joinParts(reader(Content::particles, readSpheres), std::move(contacts), columns,
                   findWalls);
}

}  // namespace crossgrain::files
