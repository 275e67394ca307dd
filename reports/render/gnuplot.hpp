#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/common/figure.hpp"

namespace crossgrain::reports {

/// gnuplot is not installed, or stopped; what() is one line.
struct GnuplotError : std::runtime_error {
  explicit GnuplotError(const std::string& what, bool there = true)
      : std::runtime_error(what), failed(there) {}
  bool failed;  ///< it is there and failed; else it is the user's to install
};

/// Writes name.dat and name.gp; run in that folder, the script makes name.svg and name.pdf (and
/// name.png). @returns the script's file name
std::string writeFigure(const Figure& figure, const std::filesystem::path& dir);

/// Runs the scripts in gnuplot, some processes side by side, in that folder. The user's own gnuplot
/// settings are not read and no shell is involved. What gnuplot says is kept in dir/gnuplot.log.
/// @throws GnuplotError
void runGnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& dir);

}  // namespace crossgrain::reports
