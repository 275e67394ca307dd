#include "runs/lockstep/responses.hpp"

#include <algorithm>

#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"

namespace crossgrain::inline runs {

Responses yardstickResponses(Engine& engine, const std::vector<LockstepFrame>& unchanged,
                             double diameter, const std::function<double(double)>& load) {
  Responses responses(unchanged.size(), std::vector<double>(yardstickChanges.size(), 0.0));
  for (std::size_t c = 0; c < yardstickChanges.size(); ++c)
    for (const double sign : {1.0, -1.0}) {
      const double step = load(sign * yardstickChanges[c]);
      std::vector<std::uint64_t> steps;
      for (const LockstepFrame& frame : unchanged) steps.push_back(stepsUntil(frame.time, step));
      const auto moved = follow(engine, step, steps);
      for (std::size_t k = 0; k < unchanged.size(); ++k)
        responses[k][c] =
            std::max(responses[k][c], farthest(moved[k], unchanged[k], diameter).distance);
    }
  return responses;
}

}  // namespace crossgrain::inline runs
