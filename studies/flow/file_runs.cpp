#include "studies/flow/file_runs.hpp"

#include <fmt/format.h>
#include <glob.h>

#include <filesystem>
#include <utility>

#include "adapters/registry.hpp"
#include "cases/flow.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/fingerprint.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

constexpr const char* ownFormat = "snapshots";

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

/// A file of our own layout.
class KeptSnapshots final : public SnapshotSource {
 public:
  KeptSnapshots(const fs::path& file, const Case& setup) : reader_(file, setup) {
    requireFit(reader_, setup);
    requireSound(reader_, setup);
  }
  const Scene& scene() const override { return reader_.scene(); }
  const std::string& engine() const override { return reader_.engine(); }
  std::optional<Snapshot> next() override {
    if (read_ == reader_.count()) return std::nullopt;
    return reader_.read(read_++);
  }
  double progress() const override {
    return static_cast<double>(read_) / static_cast<double>(reader_.count());
  }

 private:
  SnapshotReader reader_;
  std::size_t read_ = 0;
};

}  // namespace

std::unique_ptr<SnapshotSource> openRun(const Case& setup, const EngineEntry& entry,
                                        std::size_t run) {
  return std::make_unique<KeptSnapshots>(entry.files[run].front(), setup);
}

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
  entry.format = ownFormat;
  for (const fs::path& file : files) entry.files.push_back({file});
  entry.summary = fmt::format("{} run{} from files: {}", entry.files.size(),
                              entry.files.size() == 1 ? "" : "s", pattern);
  entry.missing = [] { return "it is files, which only compare takes"; };
  return entry;
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

FlowRun averagedRun(const Case& setup, SnapshotSource& source,
                    const std::function<void(double)>& progress) {
  const auto averages = flowAverages(setup, source.scene());
  const double from = setup.average ? flowTimes(setup).settled : -INFINITY;
  double last = -INFINITY;
  std::size_t averaged = 0;
  while (const auto snapshot = source.next()) {
    throwIfInterrupted();
    last = snapshot->positionTime;
    progress(source.progress());
    if (last <= from) continue;
    averages->add(*snapshot);
    ++averaged;
  }
  if (averaged == 0)
    throw BadInput(fmt::format(
        "{}: its last snapshot is of {:g} s; averaged is what is later than average.from = {:g} s",
        source.engine(), last, from));
  FlowRun run;
  run.engine = source.engine();
  averages->describe(EffectiveParameters{}, run);
  run.endpointErrors = endpointErrors(setup, *averages, run);
  return run;
}

}  // namespace crossgrain::inline studies
