#pragma once

#include "results/compare.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// Kind "lockstep".
struct LockstepResults : FlowStudy {
  LockstepFindings lockstep;

  void fields(auto& io) {
    FlowStudy::fields(io);
    io("lockstep", lockstep);
  }
};

Json toJson(const LockstepResults& results);
/// @throws FieldError
LockstepResults lockstepFromJson(const Json& json);

}  // namespace crossgrain::inline results
