#include "cases/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "law/law_options.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/hdf5_file.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cases {

namespace {

template <int D>
std::vector<VecOf<D>> asVectors(const std::vector<double>& values) {
  std::vector<VecOf<D>> vectors;
  for (std::size_t i = 0; i + D <= values.size(); i += D)
    vectors.emplace_back(VecOf<D>::Map(&values[i]));
  return vectors;
}

/// Angular velocities, one number or three each.
template <int D>
std::vector<SpinOf<D>> asSpins(std::vector<double> values) {
  if constexpr (D == 2)
    return values;
  else
    return asVectors<3>(values);
}

}  // namespace

std::string contentHash(const Packing& packing) {
  std::string bytes;
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()),
                 values.size() * sizeof(values.front()));
  };
  const Disks& disks = packing.disks;
  for (const auto* values : {&disks.radius, &disks.mass, &disks.inertia, &disks.spin}) add(*values);
  add(disks.position);
  add(disks.velocity);
  const DisksOf<3>& spheres = packing.spheres;
  for (const auto* values : {&spheres.radius, &spheres.mass, &spheres.inertia}) add(*values);
  for (const auto* values : {&spheres.position, &spheres.velocity, &spheres.spin}) add(*values);
  add(disks.turn);
  add(spheres.turn);
  add(disks.shape);
  add(spheres.shape);
  std::string hash = fmt::format("{:016x} {}", fnv1a(bytes), packing.wheelAngle);
  if (packing.wallTime != 0.0) hash += fmt::format(" {}", packing.wallTime);
  if (!packing.fixed.empty()) hash += " fixed " + packing.fixed;
  return hash;
}

std::string packingHash(const Case& setup, int index, double dt) {
  // The leading tag changes whenever the preparation itself does.
  std::string text = fmt::format("preparation 2; dt {};", couetteIn(setup).filling.dt.value_or(dt));
  const ContactLaw& law = setup.law;
  for (const LawOption& option : lawOptions())
    if (hasPart(law, option.part))
      text += fmt::format("{} {};", option.name, option.values[option.get(law)]);
  const auto addConstants = [&](const ContactLaw& of) {
    for (const LawConstant& constant : lawConstants())
      if (hasPart(of, constant.part)) text += fmt::format(" {}", of.*constant.value);
    text += ';';
  };
  text += "law";
  addConstants(law);
  if (setup.materials) {
    text += "pairs";
    std::ranges::for_each(setup.materials->laws, addConstants);
    const Particles& disks = couetteIn(setup).particles;
    for (const MaterialName* each :
         {&disks.smallMaterial, &disks.largeMaterial, &couetteIn(setup).cell.wheelMaterial,
          &couetteIn(setup).cell.ringMaterial})
      text += fmt::format(" {};", std::ranges::find(setup.materials->names, each->name) -
                                      setup.materials->names.begin());
  }
  if (setup.bottom)
    text += fmt::format("bottom {} {} {} {} {} {};", setup.bottom->mu, setup.bottom->kb,
                        setup.bottom->gb, setup.bottom->tauM, setup.bottom->gravity,
                        setup.bottom->spin);
  const Cell& cell = couetteIn(setup).cell;
  text += fmt::format("cell {} {} {} {} {} {};", cell.innerRadius, cell.outerRadius,
                      cell.wallRadius, wallDiskCount(cell, cell.innerRadius),
                      wallDiskCount(cell, cell.outerRadius), cell.omega);
  const Particles& disks = couetteIn(setup).particles;
  text += fmt::format("disks {} {} {} {} {} {} {};", disks.small, disks.large, disks.smallRadius,
                      disks.largeRadius, disks.smallMass, disks.largeMass, disks.inertiaFactor);
  if (!disks.rotation) text += "no rotation;";
  const Filling& how = couetteIn(setup).filling;
  text += fmt::format("prepare {} {} {} {} {}", setup.preparation.seed, how.dilation, how.velocity,
                      how.shrinkTime, how.rotations);
  if (const std::string who = preparerKey(setup); !who.empty()) text += "; engine " + who;
  if (index > 0) text += fmt::format("; stream {}", index);
  return fmt::format("{:016x}", fnv1a(text));
}

void writePacking(const Packing& packing, const std::filesystem::path& file) {
  makeDirectory(file.parent_path());
  Hdf5File out = Hdf5File::create(file);
  const Disks& disks = packing.disks;
  out.write("radius", disks.radius);
  out.write("mass", disks.mass);
  out.write("inertia", disks.inertia);
  out.write("position", disks.position.front().data(), disks.size(), 2);
  out.write("velocity", disks.velocity.front().data(), disks.size(), 2);
  out.write("spin", disks.spin);
  out.writeAttribute("wheel_angle", packing.wheelAngle);
  out.writeAttribute("hash", packing.hash);
  out.writeChecksum();
  out.save();
}

