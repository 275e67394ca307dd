#pragma once

#include <optional>
#include <span>
#include <string>

#include "cases/case.hpp"
#include "results/compare.hpp"
#include "runs/common/run_store.hpp"

namespace crossgrain::inline runs {

/// Prepares the case's packings, holds every engine against its mirror in lockstep, if the case
/// wants mirrors, from so many starts; runs the engines on them, side by side where `jobs` allows,
/// averages, and holds the engines against each other, look by look (looks.hpp). Every finished
/// run is kept in the store at once; a failed one ends by itself and is reported.
/// @param budget  no further look begins that would end later [s]
/// @throws BadInput, UnsupportedScene (an engine named cannot run the case), Interrupted
CompareResults compareEngines(const Case& setup, const RunCommand& command, RunStore& store,
                              std::size_t starts, double budget);

/// What that would run, for people. Engines are asked what they can do; nothing is computed.
/// @throws BadInput, UnsupportedScene, Interrupted
std::string comparePlan(const Case& setup, const RunCommand& command, RunStore& store);

/// Of a comparison: fewer than two engines, no margins, no endpoint of two engines, or fewer
/// packings than a verdict needs. Absent where any test was made, undecided or not.
/// @param named  engines that the user named, without the mirrors that came along
std::optional<NothingJudged> nothingJudged(const Case& setup, std::span<const EndpointRow> rows,
                                           std::size_t named);

}  // namespace crossgrain::inline runs
