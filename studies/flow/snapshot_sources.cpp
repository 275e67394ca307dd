#include "studies/flow/snapshot_sources.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/files/file_snapshots.hpp"
#include "adapters/registry.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "studies/flow/snapshot_fit.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

std::string SnapshotRun::name() const {
  return files.size() == 1 ? files.front().string()
                           : fmt::format("{} … ({} files)", files.front().string(), files.size());
}

std::string CoveredTime::gap() const {
  if (times_.empty()) return {};
  constexpr double rounding = 1e-3;  // of the spacing, by which times of few digits are off
  std::vector<double> apart;
  for (std::size_t k = 1; k < times_.size(); ++k) apart.push_back(times_[k] - times_[k - 1]);
  double due = wanted_.interval;
  std::size_t widest = 0;
  if (!apart.empty()) {
    widest = static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin());
    std::vector<double> sorted = apart;
    std::ranges::nth_element(sorted,
                             sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2));
    due = std::max(due, sorted[sorted.size() / 2]);
  }
  const double first = times_.front(), last = times_.back();
  const auto said = [&](const std::string& what) {
    return fmt::format("{}; the case averages {:.6g} to {:.6g} s", what, wanted_.settled,
                       wanted_.end());
  };
  // The first is due one interval after the beginning, the last at the end.
  if (first - wanted_.settled > (1.0 + rounding) * due ||
      wanted_.end() - last > (1.0 - rounding) * due)
    return said(apart.empty() ? fmt::format("a single snapshot, of {:.6g} s", first)
                              : fmt::format("{} snapshots cover {:.6g} to {:.6g} s", times_.size(),
                                            first, last));
  if (!apart.empty() && apart[widest] > 2.0 * (1.0 - rounding) * due)
    return said(
        fmt::format("no snapshot between {:.6g} and {:.6g} s", times_[widest], times_[widest + 1]));
  return {};
}

namespace {

/// A file that is read twice would count as two runs, or as two times of one.
void requireDifferent(const std::vector<fs::path>& files) {
  std::map<std::pair<dev_t, ino_t>, fs::path> seen;
  for (const fs::path& file : files) {
    struct stat there {};
    if (::stat(file.c_str(), &there) != 0) continue;  // said where it is read
    const auto [first, isNew] = seen.emplace(std::pair(there.st_dev, there.st_ino), file);
    if (isNew) continue;
    const fs::path& other = first->second;
    throw BadInput(file == other
                       ? fmt::format("{}: the file is named twice", file.string())
                       : fmt::format("{} and {} are the same file", other.string(), file.string()));
  }
}

/// Of a file that is none of other programs', HDF5 says what is wrong with it.
std::string formatOfFile(const fs::path& file) {
  if (!fs::is_regular_file(file)) return {};
  const auto found = files::formatOf(file);
  if (!found && !files::isHdf5(file) && fs::file_size(file) > 0)
    throw BadInput(
        fmt::format("{}: is no HDF5 file, and begins as no result file does that is read ({})",
                    file.string(), fmt::join(files::fileFormats(), ", ")));
  return found ? std::string(*found) : std::string();
}

}  // namespace

std::vector<SnapshotRun> snapshotRuns(const std::vector<fs::path>& files,
                                      const std::string& format) {
  requireDifferent(files);
  std::vector<SnapshotRun> runs;
  std::vector<std::pair<std::string, std::vector<fs::path>>> byFormat;
  for (const fs::path& file : files) {
    if (files::isBesideResults(file, files)) continue;
    const std::string own = format.empty() ? formatOfFile(file) : format;
    if (own.empty()) {
      runs.push_back({own, {file}});
      continue;
    }
    auto group =
        std::ranges::find(byFormat, own, &std::pair<std::string, std::vector<fs::path>>::first);
    if (group == byFormat.end()) group = byFormat.insert(byFormat.end(), {own, {}});
    group->second.push_back(file);
  }
  for (const auto& [own, group] : byFormat)
    for (auto& run : files::runsOf(own, group)) runs.push_back({own, std::move(run)});
  for (SnapshotRun& run : runs)
    std::ranges::copy_if(files, std::back_inserter(run.besides), [&](const fs::path& file) {
      return files::isBesideResults(file, run.files);
    });
  return runs;
}

