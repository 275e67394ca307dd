#include "runs/common/version.hpp"

namespace crossgrain::inline runs {

const char* const programVersion = CROSSGRAIN_VERSION;
const char* const programBuild = CROSSGRAIN_BUILD;

}  // namespace crossgrain::inline runs
