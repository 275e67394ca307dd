#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/loader_sections.hpp"
#include "cases/start_file.hpp"

namespace crossgrain::inline cases {
namespace {

/// The keys of [assembly.box].
template <int D>
struct BoxInput : BoxOf<D> {
  Names along;
};

template <int D>
const Section<BoxInput<D>>& boxKeys() {
  using I = BoxInput<D>;
  static const Section<I> section(
      {.name = "assembly.box",
       .kinds = "assembly",
       .note = "Along other directions it is no boundary."},
      {need("low", &I::low, anyNumber("m"), "[x, y], in space [x, y, z]"),
       need("high", &I::high, anyNumber("m"), "beyond it"),
       need("periodic", &I::along, D == 2 ? Names{"x", "y"} : Names{"x", "y", "z"},
            "one or several: `[\"x\"]`; in space z, too")});
  return section;
}

/// Of the moving disks [m]
template <int D>
double largestRadius(const AssemblyOf<D>& assembly) {
  double disk = 0.0;
  for (const DiskGroupOf<D>& group : assembly.disks)
    disk = std::max(disk, group.radius * (1.0 + group.radiusSpread));
  for (const DisksOf<D>& disks : assembly.starts.disks)
    disk = std::max(disk, std::ranges::max(disks.radius));
  return disk;
}

/// a_i + a_j of the largest pair with a moving disk [m]
template <int D>
double largestReach(const AssemblyOf<D>& assembly) {
  const double disk = largestRadius(assembly);
  double wall = 0.0;
  for (const WallGroupOf<D>& group : assembly.walls) {
    if (!group.position.empty()) wall = std::max(wall, group.radius);
    for (const double radius : group.radii) wall = std::max(wall, radius);
  }
  return disk + std::max(disk, wall);
}

/// The keys of [assembly.start].
template <int D>
struct StartInput {
  std::vector<StartShapeOf<D>> shapes;
  std::vector<std::filesystem::path> files;
  double density = 0.0, velocityRms = 0.0;
  MaterialName material, fixedMaterial;
};

template <int D>
const Section<StartInput<D>>& startKeys() {
  using I = StartInput<D>;
  static const Section<I> section(
      {.name = "assembly.start",
       .kinds = "assembly",
       .note = "Disks of your own, in place of `[[assembly.disks]]`: "
               "[how](../cases/assembly/README.md#a-start-of-your-own)."},
      {need("file", &I::files, ExistingFile{".csv"}, "CSV or HDF5, or a list: each is a packing"),
       special<I>({"shapes", "m", "–", "a table",
                   "by name, for rows of CSV files: `{ brick = { box = [0.2, 0.1] }, … }`, as "
                   "`shape` of `[[assembly.disks]]`"},
                  [](Reader& in, const std::string& key, I& start) {
                    Reader named = in.section(key);
                    for (const std::string& name : named.keys()) {
                      StartShapeOf<D>& own = start.shapes.emplace_back();
                      own.name = name;
                      own.shape = readShape<D>(named.section(name));
                      own.frame = intoOwnFrame(own.shape);
                      own.spread = massOf(own.shape);
                    }
                  }),
       key("density", &I::density, densities<D>(), densityMeaning)
           .listed("required where a file has no masses"),
       key("velocity_rms", &I::velocityRms, atLeast(0.0, "m/s"),
           "normally distributed, added: makes `preparation.packings` packings of the files in "
           "turn"),
       key("material", &I::material, any, "of disks whose rows name none"),
       key("fixed_material", &I::fixedMaterial, any, "of disks that stand still")});
  return section;
}

/// Materials of a file's rows, those of other files being alike.
template <int D>
void addMaterials(const StartOf<D>& start, const std::filesystem::path& file,
                  StartFilesOf<D>& starts) {
  std::vector<std::int32_t> ofRow;
  for (std::size_t k = 0; k < start.materials.size(); ++k) {
    const std::string& name = start.materials[k];
    auto& known = starts.rowMaterials;
    const auto found = std::ranges::find(known, name, &MaterialName::name);
    ofRow.push_back(name.empty() ? -1 : static_cast<std::int32_t>(found - known.begin()));
    if (!name.empty() && found == known.end())
      known.push_back({name, fmt::format("{}:{}: material", file.string(), start.lines[k])});
  }
  if (starts.disks.empty()) starts.rowMaterialOf = ofRow;
  const auto says = [](const std::vector<std::int32_t>& rows) {
    return std::ranges::any_of(rows, [](std::int32_t of) { return of >= 0; });
  };
  if (ofRow != starts.rowMaterialOf && (says(ofRow) || says(starts.rowMaterialOf)))
    throw BadInput(fmt::format("{}: the materials of its disks are not those of {}, row by row",
                               file.string(), starts.files.front().string()));
}

/// Of the disks that stand still, which are one body; `material` where the case names it.
template <int D>
MaterialName materialOfFixed(const StartOf<D>& start, const std::filesystem::path& file,
                             MaterialName material) {
  for (std::size_t k = 0; k < start.fixedMaterials.size(); ++k) {
    const std::string& own = start.fixedMaterials[k];
    if (own.empty()) continue;
    if (material.name.empty())
      material = {own, fmt::format("{}:{}: material", file.string(), start.fixedLines[k])};
    if (material.name != own)
      throw BadInput(fmt::format("{}:{}: material = {}: disks that stand still are one body, of {}",
                                 file.string(), start.fixedLines[k], own, material.name));
  }
  return material;
}

/// One start that counts as two packings would make a scatter too small.
template <int D>
void requireDifferent(const StartFilesOf<D>& starts) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t k = 0; k < starts.disks.size(); ++k) {
    Packing packing;
    disksIn<D>(packing) = starts.disks[k];
    const auto [same, isNew] = seen.emplace(contentHash(packing), k);
    if (!isNew)
      throw BadInput(fmt::format("{}: its disks are those of {}: each file must be another start",
                                 starts.files[k].string(), starts.files[same->second].string()));
  }
}

}  // namespace

