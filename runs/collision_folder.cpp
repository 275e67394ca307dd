#include "runs/collision_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cases/bad_input.hpp"
#include "cases/loader.hpp"

namespace crossgrain {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<Case> collisionsOf(const fs::path& folder, const std::vector<std::string>& overrides) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw BadInput(folder.string() + ": there is no case file (*.toml) in it");
  std::ranges::sort(files);
  std::vector<Case> variants;
  std::map<std::string, fs::path> named;
  for (const fs::path& file : files)
    for (Case& setup : loadCase(file, overrides)) {
      if (setup.kind != CaseKind::collision) continue;
      if (const auto [at, isNew] = named.emplace(setup.name, file); !isNew && at->second != file)
        throw BadInput(fmt::format("{}: case.name = \"{}\": {} has it too", file.string(),
                                   setup.name, at->second.string()));
      variants.push_back(std::move(setup));
    }
  if (variants.empty()) throw BadInput(folder.string() + ": none of its cases is a collision");
  return variants;
}

void describeFolder(json& results, const fs::path& folder, const std::vector<Case>& variants) {
  std::string toml;
  for (const Case& setup : variants)
    toml += fmt::format("# {}{}{}\n\n{}\n", setup.name, setup.variant.empty() ? "" : ": ",
                        setup.variant, setup.resolvedToml);
  const fs::path last = folder.has_filename() ? folder : folder.parent_path();
  results["case"] = {{"name", last.filename().string()},
                     {"variant", ""},
                     {"file", folder.string()},
                     {"toml", toml}};
}

}  // namespace crossgrain
