#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string_view>

#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"
#include "tests/conformance/names.hpp"

namespace crossgrain::test {
namespace {

/// Writes one ctest entry for each engine, since a worker takes seconds to start, and one for what
/// concerns none.
int writeTests(const std::string& program, const std::string& file) {
  std::ofstream out(file);
  const auto write = [&](const std::string& name, const std::string& filter) {
    out << fmt::format("add_test([[conformance.{}]] [[{}]] [[--gtest_filter={}]])\n", name, program,
                       filter)
        << fmt::format("set_tests_properties([[conformance.{}]] PROPERTIES TIMEOUT 300)\n", name);
  };
  for (const EngineEntry& entry : engineRegistry()) write(entry.name, "*/" + testName(entry.name));
  write("expected-skips", "ExpectedSkips.*");
  write("planted-faults", "*PlantedFault*");
  out.close();
  return out ? 0 : 1;
}

/// What `crossgrain __serve NAME` does: this program is also the worker that it tests.
int serveEngine(const std::string& name) {
  const EngineEntry* entry = findEngine(name);
  return entry && entry->make ? serve(*entry->make()) : 2;
}

}  // namespace
}  // namespace crossgrain::test

int main(int argc, char** argv) {
  using namespace crossgrain::test;
  gsl_set_error_handler_off();  // as in cli/main.cpp
  if (argc == 3 && std::string_view(argv[1]) == "__serve") return serveEngine(argv[2]);
  if (argc == 3 && std::string_view(argv[1]) == "--write-tests")
    return writeTests(argv[0], argv[2]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
