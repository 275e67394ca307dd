// One HDF5 file a snapshot, as the working group on formats of the Open Network on DEM has it
// (ON-DEM-WG3-FileFormat, implementation/README.md of October 2026): bodies in blocks of VTKHDF,
// which ParaView draws; scene, materials and contacts in /ONDEM.
//
// A file is put together in memory and written whole. HDF5 is used as by the thread that reads the
// snapshots, which has the library to itself (support/hdf5_file.hpp).
#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "adapters/files/write_parts.hpp"
#include "support/files.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::files {
namespace {

using Int64s = std::vector<std::int64_t>;
using Doubles = std::vector<double>;
constexpr double notApplicable = std::numeric_limits<double>::quiet_NaN();

/// An HDF5 file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const std::filesystem::path& name) : name_(name), file_(created(name)) {}

  /// @param ordered  members are listed as they were made, which VTK's reader asks for
  void group(const std::string& path, bool ordered) {
    const Hdf5Handle how(H5Pcreate(H5P_GROUP_CREATE));
    if (ordered) H5Pset_link_creation_order(how, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    check(Hdf5Handle(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, how, H5P_DEFAULT)), path);
  }
  void link(const std::string& path, const std::string& target) {
    check(H5Lcreate_soft(target.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), path);
  }
  /// @param columns  > 1: of vectors or tensors, row by row
  void array(const std::string& path, const Doubles& values, std::size_t columns = 1) {
    array(path, H5T_NATIVE_DOUBLE, values.data(), values.size() / columns, columns);
  }
  void array(const std::string& path, const Int64s& values) {
    array(path, H5T_NATIVE_INT64, values.data(), values.size(), 1);
  }
  void texts(const std::string& path, const std::vector<std::string>& values) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1));
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    std::vector<const char*> pointers;
    for (const std::string& value : values) pointers.push_back(value.c_str());
    array(path, type, pointers.data(), pointers.size(), 1);
  }
  void number(const std::string& path, double value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR));
    const Hdf5Handle set(H5Dcreate2(file_, path.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                                    H5P_DEFAULT, H5P_DEFAULT));
    check(set < 0 ? -1 : H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value),
          path);
  }
  void attribute(const std::string& at, const char* name, double value) {
    attribute(at, name, H5T_NATIVE_DOUBLE, Hdf5Handle(H5Screate(H5S_SCALAR)), &value);
  }
  void attribute(const std::string& at, const char* name, std::int64_t value) {
    attribute(at, name, H5T_NATIVE_INT64, Hdf5Handle(H5Screate(H5S_SCALAR)), &value);
  }
  /// Of a fixed length without an end mark: as VTK asks for.
  void attribute(const std::string& at, const char* name, const std::string& value) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1));
    H5Tset_size(type, value.size());
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    attribute(at, name, type, Hdf5Handle(H5Screate(H5S_SCALAR)), value.data());
  }
  /// Type and Version of what VTK reads.
  void vtkType(const std::string& at, const std::string& type) {
    attribute(at, "Type", type);
    constexpr std::array<std::int64_t, 2> version = {2, 5};
    const hsize_t size = version.size();
    attribute(at, "Version", H5T_NATIVE_INT64, Hdf5Handle(H5Screate_simple(1, &size, nullptr)),
              version.data());
  }

  /// @throws OutputError
  void save() {
    check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "its end");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
    check(size > 0 && H5Fget_file_image(file_, image.data(), image.size()) == size ? 0 : -1,
          "its end");
    if (name_.has_parent_path()) makeDirectory(name_.parent_path());
    writeFile(name_, image);
  }

 private:
  static hid_t created(const std::filesystem::path& name) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are exceptions, not print-outs
    constexpr std::size_t growth = 1 << 20;
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(access, growth, /*backing_store=*/false);
    return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }
  void array(const std::string& path, hid_t type, const void* values, std::size_t rows,
             std::size_t columns) {
    const hsize_t size[2] = {rows, columns};
    const Hdf5Handle space(H5Screate_simple(columns > 1 ? 2 : 1, size, nullptr));
    const Hdf5Handle how(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_obj_track_times(how, false);  // the same content is the same bytes at any time
    const Hdf5Handle set(
        H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, how, H5P_DEFAULT));
    check(set < 0 ? -1 : H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
  }
  void attribute(const std::string& at, const char* name, hid_t type, hid_t space,
                 const void* value) {
    const Hdf5Handle made(H5Acreate_by_name(file_, at.c_str(), name, type, space, H5P_DEFAULT,
                                            H5P_DEFAULT, H5P_DEFAULT));
    check(made < 0 ? -1 : H5Awrite(made, type, value), at + " " + name);
  }
  void check(hid_t status, const std::string& what) const {
    if (status >= 0) return;
    H5Eclear2(H5E_DEFAULT);
    throw OutputError(name_, fmt::format("{} cannot be put into it", what));
  }

  std::filesystem::path name_;
  Hdf5Handle file_;
};

