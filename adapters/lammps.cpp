#include "adapters/lammps.hpp"

#include <filesystem>

#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"
#include "adapters/worker_script.hpp"
#include "support/program.hpp"

namespace crossgrain {
namespace {

/// Debian's own Python where there is one: that has the modules of Debian's packages.
std::string python() {
  const std::filesystem::path ofDebian = "/usr/bin/python3";
  return std::filesystem::exists(ofDebian) ? ofDebian.string() : "python3";
}

}  // namespace

ProgramCall lammpsCommand() {
  return std::vector<std::string>{python(), workerScript("lammps").string()};
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

EngineEntry lammpsEngine() {
  return {"lammps",
          "LAMMPS, pair_style granular with Hooke's or Hertz' law, in two dimensions",
          {},
          lammpsCommand,
          lammpsMissing,
          ""};
}

/// pair_style granular with linear_history or mindlin, and fix nve/sphere
/// (engines/lammps/README.md).
EngineEntry lammpsMirror() {
  const auto make = [] {
    return makeGrainMirror({{"tension", {"allow"}},
                            {"coulomb_bound", {"magnitude"}},
                            {"dashpot", {"inside"}},
                            {"spring_reset", {"spring_only"}},
                            {"spring_update", {"before"}},
                            {"lever_arm", {"overlap_middle"}},
                            {"velocity_arm", {"radius"}},
                            {"plane_arm", {"radius"}},
                            {"damping_velocity", {"lagged"}},
                            {"integrator", {"position_verlet"}}});
  };
  return {
      "grain-as-lammps",  "the in-house engine with LAMMPS' conventions", make, {}, {}, "lammps",
      {"linear", "hertz"}};
}

}  // namespace crossgrain
