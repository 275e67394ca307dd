#include "cases/case_files.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <set>

#include "cases/loader_document.hpp"
#include "stability/measures.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {

namespace fs = std::filesystem;

namespace {

std::string headOf(const fs::path& file) {
  const std::string content = readFile(file).value_or("");
  const std::string line = content.substr(0, content.find('\n'));
  const auto text = line.find_first_not_of("# ");
  return line.starts_with('#') && text != std::string::npos ? line.substr(text) : "";
}

}  // namespace

std::vector<CaseSummary> casesBelow(const fs::path& folder) {
  std::vector<CaseSummary> cases;
  std::error_code noFolder;
  for (fs::recursive_directory_iterator at(folder, noFolder), end; at != end;
       at.increment(noFolder)) {
    const fs::path& file = at->path();
    if (file.extension() != ".toml") continue;
    const toml::table header = readCaseDocuments(file, {}).front().root;
    const auto kind = header.at_path("case.kind").value<std::string>();
    if (!kind) continue;
    cases.push_back(
        {file, header.at_path("case.name").value_or(file.stem().string()), *kind, headOf(file)});
  }
  if (noFolder) throw BadInput(fmt::format("{}: {}", folder.string(), noFolder.message()));
  if (cases.empty()) throw BadInput(folder.string() + ": there is no case file (*.toml) in it");
  std::ranges::sort(cases, {}, &CaseSummary::file);
  return cases;
}

std::vector<fs::path> caseFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (files.empty()) throw BadInput(folder.string() + ": there is no case file (*.toml) in it");
  std::ranges::sort(files);
  return files;
}

namespace {

std::string nameAndVariant(const Case& setup) {
  return setup.variant.empty() ? setup.name : setup.name + "/" + setup.variant;
}

bool isComparedWithFirst(const Case& setup) {
  return setup.stability &&
         stabilityMeasure(setup.stability->measure).protocol == StabilityProtocol::againstOriginal;
}

}  // namespace

bool fitsPattern(const std::string& name, const std::string& pattern) {
  if (pattern.find_first_of("*?[") == std::string::npos)
    return name.find(pattern) != std::string::npos;
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool fits(const Case& setup, const std::string& patterns) {
  return std::ranges::any_of(commaList(patterns), [&](const std::string& pattern) {
    return fitsPattern(setup.name, pattern) || fitsPattern(nameAndVariant(setup), pattern);
  });
}

std::vector<Case> selectedCases(const std::vector<Case>& cases, const std::string& patterns) {
  std::set<std::string> originals;
  std::vector<std::string> names;
  for (const Case& setup : cases) {
    if (fits(setup, patterns) && isComparedWithFirst(setup)) originals.insert(setup.name);
    if (std::ranges::find(names, setup.name) == names.end()) names.push_back(setup.name);
  }
  for (const Case& setup : cases)
    if (!setup.variant.empty()) names.push_back(nameAndVariant(setup));
  for (const std::string& pattern : commaList(patterns))
    if (std::ranges::none_of(cases, [&](const Case& setup) { return fits(setup, pattern); }))
      throw BadInput(fmt::format("-k '{}': no case or variant has that in its name{}", pattern,
                                 suggestion(pattern, names)));
  std::vector<Case> chosen;
  for (const Case& setup : cases)
    if (originals.erase(setup.name) > 0 || fits(setup, patterns)) chosen.push_back(setup);
  return chosen;
}

void requireOwnNames(const std::vector<Case>& cases) {
  std::map<std::string, fs::path> named;
  for (const Case& setup : cases)
    if (const auto [at, isNew] = named.emplace(setup.name, setup.file);
        !isNew && at->second != setup.file)
      throw BadInput(fmt::format("{}: case.name = \"{}\": {} has it too", setup.file.string(),
                                 setup.name, at->second.string()));
}

}  // namespace crossgrain::inline cases
