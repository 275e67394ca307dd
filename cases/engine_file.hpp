#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"

namespace crossgrain::inline cases {

/// Whether a name given on the command line is a file's: it ends in .toml, or has a slash.
bool namesEngineFile(const std::string& name);

/// An engine of the user's own, from a TOML file:
///
///   name = "my-engine"       # as --engines, reports and [engines.NAME] say it
///   summary = "what it is"
///   command = ["python3", "engine.py"]  # the worker (adapters/worker/README.md), without a shell
///   folder = "."             # where it is started, relative to this file; that is the default
///   needs = ["model.bin"]    # files that it reads, without which it is not started
///   install = "make model"   # what to do where one of them is missing
///   memory = 4e9             # most address space that it may have [bytes]; no limit unless said
///   [environment]            # beside the caller's
///   OMP_NUM_THREADS = "1"
///   [settings]               # of the engine, where a case says nothing under [engines.NAME]
///
/// Its stamp holds this file's content and that of its needs and of every word of the command that
/// is a file.
/// @throws BadInput
EngineEntry loadEngineFile(const std::filesystem::path& file);

/// The same from the command line: "NAME=program and its arguments", split at blanks, started where
/// the caller is. @throws BadInput
EngineEntry engineOfCommand(const std::string& text);

/// Engines that come with the program as engine files (engine_file.hpp): engines/FOLDER/*.toml of
/// the data folder, in the order of their paths. One whose program is missing is known all the
/// same, and refused with what there is to install.
std::vector<std::filesystem::path> shelvedEngines();

}  // namespace crossgrain::inline cases
