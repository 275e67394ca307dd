// The in-house engine in disguise, as a worker:
//     disguised_engine [turn=RAD] [mirror=1] [length=F] [mass=F] [time=F] [order=SEED] [nudge=SEED]
//     [restart=N]
#include <cstdio>
#include <exception>
#include <string>

#include "adapters/worker/serve.hpp"
#include "support/scratch_folder.hpp"
#include "tests/faults/disguise/disguised_engine.hpp"

namespace {

using crossgrain::test::Disguise;

/// @returns whether it is one
bool take(Disguise& disguise, const std::string& word) {
  const auto sign = word.find('=');
  if (sign == std::string::npos) return false;
  const std::string name = word.substr(0, sign), value = word.substr(sign + 1);
  crossgrain::Transform& transform = disguise.transform;
  if (name == "turn")
    transform.placement.turn = std::stod(value);
  else if (name == "mirror")
    transform.placement.mirror = value == "1";
  else if (name == "length")
    transform.units.length = std::stod(value);
  else if (name == "mass")
    transform.units.mass = std::stod(value);
  else if (name == "time")
    transform.units.time = std::stod(value);
  else if (name == "order")
    disguise.order = std::stoull(value);
  else if (name == "nudge")
    disguise.nudge = std::stoull(value);
  else if (name == "restart")
    disguise.restartEvery = std::stoull(value);
  else
    return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) try {
  Disguise disguise;
  for (int k = 1; k < argc; ++k)
    if (!take(disguise, argv[k])) {
      std::fprintf(stderr, "%s is not NAME=VALUE of a disguise\n", argv[k]);
      return 2;
    }
  const crossgrain::ScratchFolder scratch;
  crossgrain::test::DisguisedEngine engine(disguise, scratch.path);
  return crossgrain::serve(engine);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
