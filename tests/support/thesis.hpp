#pragma once

#include "studies/conformance/thesis_numbers.hpp"

namespace crossgrain::test {
using namespace crossgrain::conformance;

}  // namespace crossgrain::test
