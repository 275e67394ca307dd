#include "studies/flow/file_runs.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <filesystem>
#include <utility>

#include "adapters/registry.hpp"
#include "support/bad_input.hpp"
#include "support/fingerprint.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> filesMatching(const std::string& pattern) {
  glob_t found{};
  const int status = ::glob(pattern.c_str(), GLOB_MARK, nullptr, &found);
  std::vector<fs::path> files;
  if (status == 0)
    for (std::size_t k = 0; k < found.gl_pathc; ++k)
      if (const std::string_view name = found.gl_pathv[k]; !name.ends_with('/'))
        files.emplace_back(name);
  ::globfree(&found);
  return files;
}

std::string wordOf(const std::string& format) {
  return format.empty() ? "a file of snapshots" : format;
}

}  // namespace

bool namesFiles(const std::string& text) {
  return text.find('=') != std::string::npos;
}

EngineEntry engineOfFiles(const std::string& text) {
  const std::size_t sign = text.find('=');
  EngineEntry entry;
  entry.name = text.substr(0, sign);
  const std::string pattern = text.substr(sign + 1);
  if (entry.name.empty() || pattern.empty())
    throw BadInput(fmt::format(
        "--engines '{}': files are named like mine=out/*.h5: a name, '=' and a pattern", text));
  if (findEngine(entry.name))
    throw BadInput(fmt::format(
        "--engines '{}': there is an engine '{}': give the files another name", text, entry.name));
  const std::vector<fs::path> files = filesMatching(pattern);
  if (files.empty()) throw BadInput(fmt::format("--engines '{}': no file matches it", text));
  for (SnapshotRun& run : snapshotRuns(files)) {
    if (!entry.files.empty() && run.format != entry.format)
      throw BadInput(
          fmt::format("--engines '{}': {} is {}, {} is {}: runs of one engine are of one "
                      "format",
                      text, entry.files.front().front().string(), wordOf(entry.format),
                      run.files.front().string(), wordOf(run.format)));
    entry.format = run.format;
    entry.files.push_back(std::move(run.files));
  }
  entry.summary = fmt::format("{} run{} from files: {}", entry.files.size(),
                              entry.files.size() == 1 ? "" : "s", pattern);
  entry.missing = [] { return "it is files, which only compare takes"; };
  return entry;
}

SnapshotRun runOf(const EngineEntry& entry, std::size_t run) {
  return {entry.format, entry.files[run]};
}

std::vector<std::string> dropCopies(EngineEntry& entry, const Case& setup) {
  std::vector<SnapshotRun> runs;
  for (std::size_t k = 0; k < entry.files.size(); ++k) runs.push_back(runOf(entry, k));
  const DistinctRuns distinct =
      distinctRuns(runs, setup, [&](const SnapshotRun&) { return entry.name; });
  std::vector<std::vector<fs::path>> kept;
  for (const std::size_t k : distinct.kept) kept.push_back(std::move(entry.files[k]));
  entry.files = std::move(kept);
  return distinct.remarks;
}

std::string fingerprintOf(const EngineEntry& entry, std::size_t run) {
  std::string text;
  for (const fs::path& file : entry.files[run]) {
    std::error_code gone;
    text += fmt::format("{} {} {};", fs::weakly_canonical(file, gone).string(),
                        fs::file_size(file, gone),
                        fs::last_write_time(file, gone).time_since_epoch().count());
  }
  return fmt::format("{:016x}", fnv1a(text));
}

namespace {

template <int D>
AveragedRun averagedRun(const Case& setup, const SnapshotRun& files, SnapshotSourceOf<D>& source,
                        const std::function<void(double)>& progress) {
  const std::string where = files.name();
  CoveredTime covered(flowTimes(setup));
  AveragedRun averaged;
  auto averages = std::make_unique<FlowAverages<D>>(setup, source.scene());
  while (const auto snapshot = source.next()) {
    throwIfInterrupted();
    if (source.disksChanged()) averages->changeDisks();
    try {
      averages->add(*snapshot);
    } catch (const std::invalid_argument& misfit) {
      throw BadInput(fmt::format("{}, snapshot {}: {}", where, averaged.snapshots, misfit.what()));
    }
    ++averaged.snapshots;
    covered.add(snapshot->positionTime);
    progress(source.progress());
  }
  if (averaged.snapshots == 0)
    throw BadInput(fmt::format("{}: none of its snapshots is of the averaged time", where));
  averaged.run.engine = source.engine();
  averaged.run.files = where;
  averages->describe(EffectiveParameters{}, averaged.run);
  averaged.averages = std::move(averages);
  averaged.run.remarks = source.remarks();
  averaged.run.hasOtherLaw = source.hasOtherLaw();
  // Of our own files of a cell all snapshots are averaged, whenever they are.
  const bool timed = !cellOf(setup) || !files.format.empty();
  if (std::string gap = covered.gap(); timed && !gap.empty())
    averaged.run.remarks.push_back(std::move(gap));
  return averaged;
}

}  // namespace

OpenRun openRun(const SnapshotRun& files, const Case& setup, const std::string& name) {
  return inDimensionOf(setup, [&]<int D>() {
    // std::function is copied.
    const std::shared_ptr<SnapshotSourceOf<D>> source = openSnapshots<D>(files, setup, name);
    return OpenRun{source->scene().disks.radius,
                   [&setup, files, source](const std::function<void(double)>& progress) {
                     return averagedRun<D>(setup, files, *source, progress);
                   }};
  });
}

}  // namespace crossgrain::inline studies
