#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/packing.hpp"

/// Runs of the in-house engine whose truth is known: repeats of one case, and repeats with a fault.
namespace crossgrain::coverage {

/// One way to run a packing.
struct Leg {
  std::string name;  ///< "" is the case itself; goes into "without" of its runs
  std::function<void(Case&)> plant;
  bool nudged = false;  ///< every disk moved by 10⁻⁸ d: the same packing, another trajectory
};

/// The case; again, nudged; k_n +10 %; µ −10 %; tension cut.
const std::vector<Leg>& legs();

/// @throws std::invalid_argument if there is no leg of that name
const Leg& leg(const std::string& name);

/// Packing `index` of the case, prepared by the in-house engine or from the cache.
Packing prepared(const Case& setup, int index);

/// Settles and averages one packing in windows that follow each other. Entries as in results.json's
/// "runs", with "window" and "rotations" (that it averages over) beside them. With `whole`, the
/// last entry averages over all windows.
std::vector<nlohmann::json> run(const Case& setup, const Packing& packing, int index,
                                const Leg& leg, int windows, bool whole);

}  // namespace crossgrain::coverage
