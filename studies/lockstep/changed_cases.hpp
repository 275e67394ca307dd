#pragma once

#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline studies {

/// By which constants are changed to see how averages respond, relative: ten times what lockstep's
/// yardstick is read off at, so that it shows in averages.
inline constexpr double responseChange = 0.1;

/// A case with one constant of its law larger by responseChange.
struct ChangedCase {
  std::string constant;  ///< "kn"
  std::string name;      ///< of its runs, "kn+10%"
  Case setup;
};

/// Changes the yardstick, or µ, by that part of itself. @param constant  by name
void changeConstant(ContactLaw& law, const std::string& constant, double by);

/// The constant that ε_eq is expressed in, and µ where there is friction.
std::vector<ChangedCase> changedCases(const Case& setup);

}  // namespace crossgrain::inline studies
