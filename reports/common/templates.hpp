#pragma once

#include <map>
#include <string>

namespace crossgrain::reports {

/// The files of reports/templates, kept in the program at build time, by name without ".mustache".
const std::map<std::string, std::string>& templates();

}  // namespace crossgrain::reports