std::string defaultName(const std::string& format) {
  return findEngine(format) ? format + "-files" : format;  // that section is the engine's
}

namespace {

/// Disks of files without radii have the case's, in its order.
template <int D>
std::vector<double> radiiOf(const Case& setup, const SnapshotOrigin& origin) {
  if (const Couette* const cell = cellOf(setup)) return diskKinds(cell->particles).radius;
  for (const DiskGroupOf<D>& group : assemblyIn<D>(setup).disks)
    if (group.radiusSpread > 0.0)
      throw BadInput(fmt::format(
          "{}: there are no radii in the files, and those of the case are drawn by chance",
          origin.name));
  return assemblyDisks<D>(setup, 0).radius;
}

/// The largest disk of the case, and how far one lies from the origin at its start [m].
template <int D>
std::pair<double, double> scalesOf(const Case& setup) {
  if (const Couette* const source = cellOf(setup))
    return {std::max(source->particles.smallRadius, source->particles.largeRadius),
            source->cell.outerRadius};
  const DisksOf<D> disks = assemblyDisks<D>(setup, 0);
  double farthest = 0.0;
  for (const VecOf<D>& x : disks.position) farthest = std::max(farthest, x.norm());
  return {std::ranges::max(disks.radius), farthest};
}

/// Ten times off is no motion but a unit.
template <int D>
void checkLengths(const Case& setup, const DisksOf<D>& disks, const SnapshotOrigin& origin) {
  const auto [radius, farthest] = scalesOf<D>(setup);
  const auto check = [&](const char* what, double found, double target, double gross) {
    if (found < gross * target && found > target / gross) return;
    throw BadInput(fmt::format("{} does not fit {}: {} {:.4g} m, in the case {:.4g} m{}",
                               origin.name, setup.file.string(), what, found, target,
                               unitHint(found, target, "length", origin)));
  };
  if (disks.size() > 0) check("the largest radius is", std::ranges::max(disks.radius), radius, 5.0);
  double reach = 0.0;
  for (const VecOf<D>& x : disks.position) reach = std::max(reach, x.norm());
  // Of what lies about the origin nothing can be said; and disks may fly.
  if (farthest > radius) check("disks lie up to", reach, farthest, 100.0);
}

/// Disks of the files in the scene of the case. Masses of six digits are the case's.
template <int D>
SceneOf<D> sceneOf(const Case& setup, DisksOf<D> disks, const SnapshotOrigin& origin) {
  constexpr double sameMass = 1e-4;
  if (disks.radius.empty()) {
    disks.radius = radiiOf<D>(setup, origin);
    disks.radius.resize(disks.position.size(), disks.radius.back());  // the number is checked below
  }
  checkLengths(setup, disks, origin);
  const bool ownMasses = !disks.mass.empty() && (packingFile(setup) != nullptr);
  disks.mass.resize(disks.size(), 0.0);
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const double mass = massOf<D>(setup, k, disks.radius[k]);
    double& found = disks.mass[k];
    if (!ownMasses && (found == 0.0 || std::abs(found - mass) <= sameMass * mass)) found = mass;
    const double factor = inertiaFactorOf(setup);
    disks.inertia.push_back(factor * found * disks.radius[k] * disks.radius[k]);
  }
  SnapshotOf<D> first;
  first.position = disks.position;
  SceneOf<D> scene = sceneAround<D>(setup, std::move(disks), origin);
  placeWallsAsPrescribed(scene, 0.0, first);
  requireFit<D>(scene, first, setup, origin);
  return scene;
}

/// Reason why each particle is needed from the start on; empty: nothing.
std::string needOfAll(const Case& setup) {
  if (cellOf(setup)) return "a cell keeps its disks";
  for (const Endpoint& own : setup.endpoints)
    if (own.disk)
      return fmt::format(
          "the endpoint {} is of disk {}, which is known where all that the case begins with are "
          "there throughout",
          own.name, *own.disk);
  return {};
}

/// The case's scene without disks.
template <int D>
SceneOf<D> wallsOf(const Case& setup) {
  return flowScene<D>(setup, Packing(), 0.0);
}

double stepOf(const Case& setup) {
  return packingFile(setup) ? setup.run.dt.value_or(0.0) : timeStep(setup);
}

