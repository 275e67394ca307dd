#include "cases/case_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cases/bad_input.hpp"

namespace crossgrain {

namespace fs = std::filesystem;

std::vector<fs::path> caseFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw BadInput(folder.string() + ": there is no case file (*.toml) in it");
  std::ranges::sort(files);
  return files;
}

void requireOwnNames(const std::vector<Case>& cases) {
  std::map<std::string, fs::path> named;
  for (const Case& setup : cases)
    if (const auto [at, isNew] = named.emplace(setup.name, setup.file);
        !isNew && at->second != setup.file)
      throw BadInput(fmt::format("{}: case.name = \"{}\": {} has it too", setup.file.string(),
                                 setup.name, at->second.string()));
}

}  // namespace crossgrain
