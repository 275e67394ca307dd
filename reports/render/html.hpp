#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "reports/common/report.hpp"

/// A report as one HTML file that opens offline and prints.
namespace crossgrain::reports {

/// @param plots  where its figures and pictures were drawn, NAME.svg each
/// @param missing  why there are none; absent: there are
std::string html(const Report& report, const std::filesystem::path& plots,
                 const std::optional<std::string>& missing);

/// Its matrix.
/// @param wrapped  every cell has its question, and those without one are left out: for rows that
///                 share few questions
std::string htmlMatrix(const Overview& overview, const std::vector<EngineRow>& engines,
                       bool wrapped = false);

/// A file of reports/page, kept in the program at build time, by its name.
const std::string& pageFile(const std::string& name);

/// Base64 of RFC 4648, padded, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace crossgrain::reports
