#include <nlohmann/json.hpp>

#include "adapters/grain.hpp"
#include "peer_laws.hpp"
#include "support/data_folder.hpp"
#include "support/files.hpp"

namespace crossgrain {
namespace {

ProgramCall yadeCommand() {
  // Without display, leave when the script ends, one thread: sums in one order.
  return std::vector<std::string>{"yade", "-n", "-x", "-j1", workerScript("yade").string()};
}

std::string yadeMissing() {
  if (!isOnPath("yade"))
    return "there is no program 'yade' in PATH (Debian and Ubuntu: package yade)";
  return workerScriptMissing("yade");
}

}  // namespace

/// YADE executes engines/yade/worker.py, which speaks the worker protocol.
EngineEntry yadeEngine() {
  return {.name = "yade",
          .summary =
              "YADE, its viscoelastic, cohesive-frictional, Luding and Hertz-Mindlin laws on "
              "spheres kept in a plane, or in space",
          .command = yadeCommand,
          .missing = yadeMissing};
}

/// Law2_ScGeom_ViscElPhys_Basic, …6D_CohFrictPhys_CohesionMoment, …LudingPhys_Basic or
/// …MindlinPhys_Mindlin, which share conventions, and NewtonIntegrator (engines/yade/README.md).
EngineEntry yadeMirror() {
  return mirrorEntry("grain-as-yade", "the in-house engine with YADE's conventions", "yade",
                     {"linear", "hertz"}, conventionsOf(nlohmann::json::parse(yadeLaw)));
}

}  // namespace crossgrain
