#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>

#include "cases/case_files.hpp"
#include "cases/loader.hpp"
#include "cli/one_case.hpp"
#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "reports/collide/report.hpp"
#include "reports/collide/table.hpp"
#include "reports/report.hpp"
#include "runs/collide/collide.hpp"
#include "runs/collide/folder.hpp"
#include "runs/common/resumable.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;

namespace {

/// Runs what was loaded into one report.
int collideCases(const std::vector<Case>& variants, const std::optional<fs::path>& folder,
                 const CommandLine& line, bool strict) {
  const fs::path& out = line.run.out;
  RunStore store(line.run, "collide", keysOfEach(variants));
  if (line.run.dryRun) return told(collidePlan(variants, line.run, store));
  CollideResults results = collideEngines(variants, line.run, store);
  if (folder) results.head.setup = headOfFolder(*folder, variants);
  writeReport(results, out);

  std::map<std::string, std::string> reasons;
  std::map<std::string, int> refused;
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves) {
      if (curve.status == SweepStatus::failed) reasons.emplace(curve.engine, curve.reason);
      refused[curve.engine] += curve.status == SweepStatus::refused;
    }
  for (const auto& [engine, reason] : reasons) fmt::print(stderr, "crossgrain: {}\n", reason);
  for (const auto& [engine, count] : refused)
    if (count > 0 && !line.json)
      fmt::print("{} does not have the law of {} sweeps; the report says why\n", engine, count);
  const reports::CollideCount count = reports::countOf(results);
  if (line.json)
    fmt::print("{}\n", (out / "results.json").string());
  else {
    fmt::print("{} curves held, {} differ by their model, {} fell short, {} not judged\n",
               count.held, count.modelDifference, count.fellShort, count.notJudged);
    printOverview(reports::collideOverview(results));
    fmt::print("report: {}\n", (out / "report.html").string());
  }
  if (count.failed > 0) return exitEngineFailed;
  if (count.judged() == 0) return nothingWasJudged(line, reports::nothingJudged(results));
  // An engine that is true to conventions which the case lets it have does what it says. Whether
  // that is the scene's law, too, is what --strict asks.
  const bool asked = strict && count.modelDifference > 0;
  return count.fellShort > 0 || asked ? exitFellShort : exitHeld;
}

int collide(const CommandLine& line, bool strict) {
  const fs::path& input = line.inputs.front();
  const bool isFolder = fs::is_directory(input);
  std::vector<Case> variants =
      isFolder ? collisionsOf(input, line.overrides) : loadCase(input, line.overrides);
  if (variants.front().kind != CaseKind::collision) refuseKind(variants.front(), input, "collide");
  if (line.only) variants = selectedCases(variants, *line.only);
  reportKeysWithoutUse(variants, "collide", line.json ? stderr : stdout);
  return collideCases(variants, isFolder ? std::optional(input) : std::nullopt, line, strict);
}

Action declareCollide(CLI::App& app, CommandLine& line) {
  const auto strict = std::make_shared<bool>(false);
  addCase(app, line, "case file or folder of case files");
  addSelection(app, line);
  addRun(app, line);
  addFlag(app, "--strict", *strict,
          "engines must hold to the scene's law, not only to the one that they declare");
  return [&line, strict] { return resumably(line.run, [&] { return collide(line, *strict); }); };
}

}  // namespace

extern const Command collideCommand = {
    "collide", "two-particle sweeps against the oracle",
    "crossgrain collide cases/collision/figure-4-3.toml --engines grain,yade --out out/collide\n"
    "crossgrain collide cases/collision -k glass --engines grain --out out/glass",
    declareCollide};

}  // namespace crossgrain::inline cli
