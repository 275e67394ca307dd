#pragma once

#include <string>

#include "results/overview.hpp"

namespace crossgrain::reports {

/// A number of one engine that its report's matrix does not have, with its answer if it has one.
struct DigestValue {
  std::string engine, quantity;
  OverviewCell cell;
};

}  // namespace crossgrain::reports
