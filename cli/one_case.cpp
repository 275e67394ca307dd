#include "cli/one_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cases/flow.hpp"
#include "cases/loader.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// What --quick changes; never to more packings than the case has.
std::vector<std::string> hurried(const Case& setup) {
  const std::string packings =
      fmt::format("preparation.packings={}", std::min(2, setup.preparation.packings));
  if (setup.average) return {packings, "average.snapshots=20"};
  return {packings, "preparation.rotations=0.1", "averaging.settle_rotations=0.02",
          "averaging.rotations=0.1", "averaging.snapshots_per_rotation=400"};
}

}  // namespace

Case onlyCase(const CommandLine& line, const char* command) {
  const fs::path& file = line.inputs.front();
  const Case setup = loadCase(file, line.overrides).front();
  if (setup.kind != CaseKind::couette) refuseKind(setup, file, command);
  return onlyFlow(line, command);
}

Case onlyFlow(const CommandLine& line, const char* command) {
  const fs::path& file = line.inputs.front();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (!hasFlow(cases.front())) {
    if (cases.front().kind != CaseKind::assembly) refuseKind(cases.front(), file, command);
    throw BadInput(fmt::format(
        "{}: {} cannot run an assembly that does not say what is averaged: give it [average] and "
        "[[endpoints]]",
        file.string(), command));
  }
  if (cases.size() > 1)
    throw BadInput(fmt::format("{}: {} takes a case without variants", file.string(), command));
  if (!line.quick) return cases.front();
  std::vector<std::string> overrides = hurried(cases.front());
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  return loadCase(file, overrides).front();
}

void refuseKind(const Case& setup, const fs::path& input, const char* command) {
  const char* const able = setup.kind == CaseKind::collision ? "collide"
                           : hasFlow(setup)                  ? "compare"
                                                             : "stability";
  throw BadInput(fmt::format("{}: {} cannot run a case of this kind; crossgrain {} can",
                             input.string(), command, able));
}

std::string effectsInWords(const Effects& called) {
  std::vector<std::string> in, out;
  for (const Effect effect : allEffects)
    (called.contains(effect) ? in : out).push_back(toString(effect));
  return fmt::format("effects called for: {}; left out: {}",
                     in.empty() ? "none" : fmt::format("{}", fmt::join(in, ", ")),
                     out.empty() ? "none" : fmt::format("{}", fmt::join(out, ", ")));
}

}  // namespace crossgrain::inline cli