template <int D>
Settings fileSettingsOf(const SnapshotRun& run, const Case& setup, const std::string& name) {
  Capabilities settable;
  settable.settings = files::fileSettings(run.format, D);
  return settingsFor(setup, name, settable);
}

/// @param box  of the case
template <int D>
files::FileOptions fileOptionsOf(const Settings& settings, const files::FileUnits& units,
                                 const std::optional<BoxOf<D>>& box) {
  files::FileOptions options;
  if (const auto columns = settings.find("columns"); columns != settings.end())
    options.columns = std::get<std::string>(columns->second);
  if (box) options.box = files::boxInFiles(*box, units);
  return options;
}

/// Numbers that six digits of either leave apart.
bool alike(std::span<const double> a, std::span<const double> b) {
  constexpr double ofNumber = 1e-5, ofLargest = 1e-6;
  if (a.size() != b.size()) return false;
  double largest = 0.0;
  for (const double value : a) largest = std::max(largest, std::abs(value));
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!(std::abs(a[k] - b[k]) <= ofNumber * std::abs(a[k]) + ofLargest * largest)) return false;
  return true;
}

template <typename Vector>
bool alike(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  const auto flat = [](const std::vector<Vector>& all) {
    return std::span(all.empty() ? nullptr : all.front().data(),
                     all.size() * static_cast<std::size_t>(Vector::SizeAtCompileTime));
  };
  return alike(flat(a), flat(b));
}

/// Forces as sums: contacts that only rounding makes may be in one of both.
template <int D>
bool alike(const SnapshotOf<D>& a, const SnapshotOf<D>& b) {
  const auto sums = [](const SnapshotOf<D>& snapshot) {
    std::vector<double> sum;
    if (!snapshot.contacts) return sum;
    sum.assign(2, 0.0);
    for (const double f : snapshot.contacts->normalForce) sum[0] += f;
    for (const auto& f : snapshot.contacts->tangentialForce) sum[1] += crossgrain::sizeOf(f);
    return sum;
  };
  const std::vector<double> ofA = sums(a), ofB = sums(b);
  return alike(a.position, b.position) && alike(a.velocity, b.velocity) &&
         alike(std::span<const double>(ofA), std::span<const double>(ofB));
}

/// Places and velocities of the first time that a run's files have, by rising id: whether it may be
/// a copy is known from them without reading on to what is averaged.
struct Beginning {
  std::vector<files::Vec3> position, velocity;
};

template <int D>
Beginning beginningOf(const SnapshotRun& run, const Case& setup, const std::string& name) {
  Beginning found;
  const auto add = [](const VecOf<D>& v) {
    files::Vec3 padded = files::Vec3::Zero();
    padded.head<D>() = v;
    return padded;
  };
  if (run.format.empty()) {
    const SnapshotOf<D> first = SnapshotReaderOf<D>(run.files.front(), setup).read(0);
    for (const VecOf<D>& x : first.position) found.position.push_back(add(x));
    for (const VecOf<D>& v : first.velocity) found.velocity.push_back(add(v));
    return found;
  }
  const Settings settings = fileSettingsOf<D>(run, setup, name);
  const auto options =
      fileOptionsOf<D>(settings, files::fileUnits(run.format, settings), wallsOf<D>(setup).box);
  const auto frame = files::openFrames(run.format, run.files, options)->next();
  if (!frame) return found;
  const files::FileParticles& all = frame->particles;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t row) { return all.id[row]; });
  for (const std::size_t row : order) {
    found.position.push_back(all.position[row]);
    if (!all.velocity.empty()) found.velocity.push_back(all.velocity[row]);
  }
  return found;
}

/// Whether all averaged snapshots of both are alike.
template <int D>
bool alikeToTheEnd(const SnapshotRun& a, const SnapshotRun& b, const Case& setup,
                   const std::function<std::string(const SnapshotRun&)>& nameOf) {
  const auto first = openSnapshots<D>(a, setup, nameOf(a));
  const auto second = openSnapshots<D>(b, setup, nameOf(b));
  for (;;) {
    throwIfInterrupted();
    const auto one = first->next(), other = second->next();
    if (!one || !other) return !one && !other;
    if (!alike(*one, *other)) return false;
  }
}

