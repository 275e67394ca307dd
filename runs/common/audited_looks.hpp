#pragma once

#include <optional>
#include <string>

#include "adapters/audit_basis.hpp"
#include "cases/case.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

/// Looks at an engine that has loaded a scene, each held against what must be true of it
/// (adapters/audit.hpp) before anybody averages it.
class AuditedLooks {
 public:
  /// All outlive it. @param scene  the case's; what the case lets the engine make of it is worked
  ///                               out here
  AuditedLooks(Engine& engine, const EngineEntry& entry, const Case& setup, const Scene& scene,
               const Realised& realised);
  AuditedLooks(const AuditedLooks&) = delete;
  AuditedLooks& operator=(const AuditedLooks&) = delete;

  /// @param reached  what advance() returned last; absent: not known, as after restore() [s]
  /// @throws EngineFailure of one line: engine, case, time, and what cannot be
  Snapshot look(ContactReport contacts, std::optional<double> reached) const;
  /// The same of a snapshot that is there.
  void require(const Snapshot& seen, std::optional<double> reached) const;

  /// Of a run that was not taken up in the middle. @throws EngineFailure likewise
  Stats stats(double reached) const;

 private:
  [[noreturn]] void fail(double time, const std::string& why) const;

  Engine& engine_;
  const Case& setup_;
  const Realised& realised_;
  Scene scene_;
  AuditBasis basis_;
};

}  // namespace crossgrain::inline runs
