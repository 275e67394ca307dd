#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/sentences.hpp"
#include "results/head.hpp"
#include "results/overview.hpp"

/// For pages that are still filled from templates of their own, in the frame of all others.
namespace crossgrain::reports {

/// Fills the template of that name; its parts may use all of the view.
/// @throws std::logic_error if a template is malformed
std::string render(const std::string& name, const Json& view);

/// "Engine agreement: CASE, VARIANT"
std::string titleOf(const ResultsHead& head);

/// The frame: heading, notes, machine, case text and command.
Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown);

/// Figures whose name begins so, with their SVG inside.
Json figureViews(const Illustrations& shown, std::string_view prefix);

/// The matrix.
void addOverview(Json& view, const Overview& overview, const std::vector<EngineRow>& engines);

}  // namespace crossgrain::reports
