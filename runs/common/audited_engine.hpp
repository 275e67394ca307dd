#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "adapters/audit_basis.hpp"

namespace crossgrain::inline runs {

/// An engine whose every snapshot is held against what must be true of it (adapters/audit.hpp)
/// before anybody sees it; all else is handed on.
class AuditedEngine final : public Engine {
 public:
  AuditedEngine(std::string name, std::unique_ptr<Engine> engine)
      : name_(std::move(name)), engine_(std::move(engine)) {}

  Capabilities capabilities() const override { return engine_->capabilities(); }
  Realised load(const Scene& scene, const Settings& settings) override;
  double advance(double t) override;
  /// @throws EngineFailure of one line: engine, scene, time, and what cannot be
  Snapshot snapshot(ContactReport contacts) override;
  Stats stats() const override { return engine_->stats(); }
  void checkpoint(const std::filesystem::path& file) override { engine_->checkpoint(file); }
  void restore(const std::filesystem::path& file) override;

  Engine& inner() { return *engine_; }

 private:
  std::string name_;
  std::unique_ptr<Engine> engine_;
  Scene scene_;  ///< as the engine was given it
  AuditBasis basis_;
  std::optional<double> reached_;  ///< what advance() returned last; absent: not known [s]
};

}  // namespace crossgrain::inline runs
