#include "reports/common/junit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

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

std::string counts(const std::vector<JUnitCase>& cases) {
  const auto count = [&](Outcome outcome) {
    return std::ranges::count(cases, outcome, &JUnitCase::outcome);
  };
  double seconds = 0.0;
  for (const JUnitCase& each : cases) seconds += each.seconds;
  return fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}" time="{:.3f}")",
                     cases.size(), count(Outcome::failed), count(Outcome::error),
                     count(Outcome::skipped), seconds);
}

const char* tagOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::failed:
      return "failure";
    case Outcome::error:
      return "error";
    case Outcome::skipped:
      return "skipped";
    case Outcome::passed:
      break;
  }
  return nullptr;
}

/// Absent: the cell answers no question.
std::optional<Outcome> cellOutcome(CellState state) {
  using enum CellState;
  switch (state) {
    case good:
    case modelDifference:
      return Outcome::passed;
    case bad:
      return Outcome::failed;
    case borderline:
    case undecided:
    case notMeasured:
      return Outcome::skipped;
    case figure:
    case notApplicable:
      break;
  }
  return std::nullopt;
}

/// "undecided, 0.31 margins, pressure"
std::string messageOf(const OverviewCell& cell) {
  std::vector<std::string> parts;
  if (cell.state != CellState::good && cell.state != CellState::bad) {
    std::string state(namesOf(cell.state)[static_cast<std::size_t>(cell.state)]);
    std::ranges::replace(state, '_', ' ');
    parts.push_back(std::move(state));
  }
  for (const std::string& part : {cell.shown, cell.words})
    if (!part.empty()) parts.push_back(part);
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<JUnitCase> overviewCases(const Overview& overview, const std::string& group) {
  std::vector<JUnitCase> cases;
  for (const OverviewRow& row : overview.rows)
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (const auto outcome = cellOutcome(row.cells[k].state))
        cases.push_back({group, fmt::format("{}: {}", row.name, overview.columns[k].name), *outcome,
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
    if (const char* tag = tagOf(each.outcome))
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
