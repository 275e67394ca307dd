#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "adapters/files/write_snapshots.hpp"
#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "studies/core/executor.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline cli {
namespace {

/// The averaged box; of a Couette cell, and of rings, the square around the outermost.
files::WrittenBox boxOf(const Case& setup) {
  const auto around = [](double reach, double height) {
    return files::WrittenBox{Vec2(-reach, -reach), Vec2(reach, reach), height};
  };
  if (const Couette* const source = cellOf(setup))
    return around(source->cell.outerRadius + source->cell.wallRadius, source->cell.height);
  const Region& region = *setup.region;
  if (region.hasRings()) return around(region.outerRadius, region.height);
  return {region.low.head<2>(), region.high.head<2>(), region.height};
}

/// The averaged files lie in it.
BoxOf<3> boxInSpace(const Region& region) {
  if (!region.hasRings()) return {region.low, region.high};
  const double reach = region.outerRadius;
  return {{-reach, -reach, region.low.z()}, {reach, reach, region.high.z()}};
}

Case flowCase(const CommandLine& line) {
  const std::string file = line.inputs.front().string();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (!hasFlow(cases.front()))
    throw BadInput(fmt::format(
        "{}: says no box that snapshots are of: export takes a cell, or an assembly with [average]",
        file));
  if (cases.size() > 1)
    throw BadInput(fmt::format("{}: export takes a case without variants", file));
  return cases.front();
}

void requireFormat(const std::string& format) {
  const auto formats = files::writtenFormats();
  if (std::ranges::find(formats, format) == formats.end())
    throw BadInput(
        fmt::format("format {}: there are {} to write", format, fmt::join(formats, ", ")));
}

/// Existing files are not replaced.
void requireNew(const std::vector<std::filesystem::path>& written) {
  for (const std::filesystem::path& file : written)
    if (std::filesystem::exists(file))
      throw BadInput(fmt::format("--out: {} is there already, and is not replaced: name others",
                                 file.string()));
}

auto writerOf(const std::string& format, const std::string& out, const Scene& scene,
              const Case& setup) {
  return files::openWriter(format, out, scene, boxOf(setup));
}
auto writerOf(const std::string& format, const std::string& out, const SpaceScene& scene,
              const Case& setup) {
  return files::openWriter(format, out, scene, scene.box.value_or(boxInSpace(*setup.region)));
}

template <int D>
int exportSnapshots(const CommandLine& line, const Case& setup, const std::string& format,
                    const std::string& snapshots, const std::string& out) {
  const auto reader = openSnapshotFile<D>(snapshots, setup);
  reader->takeAll();
  const auto written = files::writtenFiles(format, out, reader->count());
  requireNew(written);
  std::vector<std::string> names;
  for (const std::filesystem::path& file : written) names.push_back(file.string());
  if (line.run.dryRun)
    return printPlanned(line, fmt::format("would write {} snapshots to {}", reader->count(),
                                          fmt::join(names, ", ")));
  const auto writer = writerOf(format, out, reader->scene(), setup);
  Progress progress(line.run.quiet);
  progress.begin("writing snapshots", {1.0});
  std::optional<double> first;
  double last = 0.0;
  while (const auto snapshot = reader->next()) {
    throwIfInterrupted();
    last = snapshot->positionTime;
    if (!first) first = last;
    writer->write(*snapshot);
    progress.update(0, out, reader->progress());
  }
  writer->close();
  progress.finish(0, out);
  if (line.json) {
    printJson({{"files", names},
               {"engine", reader->engine()},
               {"snapshots", reader->count()},
               {"from_s", first.value_or(last)},
               {"to_s", last},
               {"not_written", writer->notWritten()}});
    return exitPassed;
  }
  constexpr std::size_t mostNames = 3;
  if (names.size() > mostNames) names = {names.front() + " …"};
  fmt::print("{}: {} snapshots of {}, t = {:g} to {:g} s\n", fmt::join(names, ", "),
             reader->count(), reader->engine(), first.value_or(last), last);
  for (const std::string& what : writer->notWritten()) fmt::print("  not in them: {}\n", what);
  return exitPassed;
}

int exportSnapshots(const CommandLine& line, const std::string& format,
                    const std::string& snapshots, const std::string& out) {
  requireFormat(format);
  const Case setup = flowCase(line);
  if (const auto folder = std::filesystem::path(out).parent_path();
      !folder.empty() && !line.run.dryRun)
    makeDirectory(folder);
  return inDimensionOf(
      setup, [&]<int D>() { return exportSnapshots<D>(line, setup, format, snapshots, out); });
}

Action declareExport(CLI::App& app, CommandLine& line) {
  const auto format = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  addArgument(app, "format", *format, "what to write", "mercurydpm|lammps|ondem");
  const auto snapshots = std::make_shared<std::string>();
  addArgument(app, "snapshots", *snapshots, "HDF5 file of snapshots, of compare or import", "FILE");
  addCase(app, line, "case file that they are of");
  addArgument(app, "--out", *out, "name of the files, without an ending", "NAME");
  addOverrides(app, line);
  addQuiet(app, line);
  addJson(app, line);
  addDryRun(app, line);
  return
      [&line, format, snapshots, out] { return exportSnapshots(line, *format, *snapshots, *out); };
}

}  // namespace

extern const Command exportCommand = {
    "export", "write snapshots as MercuryDPM, LAMMPS or ON-DEM VTKHDF files",
    "crossgrain export mercurydpm out/compare/snapshots/grain-p0.h5 cases/couette/quick.toml "
    "--out out/grain",
    declareExport};

}  // namespace crossgrain::inline cli
