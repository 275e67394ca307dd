#include "runs/collide/folder.hpp"

#include <fmt/format.h>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline runs {

namespace fs = std::filesystem;

std::vector<Case> collisionsOf(const fs::path& folder, const std::vector<std::string>& overrides) {
  std::vector<Case> variants;
  for (const fs::path& file : caseFilesIn(folder))
    for (Case& setup : loadCase(file, overrides))
      if (setup.kind == CaseKind::collision) variants.push_back(std::move(setup));
  requireOwnNames(variants);
  if (variants.empty()) throw BadInput(folder.string() + ": none of its cases is a collision");
  return variants;
}

CaseHead headOfFolder(const fs::path& folder, const std::vector<Case>& variants) {
  std::string toml;
  for (const Case& setup : variants)
    toml += fmt::format("# {}{}{}\n\n{}\n", setup.name, setup.variant.empty() ? "" : ": ",
                        setup.variant, setup.resolvedToml);
  const fs::path last = folder.has_filename() ? folder : folder.parent_path();
  return {last.filename().string(), "", folder.string(), toml};
}

}  // namespace crossgrain::inline runs
