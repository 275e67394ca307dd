#include "runs/run_store.hpp"

#include "reports/files.hpp"
#include "reports/schema.hpp"

namespace crossgrain {

namespace fs = std::filesystem;
using nlohmann::json;

RunStore::RunStore(fs::path out, bool resume) : out_(std::move(out)) {
  std::error_code ignored;
  if (!resume) fs::remove_all(out_ / "runs", ignored);
  fs::remove_all(out_ / "scratch", ignored);
  for (const char* folder : {"runs", "scratch", "snapshots"}) reports::makeDirectory(out_ / folder);
  // Found out now rather than after the first run.
  reports::writeFile(out_ / "runs" / ".writable", "");
  fs::remove(out_ / "runs" / ".writable", ignored);
}

std::optional<json> RunStore::find(const std::string& name, const std::string& key) const {
  const auto text = reports::readFile(file(name));
  if (!text) return std::nullopt;
  const json stored = json::parse(*text, nullptr, /*allow_exceptions=*/false);
  if (!stored.is_object() || stored.value("key", "") != key) return std::nullopt;
  return stored["run"];
}

void RunStore::keep(const std::string& name, const std::string& key, const json& run) const {
  reports::writeFile(file(name), reports::toText({{"key", key}, {"run", run}}));
}

fs::path RunStore::scratch(const std::string& name) const {
  return out_ / "scratch" / name;
}

fs::path RunStore::snapshots(const std::string& name) const {
  return out_ / "snapshots" / (name + ".h5");
}

fs::path RunStore::file(const std::string& name) const {
  return out_ / "runs" / (name + ".json");
}

}  // namespace crossgrain
