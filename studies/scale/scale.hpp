#pragma once

#include <optional>
#include <string>

#include "results/scale.hpp"
#include "studies/core/study.hpp"

namespace crossgrain::inline studies {

struct ScaleOptions {
  std::optional<std::string> disks, threads, steps, repetitions;
};

/// Times steps of each engine on cells of growing size (cases/scaled_cell.hpp), with one worker and
/// with several. Nothing else of this command runs meanwhile; of one size all engines take turns,
/// in a fresh process for every repetition. What is timed is kept in the store at once.
///
/// The cell, its law and its packings are the study's own: settings of engines and of [run] alone
/// can be changed. A size that would take more memory than there is, judged by the size before, is
/// refused.
/// @throws BadInput, OutputError, Interrupted
extern const Study<ScaleOptions, ScaleResults> scaleStudy;

}  // namespace crossgrain::inline studies
