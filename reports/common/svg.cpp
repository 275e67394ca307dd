#include "reports/common/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
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

struct Place {
  double x = 0.0, y = 0.0;
};

/// How far c is from the straight line through a and b. [px]
double fromLine(const Place& a, const Place& b, const Place& c) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0.0) return std::hypot(c.x - a.x, c.y - a.y);
  return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / length;
}

/// Of a line that goes to the right: without points that lie on the straight line between those
/// about them, to a tenth of a pixel. Others as they are.
std::vector<Place> withoutStraightOnes(const std::vector<Place>& line) {
  constexpr double unseen = 0.1;  // px
  for (std::size_t k = 1; k < line.size(); ++k)
    if (line[k].x <= line[k - 1].x) return line;
  std::vector<Place> kept;
  for (std::size_t k = 0; k < line.size();) {
    kept.push_back(line[k]);
    const auto straightTo = [&](std::size_t end) {
      for (std::size_t between = k + 1; between < end; ++between)
        if (fromLine(line[k], line[end], line[between]) > unseen) return false;
      return true;
    };
    std::size_t next = k + 1;
    while (next + 1 < line.size() && straightTo(next + 1)) ++next;
    k = next;
  }
  return kept;
}

/// "M1,2 L3,4 L5,6 M7,8" in fewer letters: an L goes without saying, and so do points on straight
/// lines. Anything else as it is.
std::string shortPath(const std::string& path) {
  std::string result;
  std::vector<Place> line;
  const auto endLine = [&] {
    const char* before = "M";
    for (const Place& place : withoutStraightOnes(line)) {
      result += fmt::format("{}{:g},{:g}", before, place.x, place.y);
      before = " ";
    }
    line.clear();
  };
  const char* at = path.c_str();
  while (*at != '\0') {
    if (std::isspace(static_cast<unsigned char>(*at))) {
      ++at;
      continue;
    }
    if (*at != 'M' && (*at != 'L' || line.empty())) return path;
    if (*at == 'M') endLine();
    char* end = nullptr;
    const double x = std::strtod(at + 1, &end);
    if (end == at + 1 || *end != ',') return path;
    at = end + 1;
    const double y = std::strtod(at, &end);
    if (end == at) return path;
    at = end;
    line.push_back({x, y});
  }
  endLine();
  return result;
}

/// The same of every path.
std::string shortPaths(const std::string& svg) {
  constexpr std::string_view begins = " d='";
  std::string result;
  std::size_t at = 0;
  for (std::size_t path = svg.find(begins); path != std::string::npos;
       path = svg.find(begins, at)) {
    const std::size_t from = path + begins.size(), end = svg.find('\'', from);
    if (end == std::string::npos) break;
    result += svg.substr(at, from - at) + shortPath(svg.substr(from, end - from));
    at = end;
  }
  return result += svg.substr(at);
}

/// Values of attributes in single quotes, as far as they hold none: in an address a double one
/// takes three letters.
std::string singleQuoted(const std::string& svg) {
  std::string result = svg;
  bool inTag = false;
  for (std::size_t k = 0; k < result.size(); ++k) {
    const char c = result[k];
    inTag = c == '<' || (inTag && c != '>');
    if (!inTag || (c != '"' && c != '\'')) continue;
    const std::size_t end = std::min(result.find(c, k + 1), result.size() - 1);
    if (c == '"' && result.find('\'', k) > end) result[k] = result[end] = '\'';
    k = end;
  }
  return result;
}

/// What `text` holds between the first `before` and the next `after`; empty without.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t from = text.find(before);
  if (from == std::string_view::npos) return {};
  const std::size_t begin = from + before.size(), end = text.find(after, begin);
  return end == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin);
}

std::string without(std::string_view text, std::string_view word) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t found = text.find(word); found != std::string_view::npos;
       found = text.find(word, at)) {
    result += text.substr(at, found - at);
    at = found + word.size();
  }
  return result += text.substr(at);
}

/// A group of nothing but marks of one colour says that once; others as they are.
std::string colouredOnce(std::string_view head, std::string_view content) {
  const std::string as(content), tag(head);
  const std::string_view own = between(head, " color=\"", "\""),
                         colour = between(content, " color='", "'");
  const std::string said = fmt::format(" color='{}'", colour);
  std::size_t marks = 0, alike = 0;
  for (std::size_t at = 0; at < content.size(); ++marks) {
    if (!content.substr(at).starts_with("<use ")) return tag + as;
    const std::size_t end = content.find("/>", at);
    if (end == std::string_view::npos) return tag + as;
    if (content.substr(at, end - at).find(said) != std::string_view::npos) ++alike;
    at = end + 2;
  }
  if (own.empty() || colour.empty() || alike != marks) return tag + as;
  const std::size_t place = static_cast<std::size_t>(own.data() - head.data());
  return tag.substr(0, place) + std::string(colour) + tag.substr(place + own.size()) +
         without(content, said);
}

/// The same in every group.
std::string groupsColouredOnce(const std::string& svg) {
  std::string result;
  std::size_t at = 0;
  for (std::size_t group = svg.find("<g "); group != std::string::npos;
       group = svg.find("<g ", at)) {
    const std::size_t begin = svg.find('>', group);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(svg.find("<g ", begin), svg.find("</g>", begin));
    if (end == std::string::npos) break;
    const std::string_view all(svg);
    result += all.substr(at, group - at);
    result +=
        colouredOnce(all.substr(group, begin + 1 - group), all.substr(begin + 1, end - begin - 1));
    at = end;
  }
  return result += svg.substr(at);
}

}  // namespace

std::string svgAddress(const std::string& svg) {
  std::string address = "data:image/svg+xml,";
  for (const char c : singleQuoted(svg)) {
    // What ends an attribute, a tag or an address; blanks at its ends would be cut off.
    constexpr std::string_view special = "\"#%&<>:\n\t\r";
    if (special.find(c) == std::string_view::npos)
      address += c;
    else
      address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

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
      {std::regex(R"(>\s*[\n\t]\s*<)"), "><"},
      {std::regex(R"(<g [^>]*></g>)"), ""},
      {std::regex(R"( stroke-linecap="butt"| stroke-linejoin="miter"| class="gridline")"), ""},
      {std::regex(R"(<tspan font-family="sans-serif" >)"), "<tspan>"},
      {std::regex(R"(<title>[^<]*</title>)"), ""},
      {std::regex(R"(<use xlink:href=)"), "<use href="},
      {std::regex(R"( {2,})"), " "},
      {std::regex(R"( '/>)"), "'/>"}};
  // What is defined up to here is small, and drawn enlarged.
  const std::size_t split = std::min(svg.find("</defs>"), svg.size());
  std::string drawing = hexColours(svg.substr(split));
  for (const auto& [pattern, words] : shorter)
    drawing = std::regex_replace(drawing, pattern, words);
  return svg.substr(0, split) + shortPaths(roundedNumbers(groupsColouredOnce(drawing)));
}

}  // namespace crossgrain::reports
