#include "cli/option_groups.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include "adapters/files/frame.hpp"
#include "adapters/registry.hpp"
#include "cases/engine_file.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/flow/file_runs.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cli {
namespace {

std::string isNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const bool whole =
      !text.empty() && *end == '\0' && !std::isspace(static_cast<unsigned char>(text[0]));
  return whole ? "" : fmt::format("must be a number, not '{}'", text);
}

/// Checks what CLI11 would tell in its own words.
auto wholeNumber(std::int64_t least, std::int64_t most) {
  return [=](const std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most)
      return "";
    return fmt::format("must be a whole number from {} to {}, not '{}'", least, most, text);
  };
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// "grain, yade" is two names; that of a file adds the engine that it describes.
/// @throws BadInput where nothing stands between two commas, or for the file
void addNames(const std::string& list, std::vector<std::string>& names) {
  for (const std::string& name : commaList(list)) {
    names.push_back(trimmed(name));
    if (names.back().empty())
      throw BadInput(fmt::format("--engines '{}': a name is empty; like grain,yade", list));
    if (namesFiles(names.back())) {
      addEngine(engineOfFiles(names.back()));
      names.back() = engineRegistry().back().name;
      continue;
    }
    if (namesEngineFile(names.back()))
      names.back() = addExternalEngine(loadEngineFile(names.back()));
    addMirrorOfShelved(names.back());
  }
}

/// @throws BadInput where the last of these, which is the case, is a result file, as the others are
void requireCaseAtEnd(const std::vector<std::string>& given, const std::string& what) {
  const std::filesystem::path last = given.back();
  std::string found;
  if (const auto format = files::formatOf(last); format && last.extension() != ".toml")
    found = fmt::format(": {} is a result file ({})", last.string(), *format);
  else if (last.extension() == ".h5")
    found = fmt::format(": {} is a file of snapshots", last.string());
  else if (given.size() > 1)
    return;
  throw BadInput(
      fmt::format("the case, a TOML file, is missing behind the files{} ({})", found, what));
}

}  // namespace

void addFlag(CLI::App& app, const std::string& name, bool& set, const std::string& what) {
  app.add_flag(name, set, what);
}

void addText(CLI::App& app, const std::string& name, std::optional<std::string>& text,
             const std::string& what, const std::string& type) {
  app.add_option(name, text, what)->type_name(type);
}

void addNumber(CLI::App& app, const std::string& name, std::optional<double>& number,
               const std::string& what) {
  app.add_option(name, number, what)->type_name("NUMBER")->check(isNumber);
}

void addArgument(CLI::App& app, const std::string& name, std::string& text, const std::string& what,
                 const std::string& type) {
  app.add_option(name, text, what)->type_name(type)->required();
}

void addNamesArgument(CLI::App& app, std::vector<std::string>& names, const std::string& what) {
  app.add_option_function<std::vector<std::string>>(
         "name",
         [&names](const std::vector<std::string>& lists) {
           for (const std::string& list : lists)
             for (const std::string& name : commaList(list)) names.push_back(trimmed(name));
         },
         what)
      ->type_name("NAMES");
}

void addInputs(CLI::App& app, CommandLine& line, const std::string& name, const std::string& what,
               int least, int most) {
  CLI::Option* inputs = app.add_option(name, line.inputs, what)->type_name("FILE");
  inputs->transform([](const std::string& path) { return hereOrInstalled(path).string(); });
  if (most != anyNumber) inputs->expected(least, most);
  if (least > 0) inputs->required();
}

void addEngines(CLI::App& app, CommandLine& line, const char* usual) {
  app.add_option_function<std::vector<std::string>>(
         "--engine",
         [](const std::vector<std::string>& engines) {
           for (const std::string& text : engines) addExternalEngine(engineOfCommand(text));
         },
         "an engine of your own, which --engines can then name: the command of its worker, run "
         "without a "
         "shell")
      ->type_name("NAME='COMMAND …'")
      ->allow_extra_args(false);
  std::string what =
      "engines, separated by commas: names, engine files (TOML), or all; the first is the "
      "reference; "
      "compare also takes result files, NAME=FILES";
  if (usual) what += fmt::format(" (default: {})", usual);
  app.add_option_function<std::vector<std::string>>(
         "--engines",
         [&line](const std::vector<std::string>& lists) {
           for (const std::string& list : lists) addNames(list, line.run.engines);
         },
         what)
      ->type_name("NAMES")
      ->allow_extra_args(false)
      ->required(!usual);
  if (usual)
    app.callback([&line, usual] {
      if (line.run.engines.empty()) line.run.engines = {usual};
    });
}