/// "[engines.mine]", and where the case has no such section, which ones it has.
std::string sectionWords(const Case& setup, const std::string& name) {
  std::string words = fmt::format("[engines.{}]", name);
  std::vector<std::string> others;
  for (const auto& [other, settings] : setup.engines)
    if (!findEngine(other)) others.push_back(other);
  if (setup.engines.contains(name) || others.empty()) return words;
  return fmt::format("{}, which the case does not have: it has settings of {}", words,
                     fmt::join(others, ", "));
}

}  // namespace

template <int D>
std::unique_ptr<SnapshotSourceOf<D>> openSnapshots(const SnapshotRun& run, const Case& setup,
                                                   const std::string& name) {
  if (run.format.empty()) return openSnapshotFile<D>(run.files.front(), setup);
  const Settings settings = fileSettingsOf<D>(run, setup, name);
  const files::FileUnits units = files::fileUnits(run.format, settings);
  const SnapshotOrigin origin{run.name(), fmt::format("[engines.{}]", name), units.length,
                              units.mass};
  const FlowTimes times = flowTimes(setup);
  files::FileSceneOf<D> target;
  target.name = name;
  target.where = sectionWords(setup, name);
  const SceneOf<D> walls = wallsOf<D>(setup);
  if (!walls.shapes.empty())
    throw BadInput(fmt::format(
        "{}: of files of other programs disks and spheres are read, and {} has convex bodies",
        run.name(), setup.file.string()));
  target.bodies = walls.bodies;
  target.box = walls.box;
  target.anyAngle = cellOf(setup) != nullptr;
  target.around = [setup, origin](DisksOf<D> disks) {
    return sceneOf<D>(setup, std::move(disks), origin);
  };
  if (isAssembly(setup)) {
    target.open = [setup] { return std::pair(wallsOf<D>(setup), assemblyDisks<D>(setup, 0)); };
    target.checkLengths = [setup, origin](const DisksOf<D>& disks) {
      checkLengths<D>(setup, disks, origin);
    };
  }
  target.needsAll = needOfAll(setup);
  target.from = times.settled;
  target.to = times.end();
  target.dt = stepOf(setup);
  target.gravity = walls.gravity;
  if (!run.besides.empty()) {
    std::vector<std::string> names;
    for (const fs::path& file : run.besides) names.push_back(file.filename().string());
    target.remarks = {
        fmt::format("not read, as nothing in them is averaged: {}", fmt::join(names, ", "))};
  }
  const files::FileOptions options = fileOptionsOf<D>(settings, units, target.box);
  return std::make_unique<files::FileSnapshotsOf<D>>(
      files::openFrames(run.format, run.files, options), units, std::move(target));
}

DistinctRuns distinctRuns(const std::vector<SnapshotRun>& runs, const Case& setup,
                          const std::function<std::string(const SnapshotRun&)>& nameOf) {
  DistinctRuns distinct;
  if (runs.size() < 2) {
    if (!runs.empty()) distinct.kept.push_back(0);
    return distinct;
  }
  inDimensionOf(setup, [&]<int D>() {
    // Of those that are kept a sample, which takes no memory to speak of.
    constexpr std::size_t most = 1000;
    std::vector<Beginning> beginnings;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      Beginning own = beginningOf<D>(runs[k], setup, nameOf(runs[k]));
      for (auto* list : {&own.position, &own.velocity}) list->resize(std::min(list->size(), most));
      const auto isCopyOf = [&](std::size_t j) {
        return alike(own.position, beginnings[j].position) &&
               alike(own.velocity, beginnings[j].velocity) &&
               alikeToTheEnd<D>(runs[distinct.kept[j]], runs[k], setup, nameOf);
      };
      std::size_t j = 0;
      while (j < beginnings.size() && !isCopyOf(j)) ++j;
      if (j < beginnings.size()) {
        distinct.remarks.push_back(fmt::format(
            "{} has the snapshots of {}, at least to rounding: both are one run, and the former is "
            "left out",
            runs[k].name(), runs[distinct.kept[j]].name()));
        continue;
      }
      distinct.kept.push_back(k);
      beginnings.push_back(std::move(own));
    }
  });
  return distinct;
}

template std::unique_ptr<SnapshotSource> openSnapshots(const SnapshotRun&, const Case&,
                                                       const std::string&);
template std::unique_ptr<SnapshotSourceOf<3>> openSnapshots(const SnapshotRun&, const Case&,
                                                            const std::string&);

}  // namespace crossgrain::inline studies
