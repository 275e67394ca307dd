#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "adapters/files/file_snapshots.hpp"
#include "support/bad_input.hpp"

/// Particles that come and go.
namespace crossgrain::files {
namespace {

bool hasSameIds(std::vector<std::int64_t> a, std::vector<std::int64_t> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

/// Whether ids are only the rows' numbers, as in files without ids: a particle that leaves then
/// passes its number on.
bool areRows(const std::vector<std::int64_t>& ids) {
  for (std::size_t row = 0; row < ids.size(); ++row)
    if (ids[row] != static_cast<std::int64_t>(row)) return false;
  return true;
}

/// m/a², in space m/a³, where all have the same to six digits.
template <int D>
std::optional<double> densityOf(const DisksOf<D>& disks) {
  std::optional<double> density;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const double own = disks.mass[k] / std::pow(disks.radius[k], D);
    if (!density) density = own;
    if (!(std::abs(own - *density) <= 1e-5 * *density)) return std::nullopt;
  }
  return density;
}

template <int D>
double inertiaFactorOf(const DisksOf<D>& disks) {
  if (disks.size() == 0) return 0.0;
  return disks.inertia.front() / (disks.mass.front() * disks.radius.front() * disks.radius.front());
}

}  // namespace

/// Of a number of particles that is the case's, the averaged time says which they are; of another
/// one, to which they came before it, the first time of all.
template <int D>
void FileSnapshotsOf<D>::begin() {
  const std::optional<FileFrame> first = std::exchange(first_, std::nullopt);
  const auto has = [&](const FileFrame& frame, const DisksOf<D>& disks) {
    const std::size_t found = frame.particles.size();
    return found > 0 &&
           found == disks.size() + wallRows(frame, units_, target_, timeOf(frame)).size();
  };
  std::pair<SceneOf<D>, DisksOf<D>> open;
  const bool changes = first && target_.open &&
                       !hasSameIds(first->particles.id, pending_->particles.id) &&
                       (open = target_.open(), !has(*pending_, open.second));
  if (!changes) {
    recognise(*pending_);
    fewest_ = most_ = ids_->disks();
    return;
  }
  requireOpen(*pending_, first->particles.size());
  auto& [scene, disks] = open;
  if (has(*first, disks)) {
    recognise(*first);
  } else {
    scene_ = std::move(scene);
    ids_.emplace(std::vector<std::int64_t>(), std::vector<std::size_t>());
    density_ = densityOf<D>(disks);
    inertiaFactor_ = inertiaFactorOf(disks);
    rows_ = true;  // no particle is known by its id
  }
  changeDisks(*pending_);
  if (target_.checkLengths) target_.checkLengths(scene_.disks);
  disksChanged_ = false;
  fewest_ = most_ = ids_->disks();
  cameAndWent_ = true;
}

/// @param before  how many particles there were
template <int D>
void FileSnapshotsOf<D>::requireOpen(const FileFrame& frame, std::size_t before) const {
  if (!target_.needsAll.empty())
    fail(frame, fmt::format("it has other particles than a time before ({} now, {} then), and {}",
                            frame.particles.size(), before, target_.needsAll));
}

/// Records numbering, inertia factor, density and materials by type of the first frame, for later
/// ones.
template <int D>
void FileSnapshotsOf<D>::learn(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  rows_ = areRows(all.id);
  inertiaFactor_ = inertiaFactorOf(scene_.disks);
  density_ = densityOf<D>(scene_.disks);
  if (!scene_.materials || all.kind.empty()) return;
  for (std::size_t row = 0; row < all.size(); ++row)
    if (const std::size_t k = *ids_->ourOf(all.id[row]); k < ids_->disks()) {
      const std::int32_t material = scene_.materials->ofDisk[k];
      const auto [found, isNew] = materialOfKind_.emplace(all.kind[row], material);
      if (found->second != material) found->second = -1;
    }
}

/// Records the disks as they are now, for later times.
template <int D>
void FileSnapshotsOf<D>::remember() {
  if (rows_) return;
  for (std::size_t k = 0; k < ids_->disks(); ++k)
    known_[ids_->theirOf(k)] = {scene_.disks.radius[k], scene_.disks.mass[k],
                                scene_.materials ? scene_.materials->ofDisk[k] : 0};
}

/// The particles of a frame that are no wall disks, each with what is known of it. @pre ids_, rows_
template <int D>
DisksOf<D> FileSnapshotsOf<D>::disksOf(const FileFrame& frame,
                                       std::vector<std::int32_t>& materials) const {
  const FileParticles& all = frame.particles;
  const std::size_t count = ids_->disks();
  DisksOf<D> disks;
  disks.position.resize(count);
  disks.velocity.resize(count, VecOf<D>::Zero());
  disks.spin.assign(count, noSpin<D>());
  for (auto* list : {&disks.radius, &disks.mass, &disks.inertia}) list->resize(count);
  materials.assign(count, 0);
  const auto failNew = [&](std::size_t row, const char* what) {
    fail(frame, fmt::format("particle {} was not there before, and {}", all.id[row], what));
  };
  for (std::size_t row = 0; row < all.size(); ++row) {
    const std::size_t k = *ids_->ourOf(all.id[row]);
    if (k >= count) continue;
    disks.position[k] = units_.length * units_.template along<D>(all.position[row]);
    if (!all.velocity.empty())
      disks.velocity[k] = units_.length / units_.time * units_.template along<D>(all.velocity[row]);
    const auto found = rows_ ? known_.end() : known_.find(all.id[row]);
    if (found != known_.end()) {
      std::tie(disks.radius[k], disks.mass[k], materials[k]) =
          std::tuple(found->second.radius, found->second.mass, found->second.material);
    } else {
      if (all.radius.empty()) failNew(row, "the files have no radii");
      const double a = disks.radius[k] = units_.length * all.radius[row];
      if (!all.mass.empty())
        disks.mass[k] = units_.mass * all.mass[row];
      else if (!density_)
        failNew(row, "the files have no masses; the case's disks are of several densities");
      else
        disks.mass[k] = *density_ * std::pow(a, D);
      if (scene_.materials) {
        const auto ofKind =
            all.kind.empty() ? materialOfKind_.end() : materialOfKind_.find(all.kind[row]);
        if (ofKind == materialOfKind_.end() || ofKind->second < 0)
          failNew(row, "its type is not that of one material alone of those that were");
        materials[k] = ofKind->second;
      }
    }
    disks.inertia[k] = inertiaFactor_ * disks.mass[k] * disks.radius[k] * disks.radius[k];
  }
  return disks;
}

/// The frame has other particles than the one before.
template <int D>
void FileSnapshotsOf<D>::changeDisks(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  requireOpen(frame, ids_->size());
  if (all.size() > 0) checkParticles(frame, units_, target_.box);
  std::vector<std::int64_t> sorted = all.id;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    fail(frame, describeTwice(all, *twice));
  remember();
  const ParticleIds before = *ids_;
  const bool identified = !rows_ && !areRows(all.id);
  rows_ = areRows(all.id);
  ids_.emplace(all.id, all.size() == 0 ? std::vector<std::size_t>()
                                       : wallRows(frame, units_, target_, timeOf(frame)));
  std::vector<std::optional<std::size_t>> then(ids_->disks());
  for (std::size_t k = 0; k < then.size() && identified; ++k)
    if (const auto found = before.ourOf(ids_->theirOf(k)); found && *found < before.disks())
      then[k] = found;
  cameAndWent_ = true;
  displacements_.changeDisks(then);
  if (!lastPlaces_.empty()) {
    std::vector<VecOf<D>> places;
    for (const auto& k : then)
      places.push_back(k ? lastPlaces_[*k] : VecOf<D>(VecOf<D>::Constant(NAN)));
    lastPlaces_ = std::move(places);
  }
  std::vector<std::int32_t> materials;
  scene_.disks = disksOf(frame, materials);
  if (scene_.materials) scene_.materials->ofDisk = std::move(materials);
  scene_.bodies = target_.bodies;
  settleBasis();
  fewest_ = std::min(fewest_, ids_->disks());
  most_ = std::max(most_, ids_->disks());
  disksChanged_ = true;
}

template void FileSnapshotsOf<2>::begin();
template void FileSnapshotsOf<3>::begin();
template void FileSnapshotsOf<2>::learn(const FileFrame&);
template void FileSnapshotsOf<3>::learn(const FileFrame&);
template void FileSnapshotsOf<2>::changeDisks(const FileFrame&);
template void FileSnapshotsOf<3>::changeDisks(const FileFrame&);

}  // namespace crossgrain::files
