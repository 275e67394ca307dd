#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/common/junit.hpp"
#include "reports/common/view.hpp"
#include "results/engine_row.hpp"
#include "results/overview.hpp"

/// The matrix that a report opens with, in its three forms.
namespace crossgrain::reports {

/// For the page, as "overview": part_overview.mustache.
/// @param engines  of the results: rows that are engines get their colours
/// @param wrapped  every cell says its question, and those without one are left out: for rows that
///                 share few questions, and for more than mostColumns of them
void addOverview(Json& view, const Overview& overview, const std::vector<EngineRow>& engines,
                 bool wrapped = false);

/// Of more questions than these a row is wrapped on the page, and Markdown has a row for each.
inline constexpr std::size_t mostColumns = 10;

/// Of more rows than these each has only as many lines of small words on the page as the first
/// screen has room for; the rest is in the cell's title.
inline constexpr std::size_t mostRows = 6;

/// Where the terminal's form is printed.
struct TextLook {
  std::size_t width = 160;  ///< [characters]
  bool coloured = false;
};

/// The most lines that overviewText() has.
inline constexpr std::size_t mostOverviewLines = 25;

/// The matrix, aligned, its columns in several blocks where the width asks for it, and the
/// conclusion, each line ended. What does not fit is counted in a line of its own.
std::string overviewText(const Overview& overview, const TextLook& look);

/// The same as Markdown, for the pages of build servers.
/// @param title  its heading
std::string overviewMarkdown(const Overview& overview, const std::string& title);

/// The matrix as tests of a build server, one for each cell that answers a question: what holds
/// passes, a model difference too; what falls short fails; borderline, undecided and not measured
/// are skipped with their words, for nothing was shown. Figures and cells without a question are
/// left out.
/// @param group  "classname" of all
std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group);

}  // namespace crossgrain::reports
