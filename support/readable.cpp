#include "support/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace crossgrain::inline support {

namespace {

/// Of a value that an error stands beside: a smaller error has a power of ten of its own.
constexpr int mostValueDigits = 6;

/// The decimal exponent after rounding to that many digits: 9.996 has 1 with three of them.
int exponentOf(double value, int digits) {
  if (value == 0.0) return 0;
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  return std::stoi(rounded.substr(rounded.find('e') + 1));
}

bool plain(int exponent) {
  return exponent >= -3 && exponent <= 5;
}

std::string superscript(int value) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result;
  for (const char c : std::to_string(value)) result += c == '-' ? "⁻" : digits[c - '0'];
  return result;
}

std::string timesPowerOfTen(int exponent) {
  return "×10" + superscript(exponent);
}

/// A true minus sign, and narrow spaces between thousands.
std::string typeset(std::string number) {
  const bool negative = number.starts_with('-');
  if (negative) number.erase(0, 1);
  const auto whole = static_cast<int>(std::min(number.find('.'), number.size()));
  for (int at = whole - 3; at > 0 && whole > 4; at -= 3)
    number.insert(static_cast<std::size_t>(at), "\u202f");
  return (negative ? "−" : "") + number;
}

std::string fixed(double value, int decimals) {
  std::string result = fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (result.find_first_not_of("-0.") == std::string::npos && result.starts_with('-'))
    result.erase(0, 1);
  return typeset(result);
}

bool isFinite(std::optional<double> value) {
  return value && std::isfinite(*value);
}

}  // namespace

std::string readable(std::optional<double> value) {
  if (!isFinite(value)) return absentText;
  if (*value == 0.0) return "0";
  const int exponent = exponentOf(*value, 3);
  if (plain(exponent)) return fixed(*value, 2 - exponent);
  return fixed(*value / std::pow(10.0, exponent), 2) + timesPowerOfTen(exponent);
}

std::string readableSetting(std::optional<double> value) {
  if (!isFinite(value)) return absentText;
  const std::string digits = fmt::format("{:.4g}", *value);
  const auto power = digits.find('e');
  if (power == std::string::npos) return typeset(digits);
  return typeset(digits.substr(0, power)) + timesPowerOfTen(std::stoi(digits.substr(power + 1)));
}

std::string readableCount(std::optional<double> value) {
  return isFinite(value) ? fixed(*value, 0) : absentText;
}

std::string readable(std::optional<double> value, std::optional<double> error) {
  if (!isFinite(value) || !isFinite(error) || *error == 0.0) return readable(value);
  const double larger = std::max(std::abs(*value), std::abs(*error));
  const int magnitude = exponentOf(larger, 3);
  const int shift = plain(magnitude) ? 0 : magnitude;
  const double scale = std::pow(10.0, shift);
  const int decimals = 1 - exponentOf(*error, 2) + shift;
  if (const int most = mostValueDigits - 1 - exponentOf(larger, mostValueDigits) + shift;
      decimals > most) {
    const int own = exponentOf(*error, 2);
    return fixed(*value / scale, most) + (shift == 0 ? "" : timesPowerOfTen(shift)) +
           "\u00a0±\u00a0" +
           (plain(own) ? fixed(*error, 1 - own)
                       : fixed(*error / std::pow(10.0, own), 1) + timesPowerOfTen(own));
  }
  const std::string both =
      fixed(*value / scale, decimals) + "\u00a0±\u00a0" + fixed(*error / scale, decimals);
  return shift == 0 ? both : "(" + both + ")" + timesPowerOfTen(shift);
}

}  // namespace crossgrain::inline support
