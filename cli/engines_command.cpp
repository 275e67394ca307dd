#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>
#include <algorithm>
#include <memory>
#include <thread>

#include "adapters/registry.hpp"
#include "adapters/worker/json.hpp"
#include "cases/engine_file.hpp"
#include "cases/preparation.hpp"
#include "cli/option_groups.hpp"
#include "studies/core/engine_access.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"
#include "support/scratch_folder.hpp"
#include "support/task_pool.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {
namespace {

using nlohmann::json;

/// An engine's answer to what it can do.
struct Asked {
  const EngineEntry& entry;
  std::optional<Capabilities> can = {};
  std::string missing = {};  ///< why there is no answer
};

/// "soft", "rigid", "soft, rigid": by the normal laws of its contacts.
std::string kindOf(const Capabilities& can) {
  const auto normal = can.lawOptions.find("normal");
  if (normal == can.lawOptions.end()) return "soft";
  const auto rigid = std::ranges::count(normal->second, std::string("rigid"));
  if (rigid == 0) return "soft";
  return rigid == std::ssize(normal->second) ? "rigid" : "soft, rigid";
}

bool isIn(const Capabilities& can, int dimension) {
  return std::ranges::find(can.dimensions, dimension) != can.dimensions.end();
}

/// Shapes that moving bodies may have.
std::vector<std::string> shapesOf(const Capabilities& can) {
  std::vector<std::string> shapes;
  if (isIn(can, 2)) shapes.emplace_back("disk");
  if (isIn(can, 3)) shapes.emplace_back("sphere");
  for (const ShapeKind shape : can.limits.shapes) shapes.emplace_back(toString(shape));
  return shapes;
}

/// "jolt-physics 0.35.0" of "jolt-physics 0.35.0 (program 1a2b)": what a program calls itself, or is
/// called by whom it is packed.
std::string shortVersion(const std::string& version) {
  return version.substr(0, version.find_first_of(",("));
}

/// Their list, where it is not longer than a line has room for.
std::string bodiesOf(const Capabilities& can) {
  std::vector<std::string> shapes = shapesOf(can);
  constexpr std::size_t many = 3;
  if (can.limits.shapes.size() > many) {
    shapes.erase(shapes.end() - std::ssize(can.limits.shapes), shapes.end());
    shapes.push_back(fmt::format("{} convex", can.limits.shapes.size()));
  }
  return fmt::format("{}", fmt::join(shapes, ", "));
}

json jsonOf(const Asked& asked) {
  const EngineEntry& entry = asked.entry;
  json row = {{"name", entry.name}, {"summary", entry.summary}, {"mirrors", entry.mirrors}};
  if (!asked.can) {
    row["missing"] = asked.missing;
    return row;
  }
  row["capabilities"] = crossgrain::jsonOf(*asked.can);
  row["dimensions"] = asked.can->dimensions;
  row["shapes"] = shapesOf(*asked.can);
  row["kind"] = kindOf(*asked.can);
  return row;
}

/// Asks all side by side: some take seconds to start.
std::vector<Asked> ask(const std::vector<const EngineEntry*>& entries) {
  const ScratchFolder scratch;
  std::vector<Asked> all;
  for (const EngineEntry* entry : entries) all.push_back({*entry});
  std::vector<Task> tasks;
  for (Asked& asked : all)
    tasks.push_back({1.0, [&] {
                       try {
                         asked.can = startNew(asked.entry, scratch.path, 60.0)->capabilities();
                       } catch (const std::exception& missing) {
                         asked.missing = missing.what();
                       }
                     }});
  runTasks(tasks, static_cast<int>(std::max(2U, std::thread::hardware_concurrency())));
  return all;
}

/// One line each.
void printTable(const std::vector<Asked>& all) {
  const std::size_t width = terminalWidth(STDOUT_FILENO);
  std::size_t widest = 0;
  for (const Asked& asked : all) widest = std::max(widest, displayWidth(asked.entry.name));
  const auto print = [&](const std::string& name, const std::string& rest) {
    fmt::print("{}\n", cut(padded(name, widest + 2) + rest, width));
  };
  const auto columns = [](const std::string& version, const std::string& dimensions,
                          const std::string& contacts, const std::string& bodies) {
    return padded(cut(version, 21), 23) + padded(dimensions, 6) + padded(contacts, 13) + bodies;
  };
  print("engine", columns("version", "dim.", "contacts", "bodies"));
  for (const auto& [entry, can, missing] : all) {
    if (!can)
      print(entry.name, "missing: " + missing);
    else
      print(entry.name,
            columns(shortVersion(can->version), fmt::format("{}", fmt::join(can->dimensions, ", ")),
                    kindOf(*can), bodiesOf(*can)));
  }
}

void printInFull(const Asked& asked) {
  const std::size_t width = terminalWidth(STDOUT_FILENO);
  const auto print = [&](const std::string& name, const std::string& text) {
    constexpr std::size_t column = 26;
    fmt::print("{}\n", wrapped(padded("  " + name, column - 1) + " " + text, width, column));
  };
  const EngineEntry& entry = asked.entry;
  if (!asked.can) {
    fmt::print("{}\n", wrapped(fmt::format("{}: {}", entry.name, entry.summary), width, 2));
    print("missing", asked.missing);
    return;
  }
  const Capabilities& can = *asked.can;
  std::vector<std::string> precisions;
  for (const Precision precision : can.precisions) precisions.push_back(toString(precision));
  fmt::print("{}\n", wrapped(fmt::format("{}: {} (version {}, {})", entry.name, entry.summary,
                                         can.version, fmt::join(precisions, " or ")),
                             width, 2));
  print("dimensions", fmt::format("{}", fmt::join(can.dimensions, ", ")));
  print("bodies", fmt::format("{}", fmt::join(shapesOf(can), ", ")));
  print("contacts", kindOf(can));
  for (const auto& [effect, support] : can.effects)
    print(toString(effect), support == Support::optional ? "yes"
                            : support == Support::always ? "always"
                                                         : "no");
  for (const auto& [option, values] : can.lawOptions)
    print(option, fmt::format("{}", fmt::join(values, " | ")));
  const json capabilities = crossgrain::jsonOf(can);  // limits as the protocol names them
  for (const char* limit : {"inertia", "wall_motions", "plane_motions", "plane_normals",
                            "cylinders", "most_vertices", "rounded", "restitution"})
    if (capabilities.contains(limit)) print(limit, capabilities[limit].dump());
  if (!can.settings.empty()) fmt::print("settings, under [engines.{}] of a case\n", entry.name);
  for (const SettingSpec& setting : can.settings)
    print(setting.name, setting.unit.empty() || setting.unit == "-"
                            ? setting.doc
                            : setting.doc + " [" + setting.unit + "]");
}

int engines(const CommandLine& line, std::vector<std::string> names) {
  const bool all = names.empty();
  std::vector<const EngineEntry*> entries;
  std::vector<std::string> known;
  for (const EngineEntry& entry : engineRegistry()) known.push_back(entry.name);
  for (std::string& name : names) {
    if (namesEngineFile(name)) {
      addEngine(loadEngineFile(name));
      name = engineRegistry().back().name;
    }
    entries.push_back(findEngine(name));
    if (!entries.back())
      throw BadInput(fmt::format("there is no engine '{}'{}", name, suggestion(name, known)));
  }
  std::size_t mirrors = 0;
  if (all)
    for (const EngineEntry& entry : engineRegistry()) {
      const bool listed = line.json || entry.mirrors.empty();
      if (listed) entries.push_back(&entry);
      mirrors += !listed;
    }
  const std::vector<Asked> asked = ask(entries);
  if (line.json) {
    json rows = json::array();
    for (const Asked& one : asked) rows.push_back(jsonOf(one));
    fmt::print("{}\n", rows.dump(2));
    return exitPassed;
  }
  if (!all) {
    for (const Asked& one : asked) printInFull(one);
    return exitPassed;
  }
  printTable(asked);
  const std::string below = fmt::format(
      "\n{} mirrors (grain-as-NAME) are not listed. All of one engine: crossgrain engines NAME. "
      "Prepared packings are kept in {} (CROSSGRAIN_CACHE says where else).",
      mirrors, packingCache().string());
  fmt::print("{}\n", wrapped(below, terminalWidth(STDOUT_FILENO), 0));
  return exitPassed;
}

Action declareEngines(CLI::App& app, CommandLine& line) {
  const auto names = std::make_shared<std::vector<std::string>>();
  addNamesArgument(app, *names, "engines to be listed in full: names or engine files");
  addFlag(app, "--json", line.json, "all that is known of each, as JSON");
  return [&line, names] { return engines(line, *names); };
}

}  // namespace

extern const Command enginesCommand = {
    "engines", "list the engines found, or all that one can do, and its settings",
    "crossgrain engines\n"
    "crossgrain engines grain",
    declareEngines};

}  // namespace crossgrain::inline cli
