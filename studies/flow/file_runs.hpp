#pragma once

#include <functional>
#include <memory>
#include <string>

#include "adapters/engine_entry.hpp"
#include "adapters/snapshot_source.hpp"
#include "cases/case.hpp"
#include "results/run.hpp"

/// Runs that somebody else has done and that are here as files.
namespace crossgrain::inline studies {

/// Whether a name of --engines is that of files: "NAME=PATTERN".
bool namesFiles(const std::string& text);

/// The engine that such a text names: NAME, and its runs from all files that match the PATTERN of a
/// shell (*, ?, [a-z]). @throws BadInput for a name that an engine has, a pattern that no file
/// matches, files of several formats, or of none that is known
EngineEntry engineOfFiles(const std::string& text);

/// The snapshots of one of its runs. @throws BadInput naming the file and what does not fit
std::unique_ptr<SnapshotSource> openRun(const Case& setup, const EngineEntry& entry,
                                        std::size_t run);

/// What a run of files depends on: names, sizes and times of change of its files.
std::string fingerprintOf(const EngineEntry& entry, std::size_t run);

/// Averages a run of files as one of an engine: of an assembly what is later than average.from, of
/// a cell, whose time nobody knows, all.
/// @param progress  called with the fraction done, 0 … 1
/// @throws BadInput; Interrupted
FlowRun averagedRun(const Case& setup, SnapshotSource& source,
                    const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies
