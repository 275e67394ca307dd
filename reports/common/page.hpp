#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/common/details.hpp"
#include "reports/common/engines.hpp"
#include "reports/common/pages.hpp"
#include "results/head.hpp"

/// What all pages share. A view is the JSON that a template is filled from.
namespace crossgrain::reports {

/// Fills the template of that name; its parts may use all of the view.
/// @throws std::logic_error if a template is malformed
std::string render(const std::string& name, const Json& view);

/// "crossgrain compare: CASE, VARIANT"
std::string titleOf(const ResultsHead& head);

/// Heading, notes, machine, case text and command.
Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown);

/// Figures whose name begins so, with their SVG inside.
Json figureViews(const Illustrations& shown, std::string_view prefix);

/// Pictures of that kind.
Json pictureViews(const Illustrations& shown, Picture::Shows shows);

/// "1 field", "2 fields".
std::string counted(std::size_t count, std::string_view noun);

}  // namespace crossgrain::reports
