#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/view.hpp"

namespace crossgrain::reports {

/// What was drawn into the folder plots.
struct Illustrations {
  const std::vector<Figure>& figures;
  std::filesystem::path plots;
  std::optional<std::string> missing;  ///< why there are no plots: none is shown then
};

}  // namespace crossgrain::reports
