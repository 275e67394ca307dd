#include "runs/common/advance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runs/common/engine_access.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

void advanceInPieces(Engine& engine, const Realised& realised, double from, double to) {
  const double piece = 2000.0 * realised.dt;
  for (double now = from; now < to;) {
    throwIfInterrupted();
    const double next = std::min(to, now + piece);
    const double reached = engine.advance(next);
    if (!(std::abs(reached - next) <= realised.dt)) {
      distrust(engine);
      throw EngineFailure(fmt::format("{}: asked for t = {:g} s it stopped at {:g} s",
                                      realised.engine, next, reached));
    }
    now = next;
  }
}

}  // namespace crossgrain::inline runs
