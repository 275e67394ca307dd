#include "cases/engine_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <sstream>
#include <system_error>

#include "adapters/registry.hpp"
#include "cases/loader_document.hpp"
#include "cases/loader_sections.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cases {

namespace {

namespace fs = std::filesystem;

constexpr const char* extension = ".toml";

/// Of a file that a program is stamped with; more is data that a program is not changed by [bytes].
constexpr std::size_t longestNeed = std::size_t{1} << 30;

/// A word of a command as a file, looked up where the command is started.
fs::path inFolder(const std::string& word, const fs::path& folder) {
  return folder.empty() ? fs::path(word) : folder / word;
}

/// A program that was built and installed with this one lies beside it, in PATH or not.
std::string besideThisProgram(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  std::error_code unknown;
  const fs::path own = fs::read_symlink("/proc/self/exe", unknown);
  if (unknown) return program;  // beside nothing would be in the working directory
  const fs::path beside = own.parent_path() / program;
  return program.starts_with("crossgrain-") && isProgram(beside) ? beside.string() : program;
}

/// Of a program that is changed while its version stays: the command, and the files that it names.
std::string stampOf(const ProgramCall& call, const std::string& file,
                    const std::vector<fs::path>& needs = {}) {
  std::uint64_t stamp = fnv1a(file);
  const auto add = [&](const fs::path& path) {
    std::error_code none;
    if (!fs::is_regular_file(path, none)) return;  // a folder is not looked into
    readPieces(path, longestNeed, [&](std::string_view piece) { stamp = fnv1a(piece, stamp); });
  };
  for (const fs::path& path : needs) add(path);
  for (const std::string& word : call.argv) {
    stamp = fnv1a(word + '\0', stamp);
    add(inFolder(word, call.folder));
  }
  return fmt::format("program {:016x}", stamp);
}

/// Why the program cannot be started, one line; empty: it can, as far as can be seen.
std::string whyNoProgram(const ProgramCall& call) {
  const std::string& program = call.argv.front();
  if (program.find('/') != std::string::npos) {
    const fs::path path = inFolder(program, call.folder);
    return isProgram(path) ? "" : fmt::format("{} is no program", path.string());
  }
  return isOnPath(program) ? "" : fmt::format("there is no program '{}' in PATH", program);
}

/// Which file it lacks; empty: none. A folder is none.
std::string incompleteReason(const std::vector<fs::path>& needs) {
  for (const fs::path& file : needs) {
    std::error_code none;
    if (fs::is_directory(file, none)) continue;
    const std::string why = fileFault(file), name = file.lexically_normal().string();
    if (why == noSuchFile) return fmt::format("there is no {}", name);
    if (!why.empty()) return fmt::format("{} {}", name, why);
  }
  return {};
}

/// The call with its stamp, made when an engine is first started and kept: engines that no run
/// names cost a start of the program no reading of what they need.
std::function<ProgramCall()> stampedOnce(ProgramCall call, std::string file,
                                         std::vector<fs::path> needs) {
  struct Once {
    std::once_flag flag;
    std::string stamp;
  };
  return [call = std::move(call), file = std::move(file), needs = std::move(needs),
          once = std::make_shared<Once>()] {
    std::call_once(once->flag, [&] { once->stamp = stampOf(call, file, needs); });
    ProgramCall stamped = call;
    stamped.stamp = once->stamp;
    return stamped;
  };
}

/// Modules that a worker in Python imports, beside what the caller's environment or the file has.
void addPythonPath(ProgramCall& call) {
  const auto own = call.environment.find("PYTHONPATH");
  const char* const callers = std::getenv("PYTHONPATH");
  const std::string before = own != call.environment.end() ? own->second : callers ? callers : "";
  const std::string helpers = (dataFolder() / "engines/python").string();
  call.environment["PYTHONPATH"] = before.empty() ? helpers : helpers + ":" + before;
}

EngineEntry entryOf(std::string name, std::string summary, ProgramCall call) {
  addPythonPath(call);
  EngineEntry entry;
  entry.name = std::move(name);
  entry.summary = std::move(summary);
  entry.missing = [call] { return whyNoProgram(call); };
  entry.command = [call = std::move(call)] { return call; };
  return entry;
}

/// Why an engine cannot be called that; empty if it can.
std::string nameFault(const std::string& name) {
  if (!usableName(name)) return usableNameRule;
  if (namesEngineFile(name)) return "is that of a file";
  if (name == "all" || findEngine(name)) return "is taken: an engine of this program has that name";
  return {};
}

}  // namespace

bool namesEngineFile(const std::string& name) {
  return name.ends_with(extension) || name.find('/') != std::string::npos;
}

EngineEntry loadEngineFile(const fs::path& file) {
  const toml::table document = readTomlFile(file);
  Reader in(&document, "", file.string());
  std::string name, summary;
  ProgramCall call;
  in.require("name", name);
  in.read("summary", summary);
  in.require("command", call.argv);
  std::string folder = ".", install;
  in.read("folder", folder);
  std::vector<std::string> words;
  in.read("needs", words);
  in.read("install", install);
  double memory = 0.0;
  in.read("memory", memory, between(1e6, 1e18, "bytes"));
  Reader environment = in.section("environment");
  for (const std::string& variable : environment.keys())
    environment.read(variable, call.environment[variable]);
  Settings settings = readSettings(in.section("settings"));
  in.finish();
  if (const std::string why = nameFault(name); !why.empty()) in.fail("name", why);
  if (call.argv.empty() || call.argv.front().empty())
    in.fail("command", "must be a program and its arguments, as [\"python3\", \"engine.py\"]");
  call.argv.front() = besideThisProgram(call.argv.front());
  call.memory = static_cast<std::uint64_t>(memory);
  call.folder = fs::absolute(file).parent_path() / folder;
  if (!fs::is_directory(call.folder)) in.fail("folder", "is no folder");
  std::vector<fs::path> needs;
  for (const std::string& word : words) needs.push_back(call.folder / word);
  EngineEntry entry = entryOf(std::move(name), std::move(summary), std::move(call));
  entry.command = stampedOnce(entry.command(), readFile(file).value_or(""), needs);
  entry.missing = [program = std::move(entry.missing), needs, install] {
    std::string why = program();
    if (why.empty()) why = incompleteReason(needs);
    return why.empty() || install.empty() ? why : fmt::format("{} ({})", why, install);
  };
  entry.settings = std::move(settings);
  return entry;
}

EngineEntry engineOfCommand(const std::string& text) {
  const std::string where = fmt::format("--engine '{}': ", text);
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos)
    throw BadInput(fmt::format("{}must be NAME='program arguments'{}", where,
                               findEngine(text) || namesEngineFile(text) || text == "all"
                                   ? fmt::format(" (did you mean --engines {}?)", text)
                                   : ""));
  const std::string name = text.substr(0, sign);
  if (const std::string why = nameFault(name); !why.empty())
    throw BadInput(fmt::format("{}the name '{}' {}", where, name, why));
  std::istringstream words(text.substr(sign + 1));
  ProgramCall call;
  call.argv.assign(std::istream_iterator<std::string>(words), {});
  if (call.argv.empty()) throw BadInput(where + "names no program");
  call.stamp = stampOf(call, {});
  return entryOf(name, "of the command line", std::move(call));
}

std::vector<fs::path> installedEngineFiles() {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& folder : fs::directory_iterator(dataFolder() / "engines", none))
    for (const auto& file : fs::directory_iterator(folder.path(), none))
      if (file.path().extension() == ".toml") files.push_back(file.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace crossgrain::inline cases
