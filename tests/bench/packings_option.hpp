#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "cases/preparation.hpp"

namespace crossgrain::bench {

/// Takes --packings=DIR out of a benchmark's arguments: where packings are kept, else the folder of
/// the harness' own.
inline std::filesystem::path takePackingFolder(int& argc, char** argv) {
  constexpr std::string_view option = "--packings=";
  for (int k = 1; k < argc; ++k) {
    if (!std::string_view(argv[k]).starts_with(option)) continue;
    const std::filesystem::path folder = std::string_view(argv[k]).substr(option.size());
    std::move(argv + k + 1, argv + argc, argv + k);
    --argc;
    return folder;
  }
  return packingCacheFile("").parent_path();
}

/// The main() of a program of benchmarks on packings, which are kept in `packings`.
inline int runBenchmarks(int argc, char** argv, std::filesystem::path& packings,
                         void (*registerAll)()) {
  packings = takePackingFolder(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  registerAll();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace crossgrain::bench
