#include "studies/core/study_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "adapters/registry.hpp"
#include "cases/case_keys.hpp"
#include "cases/flow.hpp"
#include "cases/keys.hpp"
#include "cases/loader.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/shared_conventions.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;
using std::operator""sv;

std::vector<std::string> keysWithoutUse(const Case& setup, std::string_view command) {
  addMirrors(setup.run.timeout);  // sections may be theirs
  std::vector<std::string> keys;
  for (const auto& [name, settings] : setup.engines)
    if (!findEngine(name) && command != "average")  // whose files may be of that name
      keys.push_back(fmt::format(
          "engines.{} (nothing of this name takes part: --engines names {})", name,
          command == "compare" ? fmt::format("result files as {}=FILES, and a program of your "
                                             "own by its file",
                                             name)
                               : "a program of your own by its file"));
  if (command == "check") return keys;
  for (const auto& [key, value] : caseKeys(setup.resolvedToml)) {
    const KeyUse* use = nullptr;  // the longest name that holds the key
    for (const KeyUse& each : keyUses())
      if (isIn(each.name, key) && (!use || each.name.size() > use->name.size())) use = &each;
    if (!use || use->by(command)) continue;
    // A section of which some keys are used is named key by key.
    const bool partly = std::ranges::any_of(keyUses(), [&](const KeyUse& each) {
      return isIn(use->name, each.name) && each.by(command);
    });
    const std::string& name = partly ? key : use->name;
    if (std::ranges::find(keys, name) == keys.end()) keys.push_back(name);
  }
  return keys;
}

namespace {
std::vector<std::pair<std::FILE*, std::string>> heldNotes;
}  // namespace

void reportKeysWithoutUse(const Case& setup, std::string_view command, std::FILE* to) {
  const std::vector<std::string> keys = keysWithoutUse(setup, command);
  if (!keys.empty())
    heldNotes.emplace_back(to, fmt::format("{}{}: {} does not use {}\n",
                                           to == stdout ? "# " : "note: ", setup.file.string(),
                                           command, fmt::join(keys, ", ")));
}

void printNotes() {
  for (const auto& [to, text] : std::exchange(heldNotes, {})) fmt::print(to, "{}", text);
}

void reportKeysWithoutUse(const std::vector<Case>& cases, std::string_view command, std::FILE* to) {
  const fs::path* last = nullptr;
  for (const Case& setup : cases)
    if (!last || *last != setup.file) {
      reportKeysWithoutUse(setup, command, to);
      last = &setup.file;
    }
}

std::vector<std::string> quickOverrides(const Case& setup, double rotations) {
  const std::string packings =
      fmt::format("preparation.packings={}", std::min(2, setup.preparation.packings));
  if (hasClosedForms(setup)) return {packings};  // few bodies, and times of what they do
  if (!cellOf(setup))
    return {packings, fmt::format("average.snapshots={}", std::min(20, setup.region->snapshots))};
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  return {packings, fmt::format("preparation.rotations={}", std::min(0.1, filling.rotations)),
          fmt::format("averaging.settle_rotations={}", std::min(0.02, times.settleRotations)),
          fmt::format("averaging.rotations={}", std::min(rotations, times.rotations)),
          "averaging.snapshots_per_rotation=400"};
}

namespace {

/// `import` and `average` have files, and so has a comparison of nothing else.
Starts startsOf(const CommandLine& line, std::string_view command) {
  const auto isFiles = [](const std::string& name) {
    const EngineEntry* const entry = findEngine(name);
    return entry && entry->ofFiles();
  };
  const auto& engines = line.run.engines;
  const bool filesAlone = !engines.empty() && std::ranges::all_of(engines, isFiles);
  return command == "import" || command == "average" || (command == "compare" && filesAlone)
             ? Starts::notMade
             : Starts::made;
}

}  // namespace

Case onlyFlow(const CommandLine& line, const char* command) {
  const fs::path& file = line.inputs.front();
  const Starts starts = startsOf(line, command);
  const std::vector<Case> cases = loadCase(file, line.overrides, {}, starts);
  if (!hasFlow(cases.front())) {
    if (isCollision(cases.front()))
      throw BadInput(
          fmt::format("{}: {} needs a flow, and here two bodies meet once; crossgrain collide can "
                      "run it",
                      file.string(), command));
    throw BadInput(fmt::format(
        "{}: {} cannot run an assembly that does not say what is averaged: give it [average] and "
        "[[endpoints]]",
        file.string(), command));
  }
  if (cases.size() > 1)
    throw BadInput(fmt::format("{}: {} takes a case without variants", file.string(), command));
  // Both begin from states of grain's.
  if (anyConvex(cases.front()) && (command == "baseline"sv || command == "identify"sv))
    throw BadInput(
        fmt::format("{}: {} needs grain, which has no convex bodies", file.string(), command));
  // import takes a case as it is for what comes after.
  if (command != "import"sv)
    reportKeysWithoutUse(cases.front(), command, line.json ? stderr : stdout);
  std::vector<std::string> overrides;
  if (line.quick) overrides = quickOverrides(cases.front());
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  const bool shares =
      command == "compare"sv && shareConventions(cases.front(), line.run.engines, overrides);
  return shares || line.quick ? loadCase(file, overrides, {}, starts).front() : cases.front();
}

void printWarnings(const Case& setup) {
  for (const std::string& warning : setup.warnings) fmt::print(stderr, "caution: {}\n", warning);
}

}  // namespace crossgrain::inline studies
