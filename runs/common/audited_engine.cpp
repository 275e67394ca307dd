#include "runs/common/audited_engine.hpp"

#include <fmt/format.h>

#include "adapters/audit.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

Realised AuditedEngine::load(const Scene& scene, const Settings& settings) {
  Realised realised = engine_->load(scene, settings);
  scene_ = scene;
  basis_ = auditBasis(scene_, engine_->capabilities(), realised);
  reached_ = 0.0;
  return realised;
}

double AuditedEngine::advance(double t) {
  reached_ = engine_->advance(t);
  return *reached_;
}

Snapshot AuditedEngine::snapshot(ContactReport contacts) {
  Snapshot seen = engine_->snapshot(contacts);
  if (const std::string why = whyUnsound(seen, basis_, reached_); !why.empty()) {
    distrust(*engine_);
    throw EngineFailure(fmt::format("{}, {} at t = {:g} s: its snapshot cannot be: {}", name_,
                                    scene_.name, reached_.value_or(seen.positionTime), why));
  }
  return seen;
}

void AuditedEngine::restore(const std::filesystem::path& file) {
  engine_->restore(file);
  reached_.reset();
}

}  // namespace crossgrain::inline runs
