#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "cases/thesis_sweep.hpp"
#include "results/thesis.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct ThesisOptions {
  bool strict = false;
  std::optional<std::string> budget, earlier;  ///< as they are given
  // What follows from the command line.
  ThesisSweep sweep = {};
  double seconds = std::numeric_limits<double>::infinity();  ///< of the budget
};

/// Runs a sweep: every run that is not in the store yet, most important first, several side by
/// side; then judges the thesis' claims by all that is there. No run begins that is predicted to
/// end later than the budget; finished runs of an earlier session's results.json are taken as they
/// are. Its results are finished and failed runs, compacted; what was left out is in the notes.
/// @throws BadInput, OutputError, Interrupted
extern const Study<ThesisOptions, ThesisResults> thesisStudy;

/// The same runs, compacted, judged again by the rules that they hold.
/// @param reasons  a file of reasons, in place of those that the results hold
/// @throws BadInput for a file of reasons that is wrong
ThesisResults judgedAgain(ThesisResults results,
                          const std::optional<std::filesystem::path>& reasons = std::nullopt);

}  // namespace crossgrain::inline studies
