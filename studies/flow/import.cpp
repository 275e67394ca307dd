#include "studies/flow/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "adapters/files/frame.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/hdf5_file.hpp"
#include "support/interrupt.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

void checkFormat(const std::string& format) {
  const auto formats = files::fileFormats();
  if (std::ranges::find(formats, format) != formats.end()) return;
  const std::vector<std::string> known(formats.begin(), formats.end());
  if (fs::exists(format))
    throw BadInput(fmt::format(
        "FORMAT is missing before {}: crossgrain import {} FILES… CASE.toml --out RUN.h5", format,
        files::formatOf(format).value_or("FORMAT")));
  throw BadInput(fmt::format("there is no format '{}'{}", format, suggestion(format, known)));
}

/// Finds a file's format by its beginning.
void checkFormatOf(const std::vector<fs::path>& files, const std::string& format) {
  for (const fs::path& file : files)
    if (const auto own = files::formatOf(file); own && *own != format)
      throw BadInput(fmt::format("{}: the file is of format {}, not {}: crossgrain import {} …",
                                 file.string(), *own, format, *own));
}

/// Only a file of snapshots is written over.
void checkOut(const fs::path& out) {
  if (!fs::exists(out)) return;
  bool snapshots = false;
  try {
    snapshots = Hdf5File::open(out).holds("/disks/radius");
  } catch (const std::runtime_error&) {
  }
  if (!snapshots)
    throw BadInput(fmt::format(
        "--out {}: this file exists and holds no snapshots: name another file", out.string()));
}

SnapshotRun onlyRun(const CommandLine& line, const std::string& format) {
  checkFormatOf(filesOf(line), format);
  const std::vector<SnapshotRun> runs = snapshotRuns(filesOf(line), format);
  if (runs.size() == 1) return runs.front();
  std::vector<std::string> names;
  for (const SnapshotRun& run : runs) names.push_back(run.name());
  throw BadInput(fmt::format("import takes the files of one run; these are of {} runs: {}",
                             runs.size(), fmt::join(names, "; ")));
}

/// Gone unless the file is whole.
struct PartFile {
  fs::path path;
  ~PartFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

template <int D>
Imported importRun(const SnapshotRun& run, const Case& setup, const std::string& name,
                   const fs::path& out, const RunCommand& command) {
  const auto source = openSnapshots<D>(run, setup, name);
  Imported imported;
  imported.name = source->engine();
  if (command.dryRun) return imported;
  const PartFile part{out.string() + ".part"};
  SnapshotFileOf<D> file(out, source->engine(), source->scene(), 1, 1);  // one of each one: all
  Progress progress(command.quiet);
  progress.begin("import", {1.0});
  CoveredTime covered(flowTimes(setup));
  while (const auto snapshot = source->next()) {
    throwIfInterrupted();
    if (source->disksChanged() && imported.snapshots > 0)
      throw BadInput(fmt::format(
          "{}: its particles come and go, and a file of snapshots has the same disks throughout: "
          "average and compare read the files themselves",
          run.name()));
    if (imported.snapshots == 0) imported.from = snapshot->positionTime;
    imported.to = snapshot->positionTime;
    covered.add(snapshot->positionTime);
    file.offer(*snapshot, static_cast<int>(++imported.snapshots));
    progress.update(0, fmt::format("snapshot {}", imported.snapshots), source->progress());
  }
  file.close();
  imported.disks = source->scene().disks.size();
  imported.remarks = source->remarks();
  if (std::string gap = covered.gap(); !gap.empty()) imported.remarks.push_back(std::move(gap));
  return imported;
}

}  // namespace

Imported importSnapshots(const CommandLine& line, const ImportOptions& options) {
  checkFormat(options.format);
  const fs::path out = fs::absolute(options.out);
  if (!line.run.dryRun) makeDirectory(out.parent_path());  // before the work that it is to hold
  checkOut(out);
  const Case setup = onlyFlow(line, {"import", Starts::notMade, false});
  const SnapshotRun run = onlyRun(line, options.format);
  const std::string name = options.name.value_or(defaultName(options.format));
  return inDimensionOf(setup,
                       [&]<int D>() { return importRun<D>(run, setup, name, out, line.run); });
}

}  // namespace crossgrain::inline studies
