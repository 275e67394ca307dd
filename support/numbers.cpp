#include "support/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace crossgrain::inline support {

namespace {

/// Of a value that an error stands beside: a smaller error has a power of ten of its own.
constexpr int mostValueDigits = 6;

/// Of a value: what computing with 53 bits does to it.
constexpr double rounding = 1e-12;

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

/// To so many significant digits.
std::string withDigits(std::optional<double> value, int digits) {
  if (!value || !std::isfinite(*value)) return absentText;
  if (*value == 0.0) return "0";
  const int exponent = exponentOf(*value, digits);
  if (plain(exponent)) return fixed(*value, digits - 1 - exponent);
  return fixed(*value / std::pow(10.0, exponent), digits - 1) + timesPowerOfTen(exponent);
}

}  // namespace

std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> at(const std::vector<std::optional<double>>& list, std::size_t k) {
  return k < list.size() ? finite(list[k]) : std::nullopt;
}

std::optional<double> at(const std::vector<double>& list, std::size_t k) {
  return k < list.size() ? finite(list[k]) : std::nullopt;
}

std::string readable(std::optional<double> value) {
  return withDigits(value, 3);
}

std::pair<std::string, std::string> readablePair(std::optional<double> a, std::optional<double> b) {
  int digits = 3;
  if (finite(a) && finite(b) && std::abs(*a - *b) > rounding * std::max(std::abs(*a), std::abs(*b)))
    while (digits < 13 && withDigits(a, digits) == withDigits(b, digits)) ++digits;
  return {withDigits(a, digits), withDigits(b, digits)};
}

std::string readableSetting(std::optional<double> value) {
  if (!finite(value)) return absentText;
  const std::string digits = fmt::format("{:.4g}", *value);
  const auto power = digits.find('e');
  if (power == std::string::npos) return typeset(digits);
  return typeset(digits.substr(0, power)) + timesPowerOfTen(std::stoi(digits.substr(power + 1)));
}

std::string counted(std::size_t count, std::string_view noun) {
  if (count != 1 && noun.ends_with('y'))
    return fmt::format("{} {}ies", count, noun.substr(0, noun.size() - 1));
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string readableCount(std::optional<double> value) {
  return finite(value) ? fixed(*value, 0) : absentText;
}

std::string readable(std::optional<double> value, std::optional<double> error) {
  if (!finite(value) || !finite(error) || *error <= rounding * std::abs(*value))
    return readable(value);
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

std::string readableDifference(std::optional<double> value, std::optional<double> error) {
  const std::string both = readable(value, error);
  if (!value || *value <= 0.0) return both;
  return both.starts_with('(') ? "(+" + both.substr(1) : "+" + both;
}

std::string readableInterval(std::optional<double> value, std::optional<double> low,
                             std::optional<double> high, std::string_view unit, Sign sign) {
  const auto alone = [&] {
    return (sign == Sign::ofAll ? readableDifference(value, {}) : readable(value)) +
           std::string(unit);
  };
  if (!finite(value)) return absentText;
  if (!finite(low) || !finite(high) || !(*low < *high)) return alone();
  const double larger = std::max({std::abs(*value), std::abs(*low), std::abs(*high)});
  const int magnitude = exponentOf(larger, 3), shift = plain(magnitude) ? 0 : magnitude;
  const auto text = [&](double number, int decimals) {
    return (sign == Sign::ofAll && number > 0.0 ? "+" : "") +
           fixed(number / std::pow(10.0, shift), decimals);
  };
  const int most = mostValueDigits - magnitude + shift;
  int decimals =
      std::clamp(1 - exponentOf(0.5 * (*high - *low), 2), -magnitude, mostValueDigits - magnitude) +
      shift;
  const auto meets = [&](double end) {
    return std::abs(end - *value) > rounding * larger &&
           text(end, decimals) == text(*value, decimals);
  };
  while (decimals < most && (meets(*low) || meets(*high))) ++decimals;
  if (text(*low, decimals) == text(*high, decimals)) return alone();
  const std::string ends = fmt::format(" ({} to {})", text(*low, decimals), text(*high, decimals));
  return shift == 0
             ? fmt::format("{}{}{}", text(*value, decimals), unit, ends)
             : fmt::format("{}{}{}{}", text(*value, decimals), ends, timesPowerOfTen(shift), unit);
}

std::string readableRange(std::optional<double> low, std::optional<double> high) {
  const auto [from, to] = readablePair(low, high);
  return from == to ? from : fmt::format("{} to {}", from, to);
}

std::string withEnds(const std::string& value, const std::string& low, const std::string& high) {
  return low == high ? value : fmt::format("{} ({} to {})", value, low, high);
}

std::string readablePercent(double fraction) {
  const double percent = 100.0 * fraction;
  return percent < 0.95 ? fmt::format("{:.1g}", percent) : fmt::format("{:.0f}", percent);
}

std::string shortly(std::optional<double> value) {
  if (!finite(value)) return absentText;
  return readableSetting(std::strtod(fmt::format("{:.2g}", *value).c_str(), nullptr));
}

std::optional<double> times(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

std::string readableDuration(std::optional<double> seconds) {
  if (!seconds) return absentText;
  if (*seconds < 59.95) return readable(seconds) + " s";
  const auto whole = std::llround(*seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string shortDuration(std::optional<double> seconds) {
  if (!finite(seconds) || *seconds <= 0.0 || *seconds >= 0.9995) return readableDuration(seconds);
  if (*seconds >= 0.9995e-3) return readable(1e3 * *seconds) + " ms";
  return readable(1e6 * *seconds) + " µs";
}

}  // namespace crossgrain::inline support
