#include "cli/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "adapters/registry.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/bad_input.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "reports/report.hpp"
#include "runs/check_lines.hpp"
#include "runs/collide.hpp"
#include "runs/collision_folder.hpp"
#include "runs/collision_sweep.hpp"
#include "runs/couette_run.hpp"
#include "runs/engine_access.hpp"

namespace crossgrain {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

fs::path scratchFolder() {
  std::string name = (fs::temp_directory_path() / "crossgrain-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw std::runtime_error(fmt::format("{}: cannot be made", fs::temp_directory_path().string()));
  return name;
}

/// A folder of this process' own, gone at the end of the scope.
struct ScratchFolder {
  fs::path path = scratchFolder();
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

std::string supportMark(Support support) {
  switch (support) {
    case Support::optional:
      return "yes";
    case Support::always:
      return "always";
    case Support::never:
      break;
  }
  return "no";
}

}  // namespace

int listEngines(const CommandLine& line) {
  const ScratchFolder scratch;
  json list = json::array();
  for (const EngineEntry& entry : engineRegistry()) {
    json row = {{"name", entry.name}, {"summary", entry.summary}, {"mirrors", entry.mirrors}};
    try {
      row["capabilities"] = toJson(startEngine(entry, scratch.path, 60.0)->capabilities());
    } catch (const std::exception& missing) {
      row["missing"] = missing.what();
    }
    list.push_back(row);
  }
  if (line.json) {
    fmt::print("{}\n", list.dump(2));
    return exitHeld;
  }
  for (const json& row : list) {
    if (row.contains("missing")) {
      fmt::print("{:<16} not available: {}\n\n", row["name"].get<std::string>(),
                 row["missing"].get<std::string>());
      continue;
    }
    const Capabilities can = capabilitiesFromJson(row["capabilities"]);
    std::vector<std::string> precisions;
    for (const Precision precision : can.precisions) precisions.push_back(toString(precision));
    fmt::print("{:<16} {} (version {}, {})\n", row["name"].get<std::string>(),
               row["summary"].get<std::string>(), can.version, fmt::join(precisions, " or "));
    for (const auto& [effect, support] : can.effects)
      fmt::print("  {:<22} {}\n", toString(effect), supportMark(support));
    for (const auto& [option, values] : can.lawOptions)
      fmt::print("  {:<22} {}\n", option, fmt::join(values, " | "));
    for (const SettingSpec& setting : can.settings)
      fmt::print("  setting {:<14} {} [{}]\n", setting.name, setting.doc,
                 setting.unit.empty() ? "-" : setting.unit);
    fmt::print("\n");
  }
  return exitHeld;
}

namespace {

/// The scene of a case as far as `check` needs it: all disks are there, but not yet where a packing
/// will have them.
Scene unplacedScene(const Case& setup) {
  if (setup.kind == CaseKind::collision)
    return collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
  if (setup.kind == CaseKind::assembly) return assemblyScene(setup);
  Packing unplaced;
  unplaced.disks = spreadDisks(setup);
  return couetteScene(setup, unplaced, timeStep(setup));
}

void printSuitability(const EngineEntry& entry, const Case& setup, const Scene& scene,
                      const fs::path& scratch) {
  const auto engine = startEngine(entry, scratch, setup.run.timeout);
  const std::vector<std::string> lines = checkLines(*engine, entry, setup, scene);
  fmt::print("  {:<16} {}\n", entry.name, lines.front());
  for (std::size_t k = 1; k < lines.size(); ++k) fmt::print("    {}\n", lines[k]);
}

}  // namespace

std::string effectsInWords(const Effects& called) {
  std::vector<std::string> in, out;
  for (const Effect effect : allEffects)
    (called.contains(effect) ? in : out).push_back(toString(effect));
  return fmt::format("effects called for: {}; left out: {}",
                     in.empty() ? "none" : fmt::format("{}", fmt::join(in, ", ")),
                     out.empty() ? "none" : fmt::format("{}", fmt::join(out, ", ")));
}

int checkCase(const CommandLine& line) {
  if (line.inputs.size() != 1) throw BadInput("check takes one case file");
  const ScratchFolder scratch;
  bool allCan = true;
  for (const Case& setup : loadCase(line.inputs.front(), line.overrides)) {
    checkEngineSections(setup);
    const Scene scene = unplacedScene(setup);
    fmt::print("{}: {} disks, {} wall disks, dt {:.3g} s\n",
               setup.variant.empty() ? setup.name : setup.variant, scene.disks.size(),
               scene.wallDiskCount(), scene.dt);
    fmt::print("  {}\n", effectsInWords(effectsOf(scene)));
    if (setup.kind == CaseKind::couette) {
      const double end =
          (setup.averaging.settleRotations + setup.averaging.rotations) * rotationTime(setup);
      fmt::print("  per packing: {:.0f} steps of the case's dt\n", end / scene.dt);
    }
    for (const EngineEntry& entry : selectEngines(line.run.engines)) {
      try {
        printSuitability(entry, setup, scene, scratch.path);
      } catch (const UnsupportedScene& refusal) {
        allCan = false;
        fmt::print("  {:<16} cannot: {}\n", entry.name, refusal.what());
      }
    }
    for (const EngineEntry& entry : engineRegistry())
      if (entry.missing && !entry.missing().empty() && !isNamed(line.run.engines, entry))
        fmt::print("  {:<16} not available: {}\n", entry.name, entry.missing());
  }
  return allCan ? exitHeld : exitFellShort;
}

namespace {

/// Runs what was loaded into one report.
int collideCases(const std::vector<Case>& variants, const std::optional<fs::path>& folder,
                 const CommandLine& line) {
  const fs::path& out = line.run.out;
  json results = collideEngines(variants, line.run);
  if (folder) describeFolder(results, *folder, variants);
  writeReport(results, out);

  int failed = 0, fellShort = 0;
  std::map<std::string, std::string> reasons;
  std::map<std::string, int> refused;
  for (const json& variant : results["variants"])
    for (const json& curve : variant["curves"]) {
      const std::string engine = curve["engine"];
      failed += curve["status"] == "failed";
      if (curve["status"] == "failed") reasons.emplace(engine, curve["reason"]);
      refused[engine] += curve["status"] == "refused";
      fellShort += curve["score"]["verdict"] == "fell short";
    }
  for (const auto& [engine, reason] : reasons) fmt::print(stderr, "crossgrain: {}\n", reason);
  for (const auto& [engine, count] : refused)
    if (count > 0 && !line.json)
      fmt::print("{} does not have the law of {} sweeps; the report says why\n", engine, count);
  if (line.json)
    fmt::print("{}\n", (out / "results.json").string());
  else
    fmt::print("{} curves fell short\nreport: {}\n", fellShort, (out / "report.html").string());
  if (failed > 0) return exitEngineFailed;
  return fellShort > 0 ? exitFellShort : exitHeld;
}

}  // namespace

int collide(const CommandLine& line) {
  if (line.inputs.size() != 1) throw BadInput("collide takes one case file or folder");
  const fs::path& input = line.inputs.front();
  if (!fs::is_directory(input)) {
    const std::vector<Case> variants = loadCase(input, line.overrides);
    if (variants.front().kind != CaseKind::collision)
      throw BadInput(fmt::format("{}: collide cannot run a case of this kind", input.string()));
    return collideCases(variants, std::nullopt, line);
  }
  return collideCases(collisionsOf(input, line.overrides), input, line);
}

int rebuildReports(const CommandLine& line) {
  for (const fs::path& folder : line.inputs) {
    writeReport(readResults(folder), folder);
    fmt::print("report: {}\n", (folder / "report.html").string());
  }
  return exitHeld;
}

int serveEngine(const std::string& name) {
  const EngineEntry* entry = findEngine(name);
  if (!entry || !entry->make) throw BadInput(fmt::format("there is no engine '{}' to serve", name));
  return serve(*entry->make());
}

}  // namespace crossgrain
