#include "reports/lockstep/view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {
namespace {

const char* markOf(LockstepVerdict verdict) {
  switch (verdict) {
    case LockstepVerdict::sameToRounding:
    case LockstepVerdict::sameToPrecision:
    case LockstepVerdict::sameLaw:
      return "✓";
    case LockstepVerdict::differs:
      return "✗";
    case LockstepVerdict::undecided:
      return "?";
    case LockstepVerdict::notMeasured:
      break;
  }
  return absentText;
}

const char* classOf(LockstepVerdict verdict) {
  switch (verdict) {
    case LockstepVerdict::sameToRounding:
    case LockstepVerdict::sameToPrecision:
    case LockstepVerdict::sameLaw:
      return "agree";
    case LockstepVerdict::differs:
      return "disagree";
    case LockstepVerdict::undecided:
    case LockstepVerdict::notMeasured:
      break;
  }
  return "undecided";
}

Json separationCells(const LockstepRow& row, std::size_t times) {
  Json cells = Json::array();
  for (std::size_t k = 0; k < times; ++k)
    cells.push_back(k < row.separations.size() ? readable(row.separations[k].largest) : absentText);
  return cells;
}

Json kindCells(const LockstepRow& row) {
  const ContactKinds& kinds = row.kinds;
  Json cells = Json::array();
  for (const std::size_t count :
       {kinds.sticking, kinds.sliding, kinds.made, kinds.opened, kinds.wall})
    cells.push_back(row.starts > 0 ? readableCount(static_cast<double>(count)) : absentText);
  return cells;
}

std::string forcesInWords(const LockstepRow& row) {
  if (!row.forces) return absentText;
  const LockstepForces& forces = *row.forces;
  std::string words =
      fmt::format("normal {}, tangential {}", readable(forces.normal), readable(forces.tangential));
  if (forces.missing + forces.extra > 0)
    words += fmt::format("; {} missing, {} too many of {}", forces.missing, forces.extra,
                         readableCount(static_cast<double>(forces.contacts)));
  return words;
}

std::string orDash(std::string words) {
  return words.empty() ? absentText : words;
}

Json rowsOf(const LockstepFindings& findings, std::size_t times) {
  Json rows = Json::array();
  for (const LockstepRow& row : findings.rows) {
    Json view = {{"engine", row.engine},
                 {"mark", markOf(row.verdict)},
                 {"class", classOf(row.verdict)},
                 {"verdict", mathHtml(verdictInWords(row, findings.rules))},
                 {"equivalent", readable(row.equivalent)},
                 {"separations", separationCells(row, times)},
                 {"starts", readableCount(static_cast<double>(row.starts))},
                 {"reading", mathHtml(readingInWords(row, findings.rules))},
                 {"kinds", kindCells(row)},
                 {"first", orDash(firstInWords(row))},
                 {"resolution", mathHtml(resolutionInWords(row, findings.rules))},
                 {"open", openInLaw(row, findings.rules)},
                 {"forces", forcesInWords(row)},
                 {"term", mathHtml(orDash(termInWords(row)))},
                 {"reason", row.reason}};
    rows.push_back(std::move(view));
  }
  return rows;
}

}  // namespace

void addLockstep(Json& view, const LockstepFindings& findings) {
  Json times = Json::array();
  for (const LockstepRow& row : findings.rows)
    if (times.empty())
      for (const LockstepSeparation& at : row.separations)
        times.push_back(fmt::format("{} ms", readable(1e3 * at.time)));
  const double starts = static_cast<double>(std::max<std::size_t>(findings.starts.size(), 1));
  view["lockstep"] = {{"rows", rowsOf(findings, times.size())},
                      {"columns", times},
                      {"timeCount", fmt::format("{}", std::max<std::size_t>(times.size(), 1))},
                      {"starts", readableCount(starts)},
                      {"stray", readableSetting(100.0 * findings.rules.strayShare)},
                      {"rounding", readableSetting(findings.rules.rounding)},
                      {"sameLaw", readableSetting(100.0 * findings.rules.sameLaw)},
                      {"change", readableSetting(100.0 * findings.rules.yardstickChange)},
                      {"yardstick", mathHtml(constantSymbol(findings.rules.yardstick))}};
}

}  // namespace crossgrain::reports
