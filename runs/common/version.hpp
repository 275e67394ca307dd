#pragma once

namespace crossgrain::inline runs {

extern const char* const programVersion;

/// The source that this was built from, as far as git could tell when it was configured: runs of
/// another build are not taken up.
extern const char* const programBuild;

}  // namespace crossgrain::inline runs
