#pragma once

#include "runs/conformance/thesis_numbers.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;
}  // namespace crossgrain::test
