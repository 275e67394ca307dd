#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {
namespace {

const char* markOf(LockstepVerdict verdict) {
  switch (verdict) {
    case LockstepVerdict::sameToRounding:
    case LockstepVerdict::sameLaw:
      return "✓";
    case LockstepVerdict::differs:
      return "✗";
    case LockstepVerdict::notMeasured:
      break;
  }
  return absentText;
}

const char* classOf(LockstepVerdict verdict) {
  switch (verdict) {
    case LockstepVerdict::sameToRounding:
    case LockstepVerdict::sameLaw:
      return "agree";
    case LockstepVerdict::differs:
      return "disagree";
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
      fmt::format("f_n {}, f_t {}", readable(forces.normal), readable(forces.tangential));
  if (forces.missing + forces.extra > 0)
    words += fmt::format("; {} missing, {} too many of {}", forces.missing, forces.extra,
                         readableCount(static_cast<double>(forces.contacts)));
  return words;
}

std::string orDash(std::string words) {
  return words.empty() ? absentText : words;
}

Json rowsOf(const LockstepResults& results, std::size_t times) {
  Json rows = Json::array();
  for (const LockstepRow& row : results.rows) {
    Json view = {{"engine", row.engine},
                 {"mark", markOf(row.verdict)},
                 {"class", classOf(row.verdict)},
                 {"verdict", verdictInWords(row, results.rules)},
                 {"equivalent", readable(row.equivalent)},
                 {"separations", separationCells(row, times)},
                 {"starts", readableCount(static_cast<double>(row.starts))},
                 {"kinds", kindCells(row)},
                 {"first", orDash(firstInWords(row))},
                 {"forces", forcesInWords(row)},
                 {"term", orDash(termInWords(row))},
                 {"reason", row.verdict == LockstepVerdict::notMeasured ? row.reason : ""}};
    rows.push_back(std::move(view));
  }
  return rows;
}

/// "2 of 3 engines follow their mirrors: yade, box2d-penalty; box2d-impulse was not measured."
std::string leadOf(const LockstepResults& results) {
  std::vector<std::string> same, differ, open;
  for (const LockstepRow& row : results.rows) {
    if (row.verdict == LockstepVerdict::notMeasured)
      open.push_back(row.engine);
    else
      (row.verdict == LockstepVerdict::differs ? differ : same).push_back(row.engine);
  }
  if (same.empty() && differ.empty()) return "Nothing was measured: no engine here has a mirror.";
  std::vector<std::string> parts;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (!names.empty())
      parts.push_back(fmt::format("{} {}", fmt::join(names, ", "), names.size() == 1 ? one : many));
  };
  add(same, "is the law that it declares", "are the laws that they declare");
  add(differ, "is another law than it declares", "are other laws than they declare");
  add(open, "was not measured", "were not measured");
  return fmt::format("{}.", fmt::join(parts, "; "));
}

}  // namespace

std::string lockstepPage(const LockstepResults& results, const Illustrations& shown) {
  Json view = studyView(results, shown);
  view["lead"] = leadOf(results);
  view["sentences"] = Json::array();
  for (const LockstepRow& row : results.rows)
    view["sentences"].push_back(sentenceOf(row, results.rules));
  std::vector<RealisedScene> realised;
  Json times = Json::array();
  for (const LockstepRow& row : results.rows) {
    if (row.realised) realised.push_back({row.engine, &*row.realised, &results.effects});
    if (times.empty())
      for (const LockstepSeparation& at : row.separations)
        times.push_back(fmt::format("{} ms", readable(1e3 * at.time)));
  }
  view["rows"] = rowsOf(results, times.size());
  view["columns"] = times;
  view["timeCount"] = fmt::format("{}", std::max<std::size_t>(times.size(), 1));
  view["figures"] = figureViews(shown, "lockstep_");
  view["starts"] = readableCount(static_cast<double>(results.starts.size()));
  view["bound"] =
      readable(3.0 / static_cast<double>(std::max<std::size_t>(results.starts.size(), 1)));
  view["rounding"] = readableSetting(results.rules.rounding);
  view["sameLaw"] = readableSetting(100.0 * results.rules.sameLaw);
  view["change"] = readableSetting(100.0 * results.rules.yardstickChange);
  view["yardstick"] = results.rules.yardstick;
  addDetails(view, realised);
  view["packings"] = packingRows(results.packings);
  view["files"] = "Beside this page: results.json (everything) and lockstep.csv.";
  return render("report_lockstep.html", view);
}

}  // namespace crossgrain::reports
