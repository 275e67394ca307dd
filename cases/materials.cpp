#include "cases/materials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

/// Someone who is of a material, and how to call him where he names none.
struct Body {
  std::string who;
  const MaterialName* material;
};

std::vector<Body> bodiesOf(const Case& setup) {
  std::vector<Body> bodies;
  if (isCollision(setup)) {
    for (const MaterialName& material : collisionIn(setup).material)
      bodies.push_back({"[collision]", &material});
    return bodies;
  }
  if (const Couette* const cell = cellOf(setup)) {
    const Particles& p = cell->particles;
    if (p.small > 0 || p.file) bodies.push_back({"[particles] small", &p.smallMaterial});
    if (p.large > 0 || p.file) bodies.push_back({"[particles] large", &p.largeMaterial});
    bodies.push_back({"[cell] wheel", &cell->cell.wheelMaterial});
    bodies.push_back({"[cell] ring", &cell->cell.ringMaterial});
    return bodies;
  }
  withAssembly(setup, [&](const auto& assembly) {
    for (std::size_t k = 0; k < assembly.disks.size(); ++k)
      bodies.push_back({fmt::format("assembly.disks[{}]", k), &assembly.disks[k].material});
    const auto& starts = assembly.starts;
    for (const MaterialName& material : starts.rowMaterials)
      bodies.push_back({"[assembly.start]", &material});
    const bool allSay = !starts.rowMaterialOf.empty() &&
                        std::ranges::none_of(starts.rowMaterialOf, [](auto of) { return of < 0; });
    if (!starts.disks.empty() && (!allSay || !starts.material.name.empty()))
      bodies.push_back({"[assembly.start]", &starts.material});
    for (std::size_t k = 0; k < assembly.walls.size(); ++k)
      bodies.push_back({fmt::format("assembly.walls[{}]", k), &assembly.walls[k].material});
  });
  return bodies;
}

std::int32_t indexOf(const Materials& materials, const MaterialName& material) {
  return static_cast<std::int32_t>(std::ranges::find(materials.names, material.name) -
                                   materials.names.begin());
}

}  // namespace

std::vector<ContactLaw> lawsOf(const Case& setup) {
  return setup.materials ? setup.materials->laws : std::vector{setup.law};
}

const ContactLaw& lawOf(const Case& setup, const MaterialName& one, const MaterialName& other) {
  if (!setup.materials) return setup.law;
  return setup.materials->law(indexOf(*setup.materials, one), indexOf(*setup.materials, other));
}

void settleMaterials(Case& setup) {
  if (!setup.materials) return;
  const Materials& materials = *setup.materials;
  std::vector<bool> used(materials.names.size(), false);
  const std::vector<Body> bodies = bodiesOf(setup);
  if (bodies.empty())
    throw BadInput(
        fmt::format("{}: [collision] has no material: with [[law.pairs]] it has two, of {}",
                    setup.file.string(), fmt::join(materials.names, ", ")));
  for (const auto& [who, material] : bodies) {
    if (material->name.empty())
      throw BadInput(
          fmt::format("{}: {} has no material: with [[law.pairs]] every body has one, of {}",
                      setup.file.string(), who, fmt::join(materials.names, ", ")));
    const auto index = static_cast<std::size_t>(indexOf(materials, *material));
    if (index == used.size())
      throw BadInput(fmt::format("{} = \"{}\": no [[law.pairs]] has that material{}",
                                 material->where, material->name,
                                 suggestion(material->name, materials.names)));
    used[index] = true;
  }
  if (const auto idle = std::ranges::find(used, false); idle != used.end())
    throw BadInput(fmt::format("{}: [[law.pairs]] has a material that nobody is made of, \"{}\"",
                               setup.file.string(),
                               materials.names[static_cast<std::size_t>(idle - used.begin())]));
  if (isCollision(setup)) {
    setup.law = materials.law(indexOf(materials, collisionIn(setup).material.front()),
                              indexOf(materials, collisionIn(setup).material.back()));
    setup.materials.reset();
  } else if (std::ranges::all_of(materials.laws,
                                 [&](const ContactLaw& law) { return law == setup.law; })) {
    setup.materials.reset();
  }
}

void refuseMaterials(const Case& setup) {
  for (const auto& [who, material] : bodiesOf(setup))
    if (!material->name.empty())
      throw BadInput(fmt::format(
          "{} = \"{}\": the case has no [[law.pairs]], which say what the law of a material is",
          material->where, material->name));
}

template <int D>
void addMaterials(SceneOf<D>& scene, const Case& setup) {
  if (!setup.materials) return;
  Materials& materials = scene.materials.emplace(*setup.materials);
  const auto index = [&](const MaterialName& material) { return indexOf(materials, material); };
  if (const Couette* const cell = cellOf(setup)) {
    const Particles& p = cell->particles;
    for (std::size_t i = 0; i < scene.disks.size(); ++i) {
      const double a = scene.disks.radius[i];
      const bool small = p.file ? std::abs(a - p.smallRadius) <= std::abs(a - p.largeRadius)
                                : i < static_cast<std::size_t>(p.small);
      materials.ofDisk.push_back(index(small ? p.smallMaterial : p.largeMaterial));
    }
    materials.ofBody = {index(cell->cell.wheelMaterial), index(cell->cell.ringMaterial)};
    return;
  }
  const AssemblyOf<D>& assembly = assemblyIn<D>(setup);
  for (const DiskGroupOf<D>& group : assembly.disks)
    materials.ofDisk.insert(materials.ofDisk.end(), group.count(), index(group.material));
  if (!assembly.starts.disks.empty())
    materials.ofDisk.assign(scene.disks.size(), index(assembly.starts.material));
  std::vector<std::int32_t> ofRows;
  for (const MaterialName& material : assembly.starts.rowMaterials)
    ofRows.push_back(index(material));
  const std::vector<std::int32_t>& rows = assembly.starts.rowMaterialOf;
  for (std::size_t i = 0; i < std::min(rows.size(), scene.disks.size()); ++i)
    if (rows[i] >= 0) materials.ofDisk[i] = ofRows[static_cast<std::size_t>(rows[i])];
  for (const WallGroupOf<D>& wall : assembly.walls)
    materials.ofBody.push_back(index(wall.material));
}
template void addMaterials(Scene&, const Case&);
template void addMaterials(SpaceScene&, const Case&);

}  // namespace crossgrain::inline cases
