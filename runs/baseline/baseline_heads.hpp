#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "results/engine_fields.hpp"
#include "results/head_fields.hpp"
#include "results/lockstep_fields.hpp"
#include "runs/baseline/kept_endpoints.hpp"

/// The parts of a baseline's file that are JSON, and where its arrays are.
namespace crossgrain::inline runs {

/// Of a baseline, what is no array.
struct BaselineHead {
  std::string version;
  CaseHead setup;
  std::vector<LockstepStart> starts;
  std::vector<std::string> hashes;  ///< by start
  std::size_t engines = 0;
};

void fields(auto& io, BaselineHead& head) {
  io("version", head.version);
  io("case", head.setup);
  io("starts", head.starts);
  io("hashes", head.hashes);
  io("engines", head.engines);
}

/// Of a sweep of collisions, what is no array.
struct SweepHead {
  std::string name, variant, refusal;
  double dt = 0.0;                      ///< [s]
  std::vector<std::string> quantities;  ///< names of arrays
};

void fields(auto& io, SweepHead& head) {
  io("name", head.name);
  io("variant", head.variant);
  io("refusal", head.refusal);
  io("dt_s", head.dt);
  io("quantities", head.quantities);
}

/// Of an engine, what is no array.
struct BaselineEngineHead {
  std::string name, version;
  Capabilities can;
  std::optional<Realised> realised;
  std::vector<SweepHead> sweeps;
  KeptEndpoints endpoints;
};

void fields(auto& io, BaselineEngineHead& head) {
  io("name", head.name);
  io("version", head.version);
  io("capabilities", head.can);
  io("realised", head.realised);
  io("sweeps", head.sweeps);
  io("endpoints", head.endpoints);
}

inline std::string engineAttribute(std::size_t engine) {
  return fmt::format("engine-{}", engine);
}

inline std::string startGroup(std::size_t start) {
  return fmt::format("/start-{}/", start);
}

inline std::string windowGroup(std::size_t engine, std::size_t start) {
  return fmt::format("/engine-{}/window-{}/", engine, start);
}

inline std::string sweepGroup(std::size_t engine, std::size_t sweep) {
  return fmt::format("/engine-{}/sweep-{}/", engine, sweep);
}

}  // namespace crossgrain::inline runs
