#include "reports/common/svg_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

namespace crossgrain::reports {

namespace {

/// Those that a style sheet may have with the same values, but for the unit of letters.
constexpr std::array<std::string_view, 9> looks = {
    "fill",      "color",       "stroke",      "stroke-width",    "stroke-dasharray",
    "font-size", "font-family", "text-anchor", "stroke-linejoin",
};

struct Attribute {
  std::size_t end = 0;  ///< place behind it; 0: there is none
  std::string_view name, value;
};

/// The one that begins at the blank there.
Attribute attributeAt(std::string_view svg, std::size_t blank) {
  const std::size_t equals = svg.find('=', blank);
  if (equals == std::string_view::npos || equals + 1 >= svg.size()) return {};
  const char quote = svg[equals + 1];
  if (quote != '"' && quote != '\'') return {};
  const std::size_t end = svg.find(quote, equals + 2);
  if (end == std::string_view::npos) return {};
  return {end + 1, svg.substr(blank + 1, equals - blank - 1),
          svg.substr(equals + 2, end - equals - 2)};
}

bool isLook(const Attribute& attribute) {
  return std::ranges::find(looks, attribute.name) != looks.end();
}

/// A run of attributes in a tag: `length` letters from its first blank on.
struct Run {
  std::size_t at = 0, length = 0;
  std::string rule;
};

/// The first run of each tag; one that stands apart from it stays as it is.
std::vector<Run> runsOf(std::string_view svg) {
  std::vector<Run> runs;
  for (std::size_t tag = svg.find('<'); tag != std::string_view::npos; tag = svg.find('<', tag)) {
    const std::size_t end = svg.find('>', tag);
    if (end == std::string_view::npos) break;
    Run run;
    std::size_t at = svg.find(' ', tag);
    const std::string_view element = svg.substr(tag + 1, std::min(at, end) - tag - 1);
    tag = end;
    if (element != "g" && element != "path") continue;
    while (at < end) {
      if (svg[at] != ' ') break;
      const Attribute attribute = attributeAt(svg, at);
      if (attribute.end == 0 || attribute.name == "class") {
        run.length = 0;
        break;
      }
      if (isLook(attribute)) {
        if (run.length == 0) run.at = at;
        run.rule += fmt::format("{}:{}{};", attribute.name, attribute.value,
                                attribute.name == "font-size" ? "px" : "");
        run.length = attribute.end - run.at;
      } else if (run.length > 0) {
        break;
      }
      at = attribute.end;
    }
    if (run.length > 0) runs.push_back(std::move(run));
  }
  return runs;
}

/// "a", "b", …, "z", "ba", …
std::string nameOf(std::size_t number) {
  std::string name(1, static_cast<char>('a' + number % 26));
  return number < 26 ? name : nameOf(number / 26) + name;
}

}  // namespace

std::string styledByClasses(const std::string& svg) {
  const std::size_t defined = svg.find("</defs>");
  const std::size_t from = defined == std::string::npos ? 0 : defined;
  const std::string_view drawing = std::string_view(svg).substr(from);
  const std::vector<Run> runs = runsOf(drawing);
  std::map<std::string, std::size_t> counts;
  for (const Run& run : runs) ++counts[run.rule];
  constexpr std::size_t worthIt = 3;
  std::map<std::string, std::string> classes;
  std::string sheet, result;
  std::size_t at = 0;
  for (const Run& run : runs) {
    if (counts[run.rule] < worthIt) continue;
    std::string& own = classes[run.rule];
    if (own.empty()) {
      own = nameOf(classes.size() - 1);
      sheet += fmt::format(".{}{{{}}}", own, run.rule);
    }
    result += drawing.substr(at, run.at - at);
    result += fmt::format(" class='{}'", own);
    at = run.at + run.length;
  }
  if (classes.empty()) return svg;
  const std::size_t content = svg.find('>', svg.find("<svg"));
  if (content == std::string::npos || content >= std::max<std::size_t>(from, 1)) return svg;
  result += drawing.substr(at);
  return svg.substr(0, content + 1) + "<style>" + sheet + "</style>" +
         svg.substr(content + 1, from - content - 1) + result;
}

}  // namespace crossgrain::reports
