#include <fmt/format.h>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>
#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "cases/preparation.hpp"
#include "cli/option_groups.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/mirrors.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"
#include "support/scratch_folder.hpp"
#include "support/task_pool.hpp"

namespace crossgrain::inline cli {

using nlohmann::json;

namespace {

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

int listEngines(const CommandLine& line) {
  const ScratchFolder scratch;
  const auto& registry = engineRegistry();
  std::vector<json> rows(registry.size());
  // Each is asked what it can do, side by side: some take seconds to start.
  std::vector<Task> tasks;
  for (std::size_t e = 0; e < rows.size(); ++e)
    tasks.push_back(
        {1.0, [&, e] {
           const EngineEntry& entry = registry[e];
           rows[e] = {{"name", entry.name}, {"summary", entry.summary}, {"mirrors", entry.mirrors}};
           try {
             const auto engine = startNew(entry, scratch.path, 60.0);
             rows[e]["capabilities"] = jsonOf(engine->capabilities());
           } catch (const std::exception& missing) {
             rows[e]["missing"] = missing.what();
           }
         }});
  runTasks(tasks, static_cast<int>(std::max(2U, std::thread::hardware_concurrency())));
  const json list(rows);
  if (line.json) {
    fmt::print("{}\n", list.dump(2));
    return exitPassed;
  }
  for (const json& row : list) {
    if (row.contains("missing")) {
      fmt::print("{:<16} not available: {}\n\n", row["name"].get<std::string>(),
                 row["missing"].get<std::string>());
      continue;
    }
    const auto can = readAs<Capabilities>(row["capabilities"]);
    std::vector<std::string> precisions;
    for (const Precision precision : can.precisions) precisions.push_back(toString(precision));
    fmt::print("{:<16} {} (version {}, {})\n", row["name"].get<std::string>(),
               row["summary"].get<std::string>(), can.version, fmt::join(precisions, " or "));
    for (const auto& [effect, support] : can.effects)
      fmt::print("  {:<22} {}\n", toString(effect), supportMark(support));
    for (const auto& [option, values] : can.lawOptions)
      fmt::print("  {:<22} {}\n", option, fmt::join(values, " | "));
    // As the protocol names them.
    for (const char* limit :
         {"inertia", "wall_motions", "plane_motions", "plane_normals", "restitution"})
      if (row["capabilities"].contains(limit))
        fmt::print("  {:<22} {}\n", limit, row["capabilities"][limit].dump());
    for (const SettingSpec& setting : can.settings)
      fmt::print("  setting {:<14} {} [{}]\n", setting.name, setting.doc,
                 setting.unit.empty() ? "-" : setting.unit);
    fmt::print("\n");
  }
  fmt::print("Prepared packings are kept in {} (CROSSGRAIN_CACHE says where else).\n",
             packingCache().string());
  return exitPassed;
}

Action declareEngines(CLI::App& app, CommandLine& line) {
  addFlag(app, "--json", line.json, "as JSON");
  return [&line] { return listEngines(line); };
}

int help(const CLI::App& program, const std::optional<std::string>& name) {
  const CLI::App* asked = &program;
  if (name) {
    requireKnownCommand(*name);
    asked = program.get_subcommand(*name);
  }
  // App::help() would show the command that is running.
  fmt::print("{}",
             program.get_formatter()->make_help(asked, name ? "crossgrain " + *name : "crossgrain",
                                                CLI::AppFormatMode::Normal));
  return exitPassed;
}

Action declareHelp(CLI::App& app, CommandLine&) {
  const auto name = std::make_shared<std::optional<std::string>>();
  app.add_option("command", *name, "one of those that crossgrain --help lists")
      ->type_name("COMMAND");
  return [&app, name] { return help(*app.get_parent(), *name); };
}

/// @param conventions  "tension=cut", "lever_arm=radius,contact_point": of a mirror that is made
/// for
///                     an engine of the user's
int serveEngine(const std::string& name, const std::vector<std::string>& conventions) {
  const EngineEntry* entry = findEngine(name);
  if (!entry || !entry->make) throw BadInput(fmt::format("there is no engine '{}' to serve", name));
  if (conventions.empty()) return serve(*entry->make());
  return serve(*makeGrainMirror(conventionsFromWords(conventions)));
}

Action declareServe(CLI::App& app, CommandLine&) {
  const auto engine = std::make_shared<std::string>();
  const auto conventions = std::make_shared<std::vector<std::string>>();
  addArgument(app, "engine", *engine, "its name");
  app.add_option("conventions", *conventions, "that it has");
  return [engine, conventions] { return serveEngine(*engine, *conventions); };
}

}  // namespace

extern const Command enginesCommand = {
    "engines", "list the engines found, what they can do, and their settings", "crossgrain engines",
    declareEngines};

extern const Command helpCommand = {"help", "print the help of a command, as --help does",
                                    "crossgrain help compare", declareHelp};

extern const Command serveCommand = {"__serve", "speak the worker protocol on descriptors 3 and 4",
                                     "", declareServe};

}  // namespace crossgrain::inline cli
