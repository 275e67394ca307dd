#include "runs/thesis/carrying.hpp"

#include <algorithm>

#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "reports/lockstep/words.hpp"
#include "runs/common/engine_access.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

std::vector<ThesisCarrier> findCarriers(const std::vector<LockstepEngine>& engines,
                                        const LadderLeg& leg, std::size_t starts,
                                        const RunCommand& command, const RunStore& store,
                                        Progress& progress) {
  const Case& setup = leg.setup;
  std::vector<LockstepEngine> held;
  std::vector<ThesisCarrier> carriers;
  for (const LockstepEngine& own : engines)
    for (const EngineEntry& mirror : mirrorsOf({own.entry}))
      if (standsForItsPeer(mirror, setup.law) && !isNamed(command.engines, mirror)) {
        held.push_back(own);
        carriers.push_back({own.entry.name, mirror.name, false, {}, 0, ""});
        break;
      }
  if (held.empty()) return {};
  const double dt = timeStep(setup);
  const auto inHouse = engineRegistry().front().make();
  const Packing packing = packingOf(setup, 0, dt, *inHouse, [](double) { throwIfInterrupted(); });
  const LockstepFindings found =
      holdAgainstMirrors(held, setup, {{packing}, dt, starts, command.jobs}, store, progress);
  for (ThesisCarrier& carrier : carriers) {
    const auto row = std::ranges::find(found.rows, carrier.engine, &LockstepRow::engine);
    if (row == found.rows.end()) continue;
    carrier.carries = row->failure.empty() && row->equivalent &&
                      (row->verdict == LockstepVerdict::sameToRounding ||
                       row->verdict == LockstepVerdict::sameLaw);
    carrier.equivalent = row->equivalent;
    carrier.starts = row->starts;
    carrier.why = row->failure.empty() ? reports::sentenceOf(*row, found.rules) : row->failure;
  }
  return carriers;
}

}  // namespace crossgrain::inline runs
