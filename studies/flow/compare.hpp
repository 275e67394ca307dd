#pragma once

#include <optional>
#include <span>
#include <string>

#include "cases/case.hpp"
#include "results/compare.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct CompareOptions {
  bool strict = false;
  std::optional<std::string> budget;     ///< absent: looks.budget of the case
  std::optional<std::string> reference;  ///< absent: the first engine named; "none": the median
  bool causes = false;                   ///< of all differences, however long they take
  std::optional<std::string> causesOf;   ///< and of this field, bin by bin
  bool noCauses = false;                 ///< of none
};

/// Prepares the case's packings, compares every engine with its mirror in lockstep, if the case
/// wants mirrors; runs the engines on them, side by side where `jobs` allows, averages, and
/// compares the engines with each other, one interim analysis after the other
/// (interim_analyses.hpp). Every finished run is kept in the store at once; a failed one ends by
/// itself and is reported. Then causes of the differences that were seen (causes.hpp), in a fifth
/// of all the time at most unless all are asked for.
/// @throws BadInput, AllRefused (where fewer than two can run the case), Interrupted
extern const Study<CompareOptions, CompareResults> compareStudy;

/// Of a comparison: fewer than two engines, no margins, no endpoint of two engines, or fewer
/// packings than a verdict needs. Absent where any test was made, undecided or not.
/// @param named  engines that the user named, without the mirrors that came along
std::optional<NothingJudged> nothingJudged(const Case& setup, std::span<const EndpointRow> rows,
                                           std::size_t named);

}  // namespace crossgrain::inline studies
