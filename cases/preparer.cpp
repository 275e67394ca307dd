#include "cases/preparer.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>

#include "adapters/registry.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/worker_engine.hpp"
#include "support/bad_input.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline cases {
namespace {

const std::string& versionOf(const EngineEntry& entry, const Case& setup) {
  static std::mutex mutex;
  static std::map<std::string, std::string> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(entry.name);
  if (found != known.end()) return found->second;
  const ScratchFolder scratch;
  return known[entry.name] = startPreparer(entry, setup, scratch.path)->capabilities().version;
}

}  // namespace

const EngineEntry* ownPreparer(const Case& setup) {
  const std::string& name = setup.preparation.engine;
  return name.empty() || name == engineRegistry().front().name ? nullptr : findEngine(name);
}

std::unique_ptr<Engine> startPreparer(const EngineEntry& entry, const Case& setup,
                                      const std::filesystem::path& scratch) {
  if (entry.missing)
    if (const std::string why = entry.missing(); !why.empty())
      throw BadInput(fmt::format("{}: preparation.engine = \"{}\": it is not available: {}",
                                 setup.file.string(), entry.name, why));
  if (!entry.command) return entry.make();
  return std::make_unique<WorkerEngine>(entry.name, entry.command(), scratch, setup.run.timeout);
}

std::string preparerKey(const Case& setup) {
  const EngineEntry* const entry = ownPreparer(setup);
  if (!entry) return {};
  const auto settings = setup.engines.find(entry->name);
  const nlohmann::json own =
      settings == setup.engines.end() ? nlohmann::json() : jsonOf(settings->second);
  return fmt::format("{} {} {}", entry->name, versionOf(*entry, setup), own.dump());
}

}  // namespace crossgrain::inline cases
