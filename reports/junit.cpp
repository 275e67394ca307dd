#include "reports/junit.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace crossgrain::reports {

namespace {

using Outcome = JUnitCase::Outcome;

/// As the value of an attribute. What XML 1.0 cannot hold at all, a terminal's escapes and bytes
/// that are not UTF-8, becomes a sign of replacement.
std::string escaped(const std::string& raw) {
  const std::string utf8 = Json(raw).dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string text = Json::parse(utf8);
  std::string result;
  for (const char c : text) {
    if (c == '&')
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

}  // namespace

std::string junitXml(const std::string& suite, const std::vector<JUnitCase>& cases) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n"
      "<testsuite name=\"crossgrain {1}\" {0}>\n",
      counts(cases), escaped(suite));
  for (const JUnitCase& each : cases) {
    xml += fmt::format(R"(<testcase classname="{}" name="{}" time="{:.3f}")", escaped(each.group),
                       escaped(each.name), each.seconds);
    if (const char* tag = tagOf(each.outcome))
      xml += fmt::format("><{} message=\"{}\"/></testcase>\n", tag, escaped(each.message));
    else if (!each.message.empty())
      xml += fmt::format("><system-out>{}</system-out></testcase>\n", escaped(each.message));
    else
      xml += "/>\n";
  }
  return xml + "</testsuite>\n</testsuites>\n";
}

namespace {

std::string groupOf(const Json& object) {
  const std::string variant = text(object, "variant"), name = text(object, "case");
  return variant.empty() || variant == name ? name : fmt::format("{} {}", name, variant);
}

double wallSeconds(const Json& run) {
  return number(member(run, "stats"), "wall_s").value_or(0.0);
}

/// "0.31 J against a limit of 0.1 J, which is there since …; reason"
std::string figureOf(const Json& run, const std::string& why) {
  const std::string unit = text(run, "unit"), reason = text(run, "reason");
  const auto value = number(run, "value"), limit = number(run, "limit");
  std::string figure;
  if (value && limit)
    figure = fmt::format("{:.4g}{}{} against a limit of {:.4g}", *value, unit.empty() ? "" : " ",
                         unit, *limit);
  if (!figure.empty() && !why.empty()) figure += fmt::format(" ({})", why);
  return figure + (figure.empty() || reason.empty() ? "" : "; ") + reason;
}

Outcome outcomeOf(const Json& run) {
  if (text(run, "status") == "failed") return Outcome::error;
  const std::string verdict = text(run, "verdict");
  if (verdict == "unstable") return Outcome::failed;
  return verdict == "stable" || verdict == "degraded" ? Outcome::passed : Outcome::skipped;
}

}  // namespace

std::string stabilityJunit(const Json& results) {
  std::vector<JUnitCase> cases;
  for (const Json& run : list(results, "runs")) {
    std::string why;
    for (const Json& setup : list(results, "cases"))
      if (text(setup, "case") == text(run, "case") &&
          text(setup, "variant") == text(run, "variant"))
        why = text(setup, "why");
    JUnitCase one{groupOf(run), text(run, "engine") + ": " + text(run, "measure"), outcomeOf(run),
                  "", wallSeconds(run)};
    if (one.outcome == Outcome::error || one.outcome == Outcome::skipped)
      one.message = text(run, "reason");
    else if (text(run, "verdict") != "stable")
      one.message = text(run, "verdict") + ": " + figureOf(run, why);
    cases.push_back(std::move(one));
  }
  return junitXml("stability", cases);
}

namespace {

/// Quantities that any sweep of this variant was judged by.
std::vector<std::string> judgedQuantities(const Json& variant) {
  std::vector<std::string> names;
  for (const Json& curve : list(variant, "curves"))
    for (const auto& [name, score] : member(curve, "score").items())
      if (number(score, "limit") && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  return names;
}

/// "0.0031 of the range against a limit of 0.001 (why)"
std::string errorOf(const Json& score) {
  const std::string unit = text(score, "unit_is"), why = text(score, "why");
  return fmt::format("largest error {:.4g}{} against a limit of {:.4g}{}",
                     number(score, "max").value_or(0.0),
                     unit == "absolute" || unit.empty() ? "" : " of the " + unit,
                     number(score, "limit").value_or(0.0), why.empty() ? "" : " (" + why + ")");
}

JUnitCase judgedSweep(const Json& curve, const std::string& sweep, const std::string& quantity) {
  JUnitCase one{"", sweep + ": " + quantity};
  const Json& score = member(member(curve, "score"), quantity);
  const Json& held = member(score, "held");
  if (held.is_boolean()) {
    one.outcome = held.get<bool>() ? Outcome::passed : Outcome::failed;
    if (one.outcome == Outcome::failed) one.message = errorOf(score);
  } else {
    one.outcome = Outcome::skipped;
    one.message = "not measured, or not known of the reference";
  }
  return one;
}

/// Sweeps that ran; where pairs did not part, that is a failure of its own.
std::vector<JUnitCase> sweepCases(const Json& variant, const Json& curve) {
  const std::string status = text(curve, "status"), reason = text(curve, "reason");
  const auto dt = number(curve, "dt");
  const std::string sweep =
      text(curve, "engine") + (dt ? fmt::format(", dt {:.4g} s", *dt) : std::string());
  if (status == "failed") return {{"", sweep, Outcome::error, reason}};
  if (status == "refused") return {{"", text(curve, "engine"), Outcome::skipped, reason}};
  std::vector<JUnitCase> cases;
  for (const std::string& quantity : judgedQuantities(variant))
    cases.push_back(judgedSweep(curve, sweep, quantity));
  if (status == "incomplete")
    cases.push_back({"", sweep + ": all pairs part", Outcome::failed, reason});
  if (cases.empty())
    cases.push_back({"", sweep, Outcome::skipped, "not judged: the case has no limits"});
  cases.front().seconds = wallSeconds(curve);
  return cases;
}

}  // namespace

std::string collideJunit(const Json& results) {
  std::vector<JUnitCase> cases;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      for (JUnitCase& one : sweepCases(variant, curve)) {
        one.group = groupOf(variant);
        cases.push_back(std::move(one));
      }
  return junitXml("collide", cases);
}

}  // namespace crossgrain::reports
