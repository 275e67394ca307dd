#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Numbers for people to read, as plain text. Absent is "–".
namespace crossgrain::inline support {

inline constexpr const char* absentText = "–";

/// Absent where it is not finite, too.
std::optional<double> finite(std::optional<double> value);

/// The k-th of a list; absent where that is shorter.
std::optional<double> at(const std::vector<std::optional<double>>& list, std::size_t k);
std::optional<double> at(const std::vector<double>& list, std::size_t k);

/// Three significant digits: 0.0123, 12.3, 12 346, 1.23×10⁻⁵.
std::string readable(std::optional<double> value);

/// A number that somebody chose, with the digits that were given, up to four: 352.1, 0.25, 4×10⁻⁵.
std::string readableSetting(std::optional<double> value);

/// "1 field", "2 fields", "3 bodies"
std::string counted(std::size_t count, std::string_view noun);

/// A count, with spaces between thousands.
std::string readableCount(std::optional<double> value);

/// Value and standard error, both to the error's second digit: 0.242 ± 0.013; where the value would
/// have more than six digits, the error by itself: 0.0183780 ± 2.0×10⁻¹⁰. An error that is rounding
/// is none.
std::string readable(std::optional<double> value, std::optional<double> error);

/// Two values with as many digits as tell them apart, three at least; what rounding does is no
/// difference: 0.06882 and 0.06885.
std::pair<std::string, std::string> readablePair(std::optional<double> a, std::optional<double> b);

/// The same with the sign always there, for differences.
std::string readableDifference(std::optional<double> value, std::optional<double> error);

enum class Sign { ofAll, ofNegative };

/// A value and its interval, all to the second digit of half of that, and to more where the value
/// and an end would be one text: "−0.0083 (−0.0155 to −0.0008)", "49 margins (46 to 52)".
/// Without an interval, or where its ends are one number, the value alone.
/// @param unit  after the value, with the space before it
/// @param sign  of all: of differences
std::string readableInterval(std::optional<double> value, std::optional<double> low,
                             std::optional<double> high, std::string_view unit = "",
                             Sign sign = Sign::ofNegative);

/// Two ends with as many digits as tell them apart: "46 to 52"; one number where they are one.
std::string readableRange(std::optional<double> low, std::optional<double> high);

/// "1.2 ms (1.1 ms to 1.3 ms)" of texts; the value alone where both ends are one text.
std::string withEnds(const std::string& value, const std::string& low, const std::string& high);

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

}  // namespace crossgrain::inline support
