// Profiles across a shear between two bumpy walls, of MercuryDPM's result files: those of ON-DEM's
// benchmark, which are not kept here (docs/dimensions.md has where they are and what comes out).
//
//   shear_profiles WALL_SPHERES FILE.data.0017 FILE.fstat.0017
//
// The first WALL_SPHERES rows are those of the walls; x and y are periodic over the file's box. Ten
// slabs between the tops of the walls' spheres, by exact volumes.
#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <span>
#include <string>

#include "adapters/files/readers.hpp"
#include "averaging/profiles.hpp"

namespace {

using namespace crossgrain;

int profiles(std::size_t walls, const files::Files& of) {
  const auto frame = files::openMercuryDpm(of, {})->next();
  if (!frame || !frame->box || frame->particles.size() <= walls || walls == 0) {
    fmt::print(stderr, "{}: no time with a box and more than {} spheres\n", of.front().string(),
               walls);
    return 2;
  }
  const files::FileParticles& all = frame->particles;
  SpaceScene scene;
  SpaceSnapshot now;
  Vec3 low = frame->box->low, high = frame->box->high;
  auto& wall = scene.bodies.emplace_back();
  std::vector<std::int32_t> idOfRow(all.size());
  double floor = 1e300, ceiling = -1e300;
  const auto count = static_cast<std::int32_t>(all.size() - walls);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool moves = k >= walls;
    const auto row = static_cast<std::int32_t>(k), fixed = static_cast<std::int32_t>(walls);
    idOfRow[k] = moves ? row - fixed : count + row;
    if (!moves) {
      wall.diskRadius.push_back(all.radius[k]);
      wall.diskPosition.push_back(all.position[k]);
      floor = std::min(floor, all.position[k].z());
      ceiling = std::max(ceiling, all.position[k].z());
      continue;
    }
    const double a = all.radius[k];
    scene.disks.radius.push_back(a);
    scene.disks.mass.push_back(4.0 / 3.0 * 3.14159265358979324 * a * a * a);
    now.position.push_back(all.position[k]);
    now.velocity.push_back(all.velocity[k]);
  }
  low.z() = floor + all.radius.front();
  high.z() = ceiling - all.radius.front();
  scene.box = BoxOf<3>{low, high, {true, true, false}};
  if (frame->contacts) {
    auto& contacts = now.contacts.emplace();
    for (std::size_t c = 0; c < frame->contacts->size(); ++c) {
      auto i = idOfRow[static_cast<std::size_t>(frame->contacts->first[c])];
      auto j = idOfRow[static_cast<std::size_t>(frame->contacts->second[c])];
      const double sign = i < j ? 1.0 : -1.0;
      if (i > j) std::swap(i, j);
      if (i >= count) continue;  // of the walls with themselves
      const Vec3 n = sign * frame->contacts->normal[c], f = sign * frame->contacts->force[c];
      contacts.i.push_back(i);
      contacts.j.push_back(j);
      contacts.normal.push_back(n);
      contacts.overlap.push_back(frame->contacts->overlap[c]);
      contacts.normalForce.push_back(f.dot(n));
      contacts.tangentialForce.push_back(f - f.dot(n) * n);
    }
  }
  const auto slabs = std::make_shared<Cells>(low, high, std::array{1, 1, 10}, scene.box, 2);
  ProfileAccumulatorOf<3> average(slabs, {Weight(WeightMethod::slicing)}, scene);
  average.add(now);
  fmt::print("t = {:.6g}, {} contacts, z from {:g} to {:g}\n", *frame->time,
             now.contacts ? now.contacts->size() : 0, low.z(), high.z());
  for (const Profile& profile : average.profiles()) {
    if (profile.field.find("temperature") == std::string::npos &&
        profile.field != "volume_fraction" && profile.field != "velocity_x" &&
        profile.field != "stress_zz" && profile.field != "fluctuation_stress_zz")
      continue;
    fmt::print("{:>22}", profile.field);
    for (const auto& value : profile.mean) fmt::print(" {:9.4f}", value.value_or(NAN));
    fmt::print("\n");
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) try {
  const std::span given(arguments, static_cast<std::size_t>(count));
  if (given.size() < 3) {
    fmt::print(stderr, "usage: shear_profiles WALL_SPHERES FILE.data [FILE.fstat]\n");
    return 2;
  }
  const files::Files of(given.begin() + 2, given.end());
  return profiles(std::strtoul(given[1], nullptr, 10), of);
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