/// Three components each; the plane of motion is z = 0.
void append(Doubles& to, const Vec2& v) {
  to.insert(to.end(), {v.x(), v.y(), 0.0});
}
void append(Doubles& to, const Vec3& v) {
  to.insert(to.end(), {v.x(), v.y(), v.z()});
}
/// A spin of the plane, about z.
void append(Doubles& to, double aboutZ) {
  to.insert(to.end(), {0.0, 0.0, aboutZ});
}

Vec2 shearForce(const WrittenContact& contact) {
  return contact.tangentialForce * contact.tangent();
}
Vec3 shearForce(const WrittenContactOf<3>& contact) {
  return contact.tangentialForce;
}

/// BodyColumns of one block: every body has a value in each.
struct BodyColumns {
  Int64s id, shape, material, clump, blocked;
  Doubles position, velocity, angularVelocity, orientation, radius, mass, volume, inertia, normal;
  Doubles dimensions;  ///< of boxes; empty: there are none
};

/// Indices into the file's shape_names.
constexpr std::int64_t sphereShape = 0, planeShape = 1, boxShape = 2;
/// Bits 0 to 2 are the translations along x, y and z, 3 to 5 the rotations about them.
constexpr std::int64_t planarDofs = 0b011100, fixedDofs = 0b111111;

template <int D>
class OnDemWriter : public SnapshotWriterOf<D> {
 public:
  OnDemWriter(const std::filesystem::path& out, const SceneOf<D>& scene, double height)
      : out_(out), scene_(scene), particles_(scene), height_(height) {}

  void write(const SnapshotOf<D>& now) override {
    if (count_ == 0) notWritten_ = notInFormats(now);
    MemoryFile file(writtenFiles("ondem", out_, count_ + 1).back());
    file.attribute("/", "file_format", "ON-DEM VTKHDF");
    file.attribute("/", "file_format_version", "0.2-draft");
    file.group("/VTKHDF", true);
    file.vtkType("/VTKHDF", "MultiBlockDataSet");
    file.group("/VTKHDF/Assembly", true);
    writeBlock(file, "Points", particleColumns(now));
    writeBlock(file, "Others", planeColumns(now));
    file.group("/ONDEM", false);
    writeScene(file, now);
    writeMaterials(file);
    file.group("/ONDEM/Interactions", false);
    if (now.contacts) writeContacts(file, now);
    file.save();
    ++count_;
  }

  void close() override {}

  std::vector<std::string> notWritten() const override {
    std::vector<std::string> lines = notWritten_;
    if (D == 2)
      lines.emplace_back(
          "disks: the format has none; they are spheres with the mass, volume and moment of "
          "inertia of the disks");
    if (scene_.shapes.empty())
      lines.emplace_back(D == 2 ? "angles of disks: the snapshots have none; files have 0"
                                : "orientations: the snapshots have none; files have the identity");
    lines.emplace_back("the contact law: classes of materials are not decided in the format");
    if (scene_.planeCount() > 0)
      lines.emplace_back("planes: the format has none yet; they are points with a plane_normal");
    return lines;
  }

 private:
  double volumeOf(std::size_t id) const {
    if (id < scene_.disks.size() && scene_.isConvex(id)) return massOf(scene_.shapeOf(id)).measure;
    const double radius = particles_.radii()[id], disk = std::numbers::pi * radius * radius;
    return D == 2 ? disk * height_ : 4.0 / 3.0 * disk * radius;
  }

  void addBody(BodyColumns& columns, std::int64_t shape, const WrittenParticleOf<D>& p) const {
    columns.id.push_back(static_cast<std::int64_t>(columns.id.size()));
    columns.shape.push_back(shape);
    columns.material.push_back(p.material);
    columns.clump.push_back(-1);
    columns.blocked.push_back(p.mass ? (D == 2 ? planarDofs : 0) : fixedDofs);
    append(columns.position, p.position);
    append(columns.velocity, p.velocity);
    append(columns.angularVelocity, p.spin);
    columns.orientation.insert(columns.orientation.end(), {1.0, 0.0, 0.0, 0.0});
    columns.mass.push_back(p.mass.value_or(notApplicable));
  }

