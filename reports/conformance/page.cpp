#include "reports/common/page.hpp"

#include <fmt/format.h>

#include <cctype>

#include "reports/conformance/report.hpp"

namespace crossgrain::reports {

namespace {

struct OutcomeStyle {
  const char* words;
  const char* css;
};

OutcomeStyle styleOf(ConformanceOutcome outcome) {
  switch (outcome) {
    case ConformanceOutcome::passed:
      return {"✓ passed", "agree"};
    case ConformanceOutcome::failed:
      return {"✗ failed", "disagree"};
    case ConformanceOutcome::brokeDown:
      return {"✗ broke down", "disagree"};
    case ConformanceOutcome::skipped:
      break;
  }
  return {"– skipped", ""};
}

Json rowsOf(const ConformanceResults& results, const std::string& part) {
  Json rows = Json::array();
  for (const ConformanceRow& row : results.rows) {
    if (row.part != part) continue;
    const OutcomeStyle style = styleOf(row.outcome);
    rows.push_back({{"name", row.name},
                    {"what", row.what},
                    {"outcome", style.words},
                    {"class", style.css},
                    {"detail", row.detail},
                    {"more", row.faults > 1 ? fmt::format("and {} more", row.faults - 1) : ""}});
  }
  return rows;
}

}  // namespace

std::vector<Figure> conformanceFigures(const ConformanceResults&) {
  return {};
}

std::string conformancePage(const ConformanceResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, results.elapsed, {}, shown);
  view["lead"] = conformanceLead(results);
  view["sentences"] = Json::array();
  for (const ConformanceRow& row : results.rows)
    if (row.outcome == ConformanceOutcome::failed || row.outcome == ConformanceOutcome::brokeDown)
      view["sentences"].push_back(conformanceSentence(row));
  for (std::string sentence : {conformanceNotExamined(results), conformanceCause(results)})
    if (!sentence.empty()) {
      sentence.front() =
          static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
      view["sentences"].push_back(sentence + ".");
    }
  view["summary"] = results.engine.summary;
  view["parts"] = Json::array();
  for (const auto& [part, title] : {std::pair("suite", "The suite"),
                                    {"lockstep", "Against its mirror"},
                                    {"collisions", "Collisions"}})
    if (Json rows = rowsOf(results, part); !rows.empty())
      view["parts"].push_back({{"id", part}, {"title", title}, {"rows", std::move(rows)}});
  view["files"] = "Beside this page: results.json (everything) and junit.xml.";
  return render("report_conformance.html", view);
}

}  // namespace crossgrain::reports
