#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/flow/engine_runs.hpp"

namespace crossgrain::reports {

/// Whose curve of a field has nothing to say: it is drawn grey, behind the others, without a name.
using IsFaint = std::function<bool(const EngineRuns&, const std::string& field)>;

/// The parts of compareFigures. A check of a single number is no plot.
std::vector<Figure> profileFigures(const FlowFrame& frame, const std::vector<EngineRuns>& engines,
                                   const IsFaint& faint = {});
/// difference_FIELD: engines minus the reference, ring by ring, in margins, with the margin's band.
std::vector<Figure> differenceFigures(const CompareResults& results,
                                      const std::vector<EngineRuns>& engines);
std::vector<Figure> distributionFigures(const FlowFrame& frame,
                                        const std::vector<EngineRuns>& engines);

/// What the bars of the profiles are, in words: over packings, or within one run.
std::string describeBars(const std::vector<EngineRuns>& engines);

/// Where the bins of profiles are, on the axis of that name: (r − R_i)/d, or a coordinate in m.
/// Those of a grid are nowhere (NaN).
const std::vector<double>& binPlaces(const FlowFrame& frame);
std::string binAxis(const FlowFrame& frame);
/// "ring", or "bin" of an assembly.
const char* binWord(const FlowFrame& frame);

/// The radial axis of a cell, from the wheel to the ring; absent without a cell.
std::optional<Range> rTildeRange(const FlowFrame& frame);

}  // namespace crossgrain::reports
