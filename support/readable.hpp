#pragma once

#include <optional>
#include <string>

/// Numbers for people to read, as plain text.
namespace crossgrain::inline support {

inline constexpr const char* absentText = "–";  ///< of what is absent, or not finite

/// Three significant digits: 0.0123, 12.3, 12 346, 1.23×10⁻⁵.
std::string readable(std::optional<double> value);

/// What somebody chose, with the digits that were given, up to four: 352.1, 0.25, 4×10⁻⁵.
std::string readableSetting(std::optional<double> value);

/// A count, with spaces between thousands.
std::string readableCount(std::optional<double> value);

/// Value and standard error, both to the error's second digit: 0.242 ± 0.013; where the value would
/// have more than six digits, the error by itself: 0.0183780 ± 2.0×10⁻¹⁰.
std::string readable(std::optional<double> value, std::optional<double> error);

}  // namespace crossgrain::inline support
