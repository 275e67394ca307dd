#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// Where a command that judges has judged nothing: that is never a success by itself.
struct NothingJudged {
  std::string reason;      ///< ends the line "nothing was judged: …"
  bool byRequest = false;  ///< one engine: there was nothing to hold it against
};

/// Of a comparison: fewer than two engines, no margins, no field of two engines, or fewer packings
/// than a verdict needs. Absent where any test was made, undecided or not.
/// @param named  engines that the user named, without the mirrors that came along
std::optional<NothingJudged> nothingJudged(const Case& setup, const nlohmann::json& agreement,
                                           std::size_t named);

}  // namespace crossgrain::inline runs
