#include "runs/run_store.hpp"

#include <fmt/format.h>

#include "cases/bad_input.hpp"
#include "cases/files.hpp"
#include "reports/schema.hpp"

namespace crossgrain {

namespace fs = std::filesystem;
using nlohmann::json;

RunStore::RunStore(fs::path out) : out_(std::move(out)) {
  std::error_code ignored;
  const fs::path marker = out_ / ".crossgrain";
  if (fs::exists(out_, ignored) && !fs::is_empty(out_, ignored) && !fs::exists(marker, ignored) &&
      fs::is_directory(out_, ignored))
    throw BadInput(
        fmt::format("--out {}: the folder is not empty and not of an earlier run; take a "
                    "new one",
                    out_.string()));
  makeDirectory(out_);
  writeFile(
      marker,
      "Made by crossgrain; a new run replaces runs/, scratch/, snapshots/ and unfinished/.\n");
  fs::remove_all(out_ / "scratch", ignored);
  for (const char* folder : {"runs", "scratch", "snapshots", "unfinished"})
    makeDirectory(out_ / folder);
}

void RunStore::startAfresh() const {
  std::error_code ignored;
  for (const char* folder : {"runs", "snapshots", "unfinished"}) {
    fs::remove_all(out_ / folder, ignored);
    makeDirectory(out_ / folder);
  }
}

std::optional<json> RunStore::find(const std::string& name, const std::string& key) const {
  const auto text = readFile(file(name));
  if (!text) return std::nullopt;
  const json stored = json::parse(*text, nullptr, /*allow_exceptions=*/false);
  if (!stored.is_object() || !stored.contains("run")) return std::nullopt;
  if (const auto found = stored.find("key"); found == stored.end() || *found != key)
    return std::nullopt;
  return stored["run"];
}

void RunStore::keep(const std::string& name, const std::string& key, const json& run) const {
  writeFile(file(name), reports::toText({{"key", key}, {"run", run}}));
  std::error_code ignored;
  fs::remove_all(unfinished(name), ignored);
}

fs::path RunStore::scratch(const std::string& name) const {
  return out_ / "scratch" / name;
}

fs::path RunStore::snapshots(const std::string& name) const {
  return out_ / "snapshots" / (name + ".h5");
}

fs::path RunStore::unfinished(const std::string& name) const {
  return out_ / "unfinished" / name;
}

fs::path RunStore::file(const std::string& name) const {
  return out_ / "runs" / (name + ".json");
}

}  // namespace crossgrain
