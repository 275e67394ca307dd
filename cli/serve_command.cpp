#include <fmt/format.h>

#include <memory>

#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"
#include "cli/option_groups.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {
namespace {

int serveEngine(const std::string& name) {
  const EngineEntry* entry = findEngine(name);
  if (!entry || !entry->make) throw BadInput(fmt::format("there is no engine '{}' to serve", name));
  return serve(*entry->make());
}

Action declareServe(CLI::App& app, CommandLine&) {
  const auto engine = std::make_shared<std::string>();
  addArgument(app, "engine", *engine, "its name");
  return [engine] { return serveEngine(*engine); };
}

}  // namespace

extern const Command serveCommand = {"__serve", "speak the worker protocol on descriptors 3 and 4",
                                     "", declareServe};

}  // namespace crossgrain::inline cli
