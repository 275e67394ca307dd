#pragma once

#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

#include "cases/loader.hpp"
#include "cases/preparation.hpp"
#include "cases/scaled_cell.hpp"
#include "support/data_folder.hpp"

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

/// The thesis' cell, which is blown up.
inline Case thesisCell() {
  return loadCase(dataFolder() / "cases/couette/nu-0.804.toml").front();
}

/// A scaled cell's packing, kept in `folder`. Says so where it has to be made.
inline Packing packedInto(const Case& scaled, const std::filesystem::path& folder) {
  bool told = false;
  return scaledPacking(scaled, folder, [&](double) {
    if (!std::exchange(told, true))
      fmt::print(stderr, "preparing {} disks, kept in {}\n",
                 couetteIn(scaled).particles.small + couetteIn(scaled).particles.large,
                 folder.string());
  });
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
