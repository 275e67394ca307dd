#include <gtest/gtest.h>

#include <string_view>

#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"

// The test program serves the engines of this build, as crossgrain does: it is what their workers
// are started from.
int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "__serve")
    return crossgrain::serve(*crossgrain::findEngine(argv[2])->make());
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
