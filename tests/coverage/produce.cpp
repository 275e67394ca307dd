// coverage_runs CASE FIRST LAST LEGS WINDOWS >> runs.jsonl
//   runs packings FIRST … LAST of the case with each of LEGS (comma-separated; "whole" is the case
//   itself), WINDOWS windows each, one line of JSON per window and leg
#include <iostream>
#include <sstream>

#include "cases/loader.hpp"
#include "tests/coverage/legs.hpp"

using namespace crossgrain;

int main(int argc, char** argv) {
  try {
    if (argc != 6) throw BadInput("usage: coverage_runs CASE FIRST LAST LEGS WINDOWS");
    const Case setup = loadCase(argv[1]).front();
    const int windows = std::stoi(argv[5]);
    for (int index = std::stoi(argv[2]); index <= std::stoi(argv[3]); ++index) {
      const Packing packing = coverage::prepared(setup, index);
      std::istringstream names(argv[4]);
      for (std::string name; std::getline(names, name, ',');) {
        const auto& leg = coverage::leg(name == "whole" ? "" : name);
        for (const auto& entry : coverage::run(setup, packing, index, leg, windows, windows > 1))
          std::cout << jsonOf(entry) << std::endl;
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "coverage_runs: " << error.what() << '\n';
    return 2;
  }
}
