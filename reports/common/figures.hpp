#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/figure.hpp"
#include "reports/common/json_view.hpp"

namespace crossgrain::reports {

/// Every plot of a comparison that there are data for. Names of figures: overview; profile_FIELD
/// (profile_azimuthal_velocity_log for its log axis); check_1, check_2, …; series_NAME;
/// distribution_velocities, distribution_joint, distribution_directions,
/// distribution_contacts.
std::vector<Figure> compareFigures(const Json& results);

/// Every plot of a study of effects, for each engine k = 1, 2, …: effects_k_cost, what each costs
/// and changes; effects_k_profile_FIELD, with and without.
std::vector<Figure> effectFigures(const Json& results);

/// Plots of fields against ring width: rev_FIELD.
std::vector<Figure> revFigures(const Json& results);

/// Whose curve of a field has nothing to say: it is drawn grey, behind the others, without a name.
using IsFaint = std::function<bool(const EngineResults&, const std::string& field)>;

/// The parts of compareFigures. A check of a single number is no plot.
std::vector<Figure> profileFigures(const Json& results, const std::vector<EngineResults>& engines,
                                   const IsFaint& faint = {});
std::vector<Figure> checkFigures(const Json& results, const std::vector<EngineResults>& engines);
std::vector<Figure> seriesFigures(const Json& results, const std::vector<EngineResults>& engines);

std::vector<Figure> distributionFigures(const Json& results,
                                        const std::vector<EngineResults>& engines);

/// What the bars of the profiles are, in words: over packings, or within one run.
std::string barsInWords(const std::vector<EngineResults>& engines);

/// The radial axis of a cell, from the wheel to the ring; absent without a cell.
std::optional<Range> rTildeRange(const Json& results);

}  // namespace crossgrain::reports
