#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/pages.hpp"
#include "results/head.hpp"

/// What all pages share. A view is the JSON that a template is filled from.
namespace crossgrain::reports {

/// Fills the template of that name; its parts may use all of the view.
/// @throws std::logic_error if a template is malformed
std::string render(const std::string& name, const Json& view);

/// Heading, notes, machine, case text and command.
Json commonView(const Json& results, const Illustrations& shown);
Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown);

/// Figures whose name begins so, with their SVG inside.
Json figureViews(const Illustrations& shown, std::string_view prefix);

/// Pictures of that kind.
Json pictureViews(const Illustrations& shown, Picture::Shows shows);

/// {name, colour, dashed, hasData} for each engine.
Json columnsView(const std::vector<EngineResults>& engines);

/// "1 field", "2 fields".
std::string counted(std::size_t count, std::string_view noun);

/// One row per packing: index, seed, hash, and where it came from.
Json packingRows(const Json& results);

/// Rings, weights and snapshots that the profiles are means over.
std::string averagesInWords(const Json& results);

/// What an engine made of a scene.
struct RealisedOf {
  std::string engine;
  const Json* realised;
  const Json* calledFor;  ///< names of the effects that this scene calls for; no list: not known
};
/// Rows of the tables of deviations, pairs and effects, set in view.
void addDetails(Json& view, const std::vector<RealisedOf>& realised);

}  // namespace crossgrain::reports
