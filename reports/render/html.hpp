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

// Its parts.

/// From the document's first line to its title.
std::string htmlHead(const Report& report);
/// @param wrapped  every cell has its question, and those without one are left out: for rows that
///                 share few questions
std::string htmlMatrix(const Overview& overview, const std::vector<EngineRow>& engines,
                       bool wrapped = false);
/// One of its figures or pictures; empty where it was not drawn.
std::string htmlDrawing(const Report& report, const std::string& name,
                        const std::filesystem::path& plots);
/// The legend of the engines' colours.
std::string htmlLegend(const std::vector<EngineRow>& engines);
/// The case, the files, and how to make the page again, to the document's last line.
std::string htmlFoot(const Report& report);

/// A file of reports/page, kept in the program at build time, by its name.
const std::string& pageFile(const std::string& name);

/// Base64 of RFC 4648, padded, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace crossgrain::reports
