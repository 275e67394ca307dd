#include "adapters/worker_script.hpp"

#include <fmt/format.h>

#include "support/data_folder.hpp"

namespace crossgrain {

std::filesystem::path workerScript(const std::string& engine) {
  return dataFolder() / "engines" / engine / "worker.py";
}

std::string workerScriptMissing(const std::string& engine) {
  const std::filesystem::path script = workerScript(engine);
  if (std::filesystem::exists(script)) return {};
  return fmt::format(
      "there is no {}; set CROSSGRAIN_DATA to the folder that holds engines/{}/worker.py",
      script.string(), engine);
}

}  // namespace crossgrain
