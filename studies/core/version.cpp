#include "studies/core/run_store.hpp"

#include <fmt/format.h>

namespace crossgrain::inline studies {

const char* const programVersion = CROSSGRAIN_VERSION;
const char* const programBuild = CROSSGRAIN_BUILD;

std::string thisProgram() {
  return fmt::format("{} ({})", programVersion, programBuild);
}

}  // namespace crossgrain::inline studies
