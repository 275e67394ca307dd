#pragma once

#include "runs/conformance/scene_parts.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;
}  // namespace crossgrain::test
