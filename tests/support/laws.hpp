#pragma once

#include "runs/conformance/thesis_laws.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;
}  // namespace crossgrain::test
