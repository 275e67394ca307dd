#pragma once

#include <string>

namespace crossgrain::reports {

/// A file of reports/page, kept in the program at build time, by its name.
const std::string& pageFile(const std::string& name);

}  // namespace crossgrain::reports
