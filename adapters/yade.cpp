#include "adapters/yade.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"
#include "support/data_folder.hpp"

namespace crossgrain {
namespace {

std::filesystem::path script() {
  return dataFolder() / "engines/yade/worker.py";
}

bool onPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream directories(path ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (::access((std::filesystem::path(directory) / program).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

std::vector<std::string> yadeCommand() {
  // Without display, leave when the script ends, one thread: sums in one order.
  return {"yade", "-n", "-x", "-j1", script().string()};
}

std::string yadeMissing() {
  if (!onPath("yade"))
    return "there is no program 'yade' in PATH (Debian and Ubuntu: package yade)";
  if (!std::filesystem::exists(script()))
    return fmt::format(
        "there is no {}; set CROSSGRAIN_DATA to the folder that holds "
        "engines/yade/worker.py",
        script().string());
  return {};
}

EngineEntry yadeEngine() {
  return {"yade",      "YADE, its viscoelastic and Hertz-Mindlin laws on spheres held in a plane",
          {},          yadeCommand,
          yadeMissing, ""};
}

/// Law2_ScGeom_ViscElPhys_Basic or Law2_ScGeom_MindlinPhys_Mindlin, which share its conventions,
/// and NewtonIntegrator (engines/yade/README.md).
EngineEntry yadeMirror() {
  const auto make = [] {
    return makeGrainMirror({{"tension", {"cut"}},
                            {"coulomb_bound", {"compression"}},
                            {"dashpot", {"outside"}},
                            {"spring_reset", {"total"}},
                            {"spring_update", {"before"}},
                            {"lever_arm", {"overlap_middle"}},
                            {"velocity_arm", {"lever_arm"}},
                            {"plane_arm", {"surface"}},
                            {"history", {"force"}},
                            {"damping_velocity", {"lagged"}},
                            {"integrator", {"position_verlet"}}});
  };
  return {
      "grain-as-yade",    "the in-house engine held to YADE's conventions", make, {}, {}, "yade",
      {"linear", "hertz"}};
}

}  // namespace crossgrain
