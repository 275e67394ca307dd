#include <filesystem>
#include <nlohmann/json.hpp>

#include "adapters/grain.hpp"
#include "peer_laws.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"

namespace crossgrain {
namespace {

/// Debian's own Python where there is one: that has the modules of Debian's packages.
std::string python() {
  const std::filesystem::path ofDebian = "/usr/bin/python3";
  return std::filesystem::exists(ofDebian) ? ofDebian.string() : "python3";
}

std::string lammpsMissing() {
  // The program comes with the library, which is what the worker opens.
  if (!isOnPath("lmp"))
    return "there is no program 'lmp' in PATH (Debian and Ubuntu: package lammps)";
  if (!std::filesystem::exists(python()) && !isOnPath("python3"))
    return "there is no program 'python3' in PATH (Debian and Ubuntu: packages python3, "
           "python3-numpy)";
  return workerScriptMissing("lammps");
}

}  // namespace

/// Python executes engines/lammps/worker.py, which calls LAMMPS' C library and speaks the worker
/// protocol.
EngineEntry lammpsEngine() {
  return {
      .name = "lammps",
      .summary = "LAMMPS, pair_style granular with Hooke's or Hertz' law, in a plane or in space",
      .command =
          [] {
            return ProgramCall({python(), workerScript("lammps").string()});
          },
      .missing = lammpsMissing};
}

/// pair_style granular with linear_history or mindlin, and fix nve/sphere
/// (engines/lammps/README.md).
EngineEntry lammpsMirror() {
  LawConventionSets conventions = conventionsOf(nlohmann::json::parse(lammpsLaw));
  for (const char* const law : {"rolling", "cohesion"}) conventions.erase(law);
  return mirrorEntry("grain-as-lammps", "the in-house engine with LAMMPS' conventions", "lammps",
                     {"linear", "hertz"}, std::move(conventions));
}

}  // namespace crossgrain
