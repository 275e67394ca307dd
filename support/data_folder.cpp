#include "support/data_folder.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

namespace crossgrain::inline support {

namespace fs = std::filesystem;

fs::path dataFolder() {
  if (const char* wanted = std::getenv("CROSSGRAIN_DATA"); wanted && *wanted) return wanted;
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  fs::path installed = program.parent_path().parent_path() / "share/crossgrain";
  if (!unknown && fs::is_directory(installed, unknown)) return installed;
  return CROSSGRAIN_SOURCE_DIR;
}

fs::path hereOrInstalled(const fs::path& path) {
  std::error_code unknown;
  if (path.empty() || *path.begin() != "cases" || fs::exists(path, unknown)) return path;
  const fs::path installed = dataFolder() / path;
  return fs::exists(installed, unknown) ? installed : path;
}

fs::path workerScript(const std::string& engine) {
  return dataFolder() / "engines" / engine / "worker.py";
}

std::string workerScriptMissing(const std::string& engine) {
  const fs::path script = workerScript(engine);
  if (fs::exists(script)) return {};
  return fmt::format(
      "there is no {}; set CROSSGRAIN_DATA to the folder that holds engines/{}/worker.py",
      script.string(), engine);
}

}  // namespace crossgrain::inline support
