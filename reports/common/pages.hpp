#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/json_view.hpp"
#include "reports/common/pictures.hpp"

namespace crossgrain::reports {

/// What was drawn into the folder plots.
struct Illustrations {
  const std::vector<Figure>& figures;
  const std::vector<Picture>& pictures;
  std::filesystem::path plots;
  std::optional<std::string> missing;  ///< why there are no plots: none is shown then
};

/// One page each, HTML with everything inside: no scripts and nothing to fetch.
std::string collidePage(const Json& results, const Illustrations& shown);
std::string stabilityPage(const Json& results, const Illustrations& shown);
std::string costPage(const Json& results, const Illustrations& shown);

}  // namespace crossgrain::reports
