#include "reports/common/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/common/text.hpp"

namespace crossgrain::reports {

namespace {

/// As the value of an attribute. What XML 1.0 cannot hold at all, a terminal's escapes and bytes
/// that are not UTF-8, becomes a sign of replacement.
std::string xmlText(const std::string& raw) {
  using Json = nlohmann::json;
  const std::string utf8 = Json(raw).dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string text = Json::parse(utf8);
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    const std::string_view three = std::string_view(text).substr(k, 3);
    if (three == "\ufffe" || three == "\uffff") {  // which no XML has
      result += "\ufffd";
      k += 2;
    } else if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\n' || c == '\t' || c == '\r')
      result += fmt::format("&#{};", static_cast<int>(c));
    else
      result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return result;
}

/// Empty where a test passes: a model difference does, and what shows nothing is skipped.
std::string_view tagOf(const JUnitCase& one) {
  if (one.broke) return "error";
  if (one.verdict == Verdict::fail) return "failure";
  const bool passes = one.verdict == Verdict::pass || one.verdict == Verdict::modelDifference;
  return one.passes.value_or(passes) ? "" : "skipped";
}

std::string counts(const std::vector<JUnitCase>& cases) {
  const auto count = [&](std::string_view tag) { return std::ranges::count(cases, tag, tagOf); };
  double seconds = 0.0;
  for (const JUnitCase& each : cases) seconds += each.seconds;
  return fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}" time="{:.3f}")",
                     cases.size(), count("failure"), count("error"), count("skipped"), seconds);
}

/// "undecided, 0.31 margins, pressure"
std::string messageOf(const OverviewCell& cell) {
  Names parts;
  if (cell.verdict != Verdict::pass && cell.verdict != Verdict::fail)
    parts.push_back(spaced(cellWord(cell.verdict)));
  for (const std::string& part : {cell.shown, cell.words})
    if (!part.empty()) parts.push_back(part);
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group) {
  std::vector<JUnitCase> cases;
  for (const OverviewRow& row : overview.rows)
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (const auto verdict = row.cells[k].verdict; verdict && *verdict != Verdict::notApplicable)
        cases.push_back({group, fmt::format("{}: {}", row.name, overview.columns[k].name), *verdict,
                         messageOf(row.cells[k])});
  return cases;
}

std::string junitXml(const std::string& suite, const std::vector<JUnitCase>& cases) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n"
      "<testsuite name=\"crossgrain {1}\" {0}>\n",
      counts(cases), xmlText(suite));
  for (const JUnitCase& each : cases) {
    xml += fmt::format(R"(<testcase classname="{}" name="{}" time="{:.3f}")", xmlText(each.group),
                       xmlText(each.name), each.seconds);
    if (const std::string_view tag = tagOf(each); !tag.empty())
      xml += fmt::format("><{} message=\"{}\"/></testcase>\n", tag, xmlText(each.message));
    else if (!each.message.empty())
      xml += fmt::format("><system-out>{}</system-out></testcase>\n", xmlText(each.message));
    else
      xml += "/>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

std::string junitGroup(const std::string& name, const std::string& variant) {
  return variant.empty() || variant == name ? name : fmt::format("{} {}", name, variant);
}

double junitSeconds(const std::optional<Stats>& stats) {
  return stats ? stats->wallSeconds : 0.0;
}

}  // namespace crossgrain::reports