SectionInfo boxSection() {
  return boxKeys<2>().info();
}

SectionInfo startSection() {
  return startKeys<2>().info();
}

/// A pair touches through one image at most where the box is wider than two reaches.
template <int D>
void checkCylinders(const Reader& in, const AssemblyOf<D>& assembly) {
  const double disk = largestRadius(assembly);
  for (std::size_t w = 0; w < assembly.walls.size(); ++w)
    for (const Cylinder& cylinder : assembly.walls[w].cylinders)
      in.check(cylinder.radius > disk, "walls",
               "[{}] has a cylinder with a radius of {:g} m; the largest sphere, of {:g} m, must "
               "fit in",
               w, cylinder.radius, disk);
}
template void checkCylinders<2>(const Reader&, const Assembly&);
template void checkCylinders<3>(const Reader&, const AssemblyOf<3>&);

template <int D>
void readBox(Reader in, AssemblyOf<D>& assembly) {
  BoxInput<D> box;
  const double reach = largestReach(assembly);
  boxKeys<D>().read(in, box);
  in.check(!box.along.empty(), "periodic", "must name a direction; a box without any is none");
  in.check(((box.high - box.low).array() > 0.0).all(), "high", "must lie beyond low in all of {}",
           D == 2 ? "x, y" : "x, y, z");
  in.check((box.high - box.low).allFinite(), "high", "is so far from low that no number holds it");
  for (const std::string& name : box.along) {
    const int k = name[0] - 'x';
    box.periodic[static_cast<std::size_t>(k)] = true;
    const double length = box.high[k] - box.low[k];
    in.check(length > 2.0 * reach, "high",
             "the box is {:g} m wide along {}, and must be wider than two reaches of its largest "
             "pair, {:g} m",
             length, name, 2.0 * reach);
    for (std::size_t w = 0; w < assembly.walls.size(); ++w) {
      for (const PlaneOf<D>& plane : assembly.walls[w].planes)
        in.check(
            plane.normal[k] == 0.0, "periodic",
            "assembly.walls[{}] has a plane across {}: what is periodic has no wall there, and "
            "its planes are along it",
            w, name);
      for (const Cylinder& cylinder : assembly.walls[w].cylinders)
        in.check(std::abs(cylinder.axis[k]) == 1.0, "periodic",
                 "assembly.walls[{}] has a cylinder that is not along {}: what is periodic has no "
                 "wall there",
                 w, name);
    }
  }
  assembly.box = box;
}
template void readBox<2>(Reader, Assembly&);
template void readBox<3>(Reader, AssemblyOf<3>&);

template <int D>
void readStartFiles(Reader in, AssemblyOf<D>& assembly) {
  StartFilesOf<D>& starts = assembly.starts;
  StartInput<D> input;
  startKeys<D>().read(in, input);
  in.check(!input.files.empty(), "file", "must name one file or more");
  starts.files = input.files;
  starts.velocityRms = input.velocityRms;
  starts.material = input.material;
  for (const auto& file : starts.files) {
    const auto mass = [&in, &file, density = input.density](double radius) {
      if (density == 0.0)
        throw BadInput(
            fmt::format("{}: has no masses, and [assembly.start] no density", file.string()));
      return massOfOne<D>(in, density, radius);
    };
    in.check(input.shapes.empty() || file.extension() == ".csv", "shapes",
             "are named by rows of CSV files, and {} is none", file.string());
    StartOf<D> start =
        readStart<D>(file, {mass, assembly.inertiaFactor, mostDisks, input.density}, input.shapes);
    if (starts.disks.empty()) {
      starts.fixedPosition = start.fixedPosition;
      starts.fixedRadius = start.fixedRadius;
    }
    if (start.fixedPosition != starts.fixedPosition || start.fixedRadius != starts.fixedRadius)
      throw BadInput(fmt::format("{}: its fixed disks are not those of {}", file.string(),
                                 starts.files.front().string()));
    addMaterials(start, file, starts);
    input.fixedMaterial = materialOfFixed(start, file, input.fixedMaterial);
    starts.disks.push_back(std::move(start.disks));
    starts.lines.push_back(std::move(start.lines));
    starts.lines.back().insert(starts.lines.back().end(), start.fixedLines.begin(),
                               start.fixedLines.end());
  }
  requireDifferent(starts);
  for (std::size_t k = 0; k < input.shapes.size(); ++k) {
    const auto isOf = [k](const DisksOf<D>& disks) {
      return std::ranges::count(disks.shape, static_cast<std::int32_t>(k)) > 0;
    };
    in.check(std::ranges::any_of(starts.disks, isOf), "shapes", "no row names {}",
             input.shapes[k].name);
    starts.shapes.push_back(input.shapes[k].shape);
  }
  if (starts.fixedRadius.empty()) return;
  WallGroupOf<D> fixed;  // disks of the file that stand still, as one more body
  fixed.position = starts.fixedPosition;
  fixed.radii = starts.fixedRadius;
  fixed.material = input.fixedMaterial;
  assembly.walls.push_back(fixed);
}
template void readStartFiles<2>(Reader, Assembly&);
template void readStartFiles<3>(Reader, AssemblyOf<3>&);

}  // namespace crossgrain::inline cases
