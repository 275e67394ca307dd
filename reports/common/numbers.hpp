#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "support/readable.hpp"

/// Numbers for people to read, as plain text. Absent is "–".
namespace crossgrain::reports {

using support::absentText;
using support::readable;
using support::readableCount;
using support::readableSetting;

/// Absent where it is not finite, too.
std::optional<double> finite(std::optional<double> value);

/// The k-th of a list; absent where that is shorter.
std::optional<double> at(const std::vector<std::optional<double>>& list, std::size_t k);
std::optional<double> at(const std::vector<double>& list, std::size_t k);

/// Value and standard error with the sign always there, for differences.
std::string readableDifference(std::optional<double> value, std::optional<double> error);

/// A fraction ≥ 0 in per cent, whole or, below one, to its first digit: "40", "0.3".
std::string readablePercent(double fraction);

/// To two significant digits: of errors.
std::string shortly(std::optional<double> value);

/// value · factor, where there is a value.
std::optional<double> times(std::optional<double> value, double factor);

/// 0.42 s, 12.3 s, 4 min 12 s, 1 h 02 min.
std::string readableDuration(std::optional<double> seconds);

/// The same with shorter units for what is below a second: 45.1 µs, 2.38 ms.
std::string shortDuration(std::optional<double> seconds);

}  // namespace crossgrain::reports
