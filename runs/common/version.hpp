#pragma once

#include <string>

namespace crossgrain::inline runs {

extern const char* const programVersion;

/// The source that this was built from, as far as git could tell when it was configured: runs of
/// another build are not taken up.
extern const char* const programBuild;

/// "0.3.0 (7902f0e)"
std::string thisProgram();

}  // namespace crossgrain::inline runs
