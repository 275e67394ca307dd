#include "reports/common/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

namespace crossgrain::reports {

namespace {

bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// "118.76" → "118.8", "3.00" → "3".
std::string toTenths(const std::string& digits) {
  std::string result = fmt::format("{:.1f}", std::strtod(digits.c_str(), nullptr));
  if (result.ends_with(".0")) result.resize(result.size() - 2);
  return result;
}

/// Numbers inside tags only: what is between them is for people to read.
std::string roundedNumbers(const std::string& svg) {
  std::string result;
  result.reserve(svg.size());
  bool inTag = false;
  for (std::size_t k = 0; k < svg.size();) {
    const char c = svg[k];
    inTag = c == '<' || (inTag && c != '>');
    const bool inWord = k > 0 && (std::isalnum(static_cast<unsigned char>(svg[k - 1])) != 0);
    std::size_t end = k;
    while (end < svg.size() && (isDigit(svg[end]) || svg[end] == '.')) ++end;
    const std::string_view digits(svg.data() + k, end - k);
    // After M and L of a path a number follows at once; in a word, as "gpPt6", none does.
    const bool afterCommand = k > 0 && (svg[k - 1] == 'M' || svg[k - 1] == 'L');
    if (inTag && (!inWord || afterCommand) && digits.find('.') != std::string_view::npos) {
      result += toTenths(std::string(digits));
      k = end;
      continue;
    }
    if (end > k) {
      result += digits;
      k = end;
      continue;
    }
    result += c;
    ++k;
  }
  return result;
}

std::string hexColours(const std::string& svg) {
  static const std::regex colour(R"(rgb\(\s*(\d+),\s*(\d+),\s*(\d+)\))");
  std::string result;
  auto from = svg.cbegin();
  for (std::sregex_iterator it(svg.begin(), svg.end(), colour), end; it != end; ++it) {
    const std::smatch& found = *it;
    result.append(from, found[0].first);
    result += fmt::format("#{:02x}{:02x}{:02x}", std::stoi(found[1]), std::stoi(found[2]),
                          std::stoi(found[3]));
    from = found[0].second;
  }
  return result.append(from, svg.cend());
}

}  // namespace

std::string withoutTop(const std::string& svg, int top) {
  static const std::regex size(R"re(height="(\d+)"(\s+)viewBox="0 0 (\d+) (\d+)")re");
  std::smatch found;
  if (top <= 0 || !std::regex_search(svg, found, size)) return svg;
  const int left = std::stoi(found[1]) - top;
  return found.prefix().str() +
         fmt::format("height=\"{}\"{}viewBox=\"0 {} {} {}\"", left, found[2].str(), top,
                     found[3].str(), left) +
         found.suffix().str();
}

std::string compactSvg(const std::string& svg) {
  // Beside blanks: what is so anyway, by SVG's defaults or for a tspan by its text.
  static const std::vector<std::pair<std::regex, const char*>> shorter = {
      {std::regex(R"(>\s*\n\s*<)"), "><"},
      {std::regex(R"(<g [^>]*></g>)"), ""},
      {std::regex(R"( stroke-linecap="butt"| stroke-linejoin="miter"| class="gridline")"), ""},
      {std::regex(R"(<tspan font-family="sans-serif" >)"), "<tspan>"},
      {std::regex(R"( {2,})"), " "},
      {std::regex(R"( '/>)"), "'/>"}};
  // What is defined up to here is small, and drawn enlarged.
  const std::size_t split = std::min(svg.find("</defs>"), svg.size());
  std::string drawing = hexColours(svg.substr(split));
  for (const auto& [pattern, words] : shorter)
    drawing = std::regex_replace(drawing, pattern, words);
  return svg.substr(0, split) + roundedNumbers(drawing);
}

}  // namespace crossgrain::reports
