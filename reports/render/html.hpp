#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "reports/common/report.hpp"

/// A report as an HTML file that opens offline and prints.
namespace crossgrain::reports {

/// A report's figures and pictures.
struct DrawnFigures {
  std::filesystem::path folder = {};        ///< where they are, NAME.svg each
  std::optional<std::string> missing = {};  ///< why there are none; absent: there are
  /// The page of a site shows them from plots/ beside it; else the page holds them itself.
  bool ofSite = false;
};

std::string html(const Report& report, const DrawnFigures& drawings);

/// Its matrix.
std::string htmlMatrix(const Overview& overview, const std::vector<EngineRow>& engines);

/// A file of reports/page, kept in the program at build time, by its name.
const std::string& pageFile(const std::string& name);

/// Base64 of RFC 4648, padded, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace crossgrain::reports
