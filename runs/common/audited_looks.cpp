#include "runs/common/audited_looks.hpp"

#include <fmt/format.h>

#include "adapters/audit.hpp"

namespace crossgrain::inline runs {

AuditedLooks::AuditedLooks(Engine& engine, const EngineEntry& entry, const Case& setup,
                           const Scene& scene, const Realised& realised)
    : engine_(engine),
      setup_(setup),
      realised_(realised),
      scene_(sceneFor(engine.capabilities(), entry, setup, scene).scene),
      basis_(auditBasis(scene_, engine.capabilities(), realised)) {}

Snapshot AuditedLooks::look(ContactReport contacts, std::optional<double> reached) const {
  Snapshot seen = engine_.snapshot(contacts);
  require(seen, reached);
  return seen;
}

void AuditedLooks::require(const Snapshot& seen, std::optional<double> reached) const {
  if (const std::string why = whyUnsound(seen, basis_, reached); !why.empty())
    fail(reached.value_or(seen.positionTime), "its snapshot cannot be: " + why);
}

Stats AuditedLooks::stats(double reached) const {
  Stats stats = engine_.stats();
  if (const std::string why = whyNoStats(stats, realised_.dt, reached); !why.empty())
    fail(reached, "its stats cannot be: " + why);
  return stats;
}

void AuditedLooks::fail(double time, const std::string& why) const {
  distrust(engine_);
  throw EngineFailure(
      fmt::format("{}, {} at t = {:g} s: {}", realised_.engine, setup_.name, time, why));
}

}  // namespace crossgrain::inline runs
