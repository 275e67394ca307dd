#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "adapters/worker/exchange.hpp"

namespace crossgrain {

/// A field or an array that two answers to one request do not have alike.
struct AnswerDifference {
  std::string field;  ///< "snapshot.bodies.0.torque", "position"
  std::string
      place;  ///< in an array, where it is largest: "[17]", or the contact's ids; else empty
  std::string then, now;           ///< there
  std::optional<double> off;       ///< |now − then| there, of numbers, in the field's unit
  std::size_t differ = 1, of = 1;  ///< elements
};

/// What differs between two answers to one request: arrays first, in the order of the earlier
/// answer, then the other fields. Contacts are held against each other by their ids, whatever
/// order they are listed in. Not compared: names and versions of the engine, times of clocks, the
/// layout of files, and why there is no answer where both have none.
/// @param tolerance  numbers that differ by no more than this part of the largest of their array,
///                   or of the larger of the two, are alike
/// @param scratch    folder for array files
std::vector<AnswerDifference> answerDifferences(const Exchange& then, const Exchange& now,
                                                double tolerance,
                                                const std::filesystem::path& scratch);

}  // namespace crossgrain