void addOverrides(CLI::App& app, CommandLine& line) {
  app.add_option("--set", line.overrides, "change a key of the case, e.g. averaging.rings=40")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void addCase(CLI::App& app, CommandLine& line, const std::string& what) {
  addInputs(app, line, "case", what, 1, 1);
}

void addFilesAndCase(CLI::App& app, CommandLine& line, const std::string& files,
                     const std::string& what) {
  // CLI11 gives a list all that follows it: the case is the last of them.
  app.add_option_function<std::vector<std::string>>(
         "files",
         [&line, what](const std::vector<std::string>& given) {
           requireCaseAtEnd(given, what);
           line.inputs = {hereOrInstalled(given.back())};
           line.inputs.insert(line.inputs.end(), given.begin(), given.end() - 1);
         },
         fmt::format("{}; then the {}", files, what))
      ->type_name("FILES … CASE")
      ->required();
}

void addSelection(CLI::App& app, CommandLine& line) {
  addText(app, "-k", line.only,
          "only cases whose name or NAME/VARIANT contains this, or matches it where it has * or ?; "
          "several are separated by commas");
}

void addQuiet(CLI::App& app, CommandLine& line) {
  app.add_flag("--quiet", line.run.quiet, "print no progress");
}

void addJson(CLI::App& app, CommandLine& line) {
  app.add_flag("--json", line.json, "print the results as JSON");
}

void addDryRun(CLI::App& app, CommandLine& line) {
  app.add_flag("--dry-run", line.run.dryRun, "print what would be done; compute and write nothing");
}

void addVerbose(CLI::App& app, CommandLine& line) {
  app.add_flag("-v,--verbose", line.verbose, "print all findings, not a summary");
}

void addPackings(CLI::App& app, CommandLine& line) {
  app.add_option("--seed", line.seed, "preparation.seed of the case")
      ->type_name("N")
      ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()));
  app.add_flag("--quick", line.quick, "a short run, to see that everything works");
}

namespace {

/// Of all commands that leave results.
void addResults(CLI::App& app, CommandLine& line) {
  addOverrides(app, line);
  app.add_option(
         "--out", line.run.out,
         "folder for results: a new one, or one of the same command and case, which is continued")
      ->type_name("FOLDER")
      ->required()
      ->check([](const std::string& out) { return out.empty() ? "is empty" : ""; });
  app.add_flag("--fresh", line.run.fresh,
               "start anew; earlier results in --out are moved to its folder earlier/");
  app.add_flag("--json", line.json, "print only the path of results.json, for scripts");
  addVerbose(app, line);
}

/// "2/4". @throws BadInput
Shard shardOf(const std::string& text) {
  const auto slash = text.find('/');
  const auto number = [](const std::string& digits) {
    const bool plain = !digits.empty() && digits.size() < 6 &&
                       digits.find_first_not_of("0123456789") == std::string::npos;
    return plain ? std::stoi(digits) : 0;
  };
  const Shard shard = {slash == std::string::npos ? 0 : number(text.substr(0, slash)),
                       slash == std::string::npos ? 0 : number(text.substr(slash + 1))};
  if (shard.number < 1 || shard.number > shard.of)
    throw BadInput(
        fmt::format("--shard {}: must be K/N with whole numbers 1 <= K <= N, like 2/4", text));
  return shard;
}

/// Of all commands that run engines. @param jobs  not of a command that times one engine at a time
void addRun(CLI::App& app, CommandLine& line, bool jobs, bool shards) {
  addEngines(app, line);
  addResults(app, line);
  addQuiet(app, line);
  app.add_flag("--dry-run", line.run.dryRun,
               "print what would run and what is finished; compute and write nothing");
  app.add_flag_function(
      "--resume", [](std::int64_t) {}, "load finished runs from --out (the default)");
  if (!jobs) return;
  constexpr int mostJobs = 4096;
  app.add_option("--jobs", line.run.jobs, "engines side by side (default: one per core)")
      ->type_name("N")
      ->check(wholeNumber(1, mostJobs));
  if (!shards) return;
  app.add_option_function<std::string>(
         "--shard", [&line](const std::string& text) { line.run.shard = shardOf(text); },
         "one of N processes, here or on other machines, that share --out: each runs what no other "
         "has begun, the first one writes the results")
      ->type_name("K/N")
      ->excludes("--fresh");
}

}  // namespace

void addStudy(CLI::App& app, CommandLine& line, const SharedOptions& takes,
              const std::vector<StudyOption>& own, const std::vector<Exclusion>& exclusions) {
  using Input = SharedOptions::Input;
  if (takes.input == Input::files) {
    addFilesAndCase(app, line, takes.inputIs, "case file: the scene, the law, how to average");
    addResults(app, line);
  }
  if (takes.input == Input::oneCase) addCase(app, line, takes.inputIs);
  if (takes.input == Input::anyCases) addInputs(app, line, "case", takes.inputIs, 0, anyNumber);
  if (takes.selection) addSelection(app, line);
  if (takes.engines) addRun(app, line, takes.jobs, takes.shards);
  if (takes.packings) addPackings(app, line);
  for (const StudyOption& option : own) {
    if (auto* const* flag = std::get_if<bool*>(&option.value))
      addFlag(app, option.name, **flag, option.what);
    else if (auto* const* text = std::get_if<std::optional<std::string>*>(&option.value))
      addText(app, option.name, **text, option.what, option.type);
    else
      addNumber(app, option.name, *std::get<std::optional<double>*>(option.value), option.what);
  }
  for (const auto& [one, other] : exclusions) app.get_option(one)->excludes(app.get_option(other));
}

}  // namespace crossgrain::inline cli
