#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/packing.hpp"
#include "results/run.hpp"

/// Runs of the in-house engine whose truth is known: repeats of one case, and repeats with a fault.
namespace crossgrain::coverage {

/// One way to run a packing.
struct Leg {
  std::string name;  ///< "" is the case itself; goes into `without` of its runs
  std::function<void(Case&)> plant;
  bool nudged = false;  ///< every disk moved by 10⁻⁸ d: the same packing, another trajectory
};

/// The case; again, nudged; k_n +10 %; µ −10 %; tension cut.
const std::vector<Leg>& legs();

/// @throws std::invalid_argument if there is no leg of that name
const Leg& leg(const std::string& name);

/// Packing `index` of the case, prepared by the in-house engine or from the cache.
Packing prepared(const Case& setup, int index);

/// The profiles of one window of a run.
struct WindowRun : FlowRun {
  int window = 0;
  double rotations = 0.0;  ///< that it averages over

  void fields(auto& io) {
    FlowRun::fields(io);
    io("window", window);
    io("rotations", rotations);
  }
};

/// Settles and averages one packing in windows that follow each other. With `whole`, the last entry
/// averages over all windows.
std::vector<WindowRun> run(const Case& setup, const Packing& packing, int index, const Leg& leg,
                           int windows, bool whole);

}  // namespace crossgrain::coverage
