// coverage CASE RUNS.jsonl… > coverage.csv
//   counts on what coverage_runs has written; runs of several windows go to the study of bars
//   within a run, all others to those of ensembles, false alarms, power and planted faults
#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "cases/loader.hpp"
#include "tests/coverage/legs.hpp"
#include "tests/coverage/studies.hpp"

using namespace crossgrain;

namespace {

void print(const std::vector<coverage::Rate>& rates) {
  for (const auto& rate : rates) {
    const bool share = !rate.study.ends_with("_ratio");
    fmt::print("{},{},{},{},{},{},{:.4f},{}\n", rate.study, rate.leg, rate.field,
               rate.ring ? std::to_string(*rate.ring + 1) : "all", rate.packings, rate.independent,
               rate.value, share ? fmt::format("{:.4f}", rate.error()) : "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3) throw BadInput("usage: coverage CASE RUNS.jsonl...");
    const Case setup = loadCase(argv[1]).front();
    coverage::Sample sample{&setup, {}};
    std::vector<coverage::WindowRun> windows;
    for (int k = 2; k < argc; ++k) {
      std::ifstream file(argv[k]);
      std::vector<coverage::WindowRun> entries;
      bool several = false;
      for (std::string line; std::getline(file, line);) {
        entries.push_back(readAs<coverage::WindowRun>(Json::parse(line)));
        several |= entries.back().window != 0;
      }
      for (coverage::WindowRun& entry : entries) {
        if (several) {
          windows.push_back(std::move(entry));
          continue;
        }
        sample.packings = std::max(sample.packings, static_cast<std::size_t>(entry.packing) + 1);
        sample.runs.push_back(std::move(entry));
      }
    }
    fmt::print("study,leg,field,ring,packings,independent,value,stderr\n");
    print(coverage::withinRuns(setup, windows));
    if (sample.runs.empty()) return 0;
    print(coverage::looks(sample));
    for (const int group : {4, 6, 8}) {
      print(coverage::ensembles(sample, group));
      print(coverage::disagreements(sample, "", group));
      print(coverage::power(sample, group));
    }
    for (const auto& leg : coverage::legs())
      for (const int group : {4, 8, 24, 100})
        if (!leg.name.empty()) print(coverage::disagreements(sample, leg.name, group));
  } catch (const std::exception& error) {
    std::cerr << "coverage: " << error.what() << '\n';
    return 2;
  }
}
