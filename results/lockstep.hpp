#pragma once

#include "results/compare.hpp"

namespace crossgrain::inline results {

/// Kind "lockstep".
struct LockstepResults : FlowStudy {
  LockstepFindings lockstep;
};

Json toJson(const LockstepResults& results);
/// @throws FieldError
LockstepResults lockstepFromJson(const Json& json);

}  // namespace crossgrain::inline results