  BodyColumns particleColumns(const SnapshotOf<D>& now) const {
    BodyColumns columns;
    for (std::size_t id = 0; id < particles_.size(); ++id) {
      const WrittenParticleOf<D> p = particles_.at(now, id);
      addBody(columns, sphereShape, p);
      columns.radius.push_back(p.radius);
      columns.volume.push_back(volumeOf(id));
      const double inertia = p.mass ? scene_.disks.inertia[id] : notApplicable;
      const double across = D == 2 ? notApplicable : inertia;  // a disk turns about z alone
      columns.inertia.insert(columns.inertia.end(),
                             {across, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, inertia});
      columns.normal.insert(columns.normal.end(), {notApplicable, notApplicable, notApplicable});
      if constexpr (D == 3)
        if (!scene_.shapes.empty()) setBox(columns, now, id);
    }
    return columns;
  }

  /// Of a body of a scene with boxes: the last of the columns, set as a sphere already. Moments of
  /// inertia are about its own axes, as YADE's, from which the format comes.
  void setBox(BodyColumns& columns, const SnapshotOf<3>& now, std::size_t id) const {
    const bool isBox = id < scene_.disks.size() && scene_.isConvex(id);
    append(columns.dimensions, isBox ? Vec3(2.0 * farthest<3>(scene_.shapeOf(id), Vec3::Ones()))
                                     : Vec3(Vec3::Constant(notApplicable)));
    if (id >= scene_.disks.size()) return;
    const auto row = static_cast<std::ptrdiff_t>(id);
    std::ranges::copy((*now.turn)[id], columns.orientation.begin() + 4 * row);
    if (!isBox) return;
    columns.shape[id] = boxShape;
    columns.radius[id] = notApplicable;
    for (int k = 0; k < 3; ++k)
      columns.inertia[9 * id + 4 * static_cast<std::size_t>(k)] = scene_.disks.moments[id][k];
  }

