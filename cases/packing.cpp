#include "cases/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "adapters/law_options.hpp"
#include "cases/couette.hpp"
#include "cases/preparer.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/hdf5_file.hpp"
#include "support/hdf5_trial.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cases {
namespace {

std::vector<Vec2> asVectors(const std::vector<double>& values) {
  std::vector<Vec2> vectors;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2)
    vectors.emplace_back(values[i], values[i + 1]);
  return vectors;
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
  std::string hash = fmt::format("{:016x} {}", fnv1a(bytes), packing.wheelAngle);
  if (packing.wallTime != 0.0) hash += fmt::format(" {}", packing.wallTime);
  if (!packing.fixed.empty()) hash += " fixed " + packing.fixed;
  return hash;
}

std::string packingHash(const Case& setup, int index, double dt) {
  // The leading tag changes whenever the preparation itself does.
  std::string text = fmt::format("preparation 2; dt {};", setup.preparation.dt.value_or(dt));
  const ContactLaw& law = setup.law;
  for (const LawOption& option : lawOptions())
    text += fmt::format("{} {};", option.name, option.values[option.get(law)]);
  text += "law";
  for (const LawConstant& constant : lawConstants())
    text += fmt::format(" {}", law.*constant.value);
  text += ';';
  if (setup.bottom)
    text += fmt::format("bottom {} {} {} {} {} {};", setup.bottom->mu, setup.bottom->kb,
                        setup.bottom->gb, setup.bottom->tauM, setup.bottom->gravity,
                        setup.bottom->spin);
  const Cell& cell = setup.cell;
  text += fmt::format("cell {} {} {} {} {} {};", cell.innerRadius, cell.outerRadius,
                      cell.wallRadius, wallDiskCount(cell, cell.innerRadius),
                      wallDiskCount(cell, cell.outerRadius), cell.omega);
  const Particles& disks = setup.particles;
  text += fmt::format("disks {} {} {} {} {} {} {};", disks.small, disks.large, disks.smallRadius,
                      disks.largeRadius, disks.smallMass, disks.largeMass, disks.inertiaFactor);
  if (!disks.rotation) text += "no rotation;";
  const Preparation& how = setup.preparation;
  text += fmt::format("prepare {} {} {} {} {}", how.seed, how.dilation, how.velocity,
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

Packing readPackingFile(const std::filesystem::path& file, const DiskDefaults& defaults) {
  const auto bad = [&](const std::string& what) {
    return BadInput(fmt::format("{}: {}", file.string(), what));
  };
  const Hdf5File in = Hdf5File::open(file);
  for (const auto& [name, columns] : {std::pair{"radius", 1u},
                                      {"position", 2u},
                                      {"velocity", 2u},
                                      {"spin", 1u},
                                      {"mass", 1u},
                                      {"inertia", 1u}})
    if (const auto count = in.length(name); count && *count > columns * defaults.most)
      throw bad(fmt::format("{} has {} values: a case may have at most {} disks", name, *count,
                            defaults.most));
  const auto radius = in.read("radius");
  const auto position = in.read("position");
  if (!radius || !position)
    throw bad("a packing needs the datasets radius (N) and position (N x 2)");
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

  Packing packing;
  Disks& disks = packing.disks;
  disks.radius = *sized("radius", 1);
  disks.position = asVectors(*sized("position", 2));
  const auto velocity = sized("velocity", 2);
  disks.velocity = velocity ? asVectors(*velocity) : std::vector<Vec2>(count, Vec2::Zero());
  disks.spin = sized("spin", 1).value_or(std::vector<double>(count, 0.0));
  for (std::size_t i = 0; i < count; ++i)
    if (!(disks.radius[i] > 0.0))
      throw bad(fmt::format("the radius of disk {} is {} m; it must be > 0", i, disks.radius[i]));
  if (auto mass = sized("mass", 1))
    disks.mass = std::move(*mass);
  else
    std::ranges::transform(disks.radius, std::back_inserter(disks.mass), defaults.mass);
  std::vector<double> inertia(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(disks.mass[i] > 0.0))
      throw bad(fmt::format("the mass of disk {} is {} kg; it must be > 0", i, disks.mass[i]));
    inertia[i] = defaults.inertiaFactor * disks.mass[i] * disks.radius[i] * disks.radius[i];
  }
  disks.inertia = sized("inertia", 1).value_or(inertia);
  for (std::size_t i = 0; i < count; ++i)
    if (!(disks.inertia[i] > 0.0))
      throw bad(fmt::format("the moment of inertia of disk {} is {} kg m²; it must be > 0", i,
                            disks.inertia[i]));
  packing.wheelAngle = in.readAttribute("wheel_angle").value_or(0.0);
  if (!std::isfinite(packing.wheelAngle)) throw bad("wheel_angle is not finite");
  packing.hash = in.readTextAttribute("hash").value_or("");
  packing.asWritten = in.isAsWritten();
  return packing;
}

}  // namespace

Packing readPacking(const std::filesystem::path& file, const Case& setup, std::size_t most) {
  const Particles& kinds = setup.particles;
  const double border = 0.5 * (kinds.smallRadius + kinds.largeRadius);
  return readPacking(
      file, {[&](double radius) { return radius < border ? kinds.smallMass : kinds.largeMass; },
             kinds.inertiaFactor, most});
}

std::optional<Packing> keptPacking(const std::filesystem::path& file, const std::string& hash,
                                   const Case& setup, std::string& why, std::size_t most) {
  if (whyNoFile(file) == noSuchFile) return std::nullopt;
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

Packing readPacking(const std::filesystem::path& file, const DiskDefaults& defaults) {
  tryReading(file, [&] { readPackingFile(file, defaults); });
  try {
    return readPackingFile(file, defaults);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {  // what HDF5 makes of a damaged file
    throw BadInput(error.what());
  }
}

}  // namespace crossgrain::inline cases
