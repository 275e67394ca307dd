#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/common/details.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/packings.hpp"
#include "reports/common/page.hpp"
#include "reports/lockstep/overview.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/lockstep/view.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {

std::string lockstepPage(const LockstepResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, results.elapsed, results.notes, shown);
  view["lead"] = leadOf(results.lockstep);
  view["sentences"] = Json::array();
  std::vector<RealisedScene> realised;
  for (const LockstepRow& row : results.lockstep.rows) {
    view["sentences"].push_back(sentenceOf(row, results.lockstep.rules));
    if (row.realised) realised.push_back({row.engine, &*row.realised, &results.effects});
  }
  addLockstep(view, results.lockstep);
  addOverview(view, lockstepOverview(results), results.engines);
  view["figures"] = figureViews(shown, "lockstep_");
  addDetails(view, realised);
  view["packings"] = packingRows(results.packings);
  view["files"] = "Beside this page: results.json (everything) and lockstep.csv.";
  return render("report_lockstep.html", view);
}

}  // namespace crossgrain::reports
