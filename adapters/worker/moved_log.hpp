#pragma once

#include <filesystem>

namespace crossgrain {

/// A worker that goes on to another run keeps writing to the file that it was started with. From
/// here on that file has the name `to`, and what was said before stays, as a copy, under `from`: a
/// run's log is what was said during that run.
/// @pre the worker appends to it
/// @throws std::runtime_error if `from` is no file of text any more, or `to` is on another disk
void moveLog(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace crossgrain
