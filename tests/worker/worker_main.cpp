#include <gtest/gtest.h>

#include <string_view>

#include "tests/worker/toy_engine.hpp"

// The test program is also the worker that it tests.
int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--worker")
    return crossgrain::test::toyWorker(argv[2]);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
