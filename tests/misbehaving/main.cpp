#include <cstdio>
#include <string>

#include "adapters/grain.hpp"
#include "adapters/worker/serve.hpp"
#include "tests/misbehaving/misbehaving_engine.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs(
        "usage: misbehaving_engine MISCHIEF STEP, as a worker: tests/misbehaving/entries.hpp\n",
        stderr);
    return 2;
  }
  crossgrain::test::MisbehavingEngine engine(crossgrain::makeGrain(), argv[1],
                                             std::stoull(argv[2]));
  return crossgrain::serve(engine);
}
