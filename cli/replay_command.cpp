#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/record/replay.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace {

/// "position[17]: then 0.1, now 0.2, off by 0.1; 3 of 244 differ, none by more"
std::string sentenceOf(const AnswerDifference& found) {
  std::string text =
      fmt::format("{}{}: then {}, now {}", found.field, found.place, found.then, found.now);
  if (found.off) text += fmt::format(", off by {:.3g}", *found.off);
  if (found.of > 1) text += fmt::format("; {} of {} differ, none by more", found.differ, found.of);
  return text;
}

void print(const Replayed& found) {
  constexpr std::size_t most = 12;
  const auto list = [](const std::vector<AnswerDifference>& differences) {
    for (std::size_t k = 0; k < differences.size() && k < most; ++k)
      fmt::print("  {}\n", sentenceOf(differences[k]));
    if (differences.size() > most) fmt::print("  and {} more\n", differences.size() - most);
  };
  fmt::print("{} {} asked what {} {}{} was asked in {}\n", found.engine, found.version,
             found.recordedEngine, found.recordedVersion,
             found.recordedStamp.empty() ? "" : " (" + found.recordedStamp + ")", found.caseName);
  if (!found.declared.empty()) {
    fmt::print("it says otherwise of itself:\n");
    list(found.declared);
  }
  if (!found.request.empty()) {
    fmt::print("request {}, {}, is the first answered otherwise:\n", found.asked, found.request);
    list(found.differences);
  } else if (found.failure.empty()) {
    fmt::print("the same answers to {} {} requests\n",
               found.declared.empty() ? "all" : "all others of", found.asked);
  } else {
    fmt::print("the same answers as far as request {}, where it fails\n", found.asked);
  }
}

nlohmann::json inJson(const std::vector<AnswerDifference>& differences) {
  nlohmann::json list = nlohmann::json::array();
  for (const AnswerDifference& each : differences)
    list.push_back({{"field", each.field + each.place},
                    {"then", each.then},
                    {"now", each.now},
                    {"off", each.off ? nlohmann::json(*each.off) : nlohmann::json(nullptr)},
                    {"differ", each.differ},
                    {"of", each.of}});
  return list;
}

nlohmann::json inJson(const Replayed& found) {
  return {{"engine", found.engine},
          {"version", found.version},
          {"recorded_engine", found.recordedEngine},
          {"recorded_version", found.recordedVersion},
          {"recorded_stamp", found.recordedStamp},
          {"case", found.caseName},
          {"asked", found.asked},
          {"declared", inJson(found.declared)},
          {"request", found.request},
          {"differences", inJson(found.differences)},
          {"failure", found.failure}};
}

int replay(const CommandLine& line, const std::string& file, const std::optional<double>& given) {
  const double tolerance = given.value_or(0.0);
  if (!(tolerance >= 0.0 && tolerance < 1.0))
    throw BadInput(fmt::format("--tolerance: {:g} must be from 0 to less than 1", tolerance));
  const std::vector<EngineEntry> engines = selectEngines(line.run.engines);
  if (engines.size() != 1)
    throw BadInput(fmt::format("--engines: replay takes one engine, not {}", engines.size()));
  const Replayed found = replayRun(file, engines.front(), tolerance);
  if (line.json)
    fmt::print("{}\n", inJson(found).dump());
  else
    print(found);
  if (!found.failure.empty()) {
    printFailure(found.failure);
    return exitEngineFailed;
  }
  return found.request.empty() && found.declared.empty() ? exitHeld : exitFellShort;
}

Action declareReplay(CLI::App& app, CommandLine& line) {
  const auto file = std::make_shared<std::string>();
  addArgument(app, "recording", *file, "file that `record` wrote", "FILE");
  addEngines(app, line);
  const auto tolerance = std::make_shared<std::optional<double>>();
  addNumber(app, "--tolerance", *tolerance,
            "numbers are alike that differ by no more than this part of the largest of their array "
            "(default: 0)");
  addFlag(app, "--json", line.json, "print what was found as JSON");
  return [&line, file, tolerance] { return replay(line, *file, *tolerance); };
}

}  // namespace

extern const Command replayCommand = {
    "replay", "asks an engine what a recording asked: the first request answered otherwise",
    "crossgrain replay run.rec --engines examples/python/engine.toml\n"
    "crossgrain replay run.rec --engines examples/python/engine.toml --tolerance 1e-9 --json",
    declareReplay};

}  // namespace crossgrain::inline cli