  BodyColumns planeColumns(const SnapshotOf<D>& now) const {
    BodyColumns columns;
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
      const WallBodyOf<D>& body = scene_.bodies[b];
      BodyStateOf<D> state{.centre = body.centre};
      if (b < now.bodies.size()) state = stateOf(now.bodies[b]);
      for (const PlaneOf<D>& reference : body.planes) {
        const PlaneOf<D> plane = planeAt<D>(state, body.centre, reference);
        WrittenParticleOf<D> p;
        p.position = plane.point;
        p.velocity = memberVelocity<D>(state, plane.point);
        p.spin = state.angularVelocity;
        if (scene_.materials) p.material = scene_.materials->ofBody[b];
        addBody(columns, planeShape, p);
        columns.id.back() += static_cast<std::int64_t>(particles_.size());
        columns.radius.push_back(notApplicable);
        columns.volume.push_back(notApplicable);
        columns.inertia.insert(columns.inertia.end(), 9, notApplicable);
        append(columns.normal, plane.normal);
      }
    }
    return columns;
  }

  static void writeCells(MemoryFile& file, const std::string& at, std::size_t count) {
    Int64s points(count), offsets(count + 1);
    std::iota(points.begin(), points.end(), 0);
    std::iota(offsets.begin(), offsets.end(), 0);
    file.group(at, true);
    file.array(at + "/NumberOfCells", Int64s{static_cast<std::int64_t>(count)});
    file.array(at + "/NumberOfConnectivityIds", Int64s{static_cast<std::int64_t>(count)});
    file.array(at + "/Offsets", offsets);
    file.array(at + "/Connectivity", points);
  }

  static void writeBlock(MemoryFile& file, const std::string& name, const BodyColumns& columns) {
    const std::string at = "/VTKHDF/" + name;
    file.group(at, true);
    file.vtkType(at, "PolyData");
    file.array(at + "/NumberOfPoints", Int64s{static_cast<std::int64_t>(columns.id.size())});
    file.array(at + "/Points", columns.position, 3);
    writeCells(file, at + "/Vertices", columns.id.size());
    for (const char* other : {"/Lines", "/Polygons", "/Strips"}) writeCells(file, at + other, 0);
    const std::string data = at + "/PointData";
    file.group(data, true);
    file.array(data + "/body_id", columns.id);
    file.array(data + "/shape_type", columns.shape);
    file.array(data + "/material_id", columns.material);
    file.array(data + "/clump_id", columns.clump);
    file.array(data + "/radius", columns.radius);
    file.array(data + "/velocity", columns.velocity, 3);
    file.array(data + "/angular_velocity", columns.angularVelocity, 3);
    file.array(data + "/orientation", columns.orientation, 4);
    file.attribute(data + "/orientation", "order", "wxyz");
    file.array(data + "/mass", columns.mass);
    file.array(data + "/volume", columns.volume);
    file.array(data + "/inertia", columns.inertia, 9);
    file.array(data + "/blocked_dofs", columns.blocked);
    file.array(data + "/plane_normal", columns.normal, 3);
    if (!columns.dimensions.empty()) file.array(data + "/dimensions", columns.dimensions, 3);
    file.link("/VTKHDF/Assembly/" + name, at);
  }

  void writeScene(MemoryFile& file, const SnapshotOf<D>& now) const {
    const std::string at = "/ONDEM/Scene";
    file.group(at, false);
    file.attribute(at, "time", now.positionTime);
    file.attribute(at, "velocity_time", now.velocityTime);
    file.attribute(at, "contact_time", now.contactTime);
    file.attribute(at, "timestep", scene_.dt > 0.0 ? scene_.dt : notApplicable);
    file.attribute(at, "iteration", std::int64_t{-1});
    Doubles gravity;
    append(gravity, scene_.gravity);
    file.array(at + "/gravity", gravity);
    file.texts(at + "/units", {"second", "meter", "kilogram"});
    file.texts(at + "/display_group_names", {"Points", "Others"});
    std::vector<std::string> names = {"sphere", "plane"};
    if (!scene_.shapes.empty()) names.emplace_back("box");
    file.texts(at + "/shape_names", names);
  }

  void writeMaterials(MemoryFile& file) const {
    file.group("/ONDEM/Materials", false);
    std::map<std::int32_t, std::pair<double, double>> sums;  // mass and volume of its disks
    if (scene_.materials)
      for (std::size_t m = 0; m < scene_.materials->names.size(); ++m)
        sums[static_cast<std::int32_t>(m)];
    for (std::size_t i = 0; i < scene_.disks.size(); ++i) {
      auto& [mass, volume] = sums[scene_.materials ? scene_.materials->ofDisk[i] : 0];
      mass += scene_.disks.mass[i];
      volume += volumeOf(i);
    }
    for (const auto& [id, sum] : sums) {
      const std::string at = fmt::format("/ONDEM/Materials/{}", id);
      file.group(at, false);
      file.array(at + "/id", Int64s{id});
      file.number(at + "/density", sum.second > 0.0 ? sum.first / sum.second : notApplicable);
      if (scene_.materials)
        file.texts(at + "/label", {scene_.materials->names[static_cast<std::size_t>(id)]});
    }
  }

  /// The normal is from id1 to id2, the force on id2 −normal_force · normal + shear_force:
  /// normal_force is positive in traction.
  void writeContacts(MemoryFile& file, const SnapshotOf<D>& now) const {
    const std::string at = "/ONDEM/Interactions/contact";
    Int64s first, second;
    Doubles normal, normalForce, shear, point, overlap;
    for (std::size_t k = 0; k < now.contacts->size(); ++k) {
      const WrittenContactOf<D> contact = contactAt(particles_, now, k);
      first.push_back(static_cast<std::int64_t>(contact.first));
      second.push_back(static_cast<std::int64_t>(contact.second));
      append(normal, VecOf<D>(-contact.normal));
      normalForce.push_back(-contact.normalForce);
      append(shear, VecOf<D>(-shearForce(contact)));
      append(point, contact.point);
      overlap.push_back(contact.overlap);
    }
    file.group(at, false);
    file.attribute(at, "count", static_cast<std::int64_t>(first.size()));
    file.array(at + "/id1", first);
    file.array(at + "/id2", second);
    file.array(at + "/normal", normal, 3);
    file.array(at + "/normal_force", normalForce);
    file.array(at + "/shear_force", shear, 3);
    file.array(at + "/contact_point", point, 3);
    file.array(at + "/overlap", overlap);
  }

  std::filesystem::path out_;
  const SceneOf<D>& scene_;
  WrittenParticlesOf<D> particles_;
  double height_;  ///< of disks [m]
  std::size_t count_ = 0;
  std::vector<std::string> notWritten_;
};

}  // namespace

template <int D>
std::unique_ptr<SnapshotWriterOf<D>> openOnDem(const std::filesystem::path& out,
                                               const SceneOf<D>& scene, double height) {
  return std::make_unique<OnDemWriter<D>>(out, scene, height);
}
template std::unique_ptr<SnapshotWriter> openOnDem(const std::filesystem::path&, const Scene&,
                                                   double);
template std::unique_ptr<SnapshotWriterOf<3>> openOnDem(const std::filesystem::path&,
                                                        const SpaceScene&, double);

}  // namespace crossgrain::files
