#pragma once

namespace crossgrain::inline runs {

inline constexpr const char* programVersion = CROSSGRAIN_VERSION;

/// The source that this was built from, as far as git could tell when it was configured: runs of
/// another build are not taken up.
inline constexpr const char* programBuild = CROSSGRAIN_BUILD;

}  // namespace crossgrain::inline runs
