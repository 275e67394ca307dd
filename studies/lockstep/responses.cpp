#include "studies/lockstep/responses.hpp"

#include <algorithm>
#include <iterator>

#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"

namespace crossgrain::inline studies {

Responses referenceResponses(Engine& engine, const std::vector<LockstepFrame>& unchanged,
                             double diameter, const std::function<double(double)>& load) {
  Responses responses(unchanged.size());
  for (const double change : referencePerturbations) {
    const double step = load(change);
    std::vector<std::uint64_t> steps;
    for (const LockstepFrame& frame : unchanged) steps.push_back(stepsUntil(frame.time, step));
    const auto moved = follow(engine, step, steps);
    for (std::size_t k = 0; k < unchanged.size(); ++k)
      std::ranges::copy(distances(moved[k], unchanged[k], diameter),
                        std::back_inserter(responses[k]));
  }
  return responses;
}

}  // namespace crossgrain::inline studies
