#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

#include "results/schema.hpp"
#include "studies/core/study.hpp"

/// By which program, where and when: what results begin with.
namespace crossgrain::inline studies {

const char* const programVersion = CROSSGRAIN_VERSION;
const char* const programBuild = CROSSGRAIN_BUILD;

std::string thisProgram() {
  return fmt::format("{} ({})", programVersion, programBuild);
}

namespace {

std::string cpuName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string operatingSystem() {
  std::ifstream release("/etc/os-release");
  for (std::string line; std::getline(release, line);)
    if (line.starts_with("PRETTY_NAME=")) return line.substr(13, line.size() - 14);
  utsname names{};
  ::uname(&names);
  return names.sysname;
}

}  // namespace

std::string timeStamp() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

ResultsHead headOf(std::string_view kind, const Case& setup, const std::string& command) {
  ResultsHead head;
  head.schema = schemaVersion;
  head.kind = kind;
  head.version = programVersion;
  head.build = programBuild;
  head.command = command;
  head.started = timeStamp();
  head.machine = {cpuName(), operatingSystem(), std::thread::hardware_concurrency()};
  head.setup = {setup.name, setup.variant, setup.file.string(), setup.resolvedToml};
  return head;
}

}  // namespace crossgrain::inline studies