namespace {

template <int D>
Packing readPackingFile(const std::filesystem::path& file, const DiskDefaults& defaults) {
  constexpr unsigned vector = D, spins = D == 2 ? 1 : 3;  // columns
  const auto bad = [&](const std::string& what) {
    return BadInput(fmt::format("{}: {}", file.string(), what));
  };
  const Hdf5File in = Hdf5File::open(file);
  for (const auto& [name, columns] : {std::pair{"radius", 1u},
                                      {"position", vector},
                                      {"velocity", vector},
                                      {"spin", spins},
                                      {"mass", 1u},
                                      {"inertia", 1u}})
    if (const auto count = in.length(name); count && *count > columns * defaults.most)
      throw bad(fmt::format("{} has {} values: a case may have at most {} disks", name, *count,
                            defaults.most));
  const auto radius = in.read("radius");
  const auto position = in.read("position");
  if (!radius || !position)
    throw bad(fmt::format("a packing needs the datasets radius (N) and position (N x {})", D));
  const std::size_t count = radius->size();
  if (count == 0) throw bad("the packing has no disks");
  const auto sized = [&](const char* name, std::size_t columns) {
    auto values = in.read(name);
    if (values && values->size() != columns * count)
      throw bad(fmt::format("{} has {} values for {} disks; {} are needed", name, values->size(),
                            count, columns * count));
    for (std::size_t k = 0; values && k < values->size(); ++k)
      if (!std::isfinite((*values)[k]))
        throw bad(fmt::format("{} of disk {} is not finite", name, k / columns));
    return values;
  };

  const auto checkPositive = [&](const std::vector<double>& values, const char* what,
                                 const char* unit) {
    for (std::size_t i = 0; i < count; ++i)
      if (!(values[i] > 0.0))
        throw bad(
            fmt::format("the {} of disk {} is {} {}; it must be > 0", what, i, values[i], unit));
  };

  Packing packing;
  DisksOf<D>& disks = disksIn<D>(packing);
  disks.radius = *sized("radius", 1);
  checkPositive(disks.radius, "radius", "m");
  const auto orZero = [&](const char* name, unsigned columns) {
    return sized(name, columns).value_or(std::vector<double>(columns * count, 0.0));
  };
  disks.position = asVectors<D>(*sized("position", vector));
  disks.velocity = asVectors<D>(orZero("velocity", vector));
  disks.spin = asSpins<D>(orZero("spin", spins));
  if (auto mass = sized("mass", 1))
    disks.mass = std::move(*mass);
  else
    std::ranges::transform(disks.radius, std::back_inserter(disks.mass), defaults.mass);
  checkPositive(disks.mass, "mass", "kg");
  if (auto inertia = sized("inertia", 1))
    disks.inertia = std::move(*inertia);
  else
    for (std::size_t i = 0; i < count; ++i)
      disks.inertia.push_back(defaults.inertiaFactor * disks.mass[i] * disks.radius[i] *
                              disks.radius[i]);
  checkPositive(disks.inertia, "moment of inertia", "kg m²");
  packing.wheelAngle = in.readAttribute("wheel_angle").value_or(0.0);
  if (!std::isfinite(packing.wheelAngle)) throw bad("wheel_angle is not finite");
  packing.hash = in.readTextAttribute("hash").value_or("");
  packing.asWritten = in.isAsWritten();
  return packing;
}

}  // namespace

Packing readPacking(const std::filesystem::path& file, const Case& setup, std::size_t most) {
  const Particles& kinds = couetteIn(setup).particles;
  const double border = 0.5 * (kinds.smallRadius + kinds.largeRadius);
  return readPacking(
      file, {[&](double radius) { return radius < border ? kinds.smallMass : kinds.largeMass; },
             kinds.inertiaFactor, most});
}

std::optional<Packing> keptPacking(const std::filesystem::path& file, const std::string& hash,
                                   const Case& setup, std::string& why, std::size_t most) {
  if (fileFault(file) == noSuchFile) return std::nullopt;
  try {
    Packing packing = readPacking(file, setup, most);
    packing.fromCache = true;
    if (packing.asWritten && packing.hash == hash) return packing;
    why = fmt::format("{}: {}", file.string(),
                      packing.asWritten ? "is another packing"
                                        : "is not what was kept, or of an earlier version");
  } catch (const BadInput& damaged) {
    why = damaged.what();
  }
  return std::nullopt;
}

template <int D>
Packing readPacking(const std::filesystem::path& file, const DiskDefaults& defaults) {
  tryReading(file, [&] { readPackingFile<D>(file, defaults); });
  try {
    return readPackingFile<D>(file, defaults);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {  // what HDF5 makes of a damaged file
    throw BadInput(error.what());
  }
}
template Packing readPacking<2>(const std::filesystem::path&, const DiskDefaults&);
template Packing readPacking<3>(const std::filesystem::path&, const DiskDefaults&);

}  // namespace crossgrain::inline cases
