#include "runs/baseline/kept_endpoints.hpp"

#include "runs/couette/endpoint_table.hpp"
#include "runs/couette/endpoint_values.hpp"
#include "runs/couette/run.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {

KeptEndpoints endpointsFrom(const EngineEntry& entry, const Case& setup,
                            const std::vector<FlowState>& starts, double dt,
                            const std::function<void(double)>& progress) {
  Case quiet = setup;
  quiet.run.keepSnapshots = 0;
  const ScratchFolder scratch;
  KeptEndpoints kept;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const CouetteTask task{&quiet,
                           entry,
                           static_cast<int>(s),
                           &starts[s].packing,
                           dt,
                           scratch.path / "worker",
                           scratch.path / "snapshots.h5",
                           scratch.path / "unfinished",
                           starts[s].packing.hash};
    const CouetteRun run = runCouette(task, [&](double fraction) {
      progress((static_cast<double>(s) + fraction) / static_cast<double>(starts.size()));
    });
    for (const auto& [name, margin] : setup.averaging.endpoints)
      kept[name].push_back(endpointOf(endpointSpec(name), setup, run));
  }
  return kept;
}

std::vector<EndpointRow> endpointChanges(const Case& setup, const KeptEndpoints& before,
                                         const KeptEndpoints& now,
                                         const std::pair<std::string, std::string>& names) {
  std::vector<EndpointValues> family;
  for (const EndpointSpec& endpoint : endpointTable()) {
    const std::string name(endpoint.name);
    if (before.contains(name) && now.contains(name) && setup.averaging.endpoints.contains(name))
      family.push_back({name, before.at(name), now.at(name)});
  }
  if (family.empty()) return {};
  const int starts = static_cast<int>(family.front().reference.size());
  return endpointRows(setup, family, names, looksAt(starts, 1, 1.0 - setup.averaging.confidence));
}

}  // namespace crossgrain::inline runs
