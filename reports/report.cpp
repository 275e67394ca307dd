#include "reports/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "reports/collide/overview.hpp"
#include "reports/collide/report.hpp"
#include "reports/common/gnuplot.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/pictures.hpp"
#include "reports/conformance/report.hpp"
#include "reports/cost/report.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/report.hpp"
#include "reports/effects/overview.hpp"
#include "reports/effects/report.hpp"
#include "reports/lockstep/overview.hpp"
#include "reports/lockstep/report.hpp"
#include "reports/scale/overview.hpp"
#include "reports/scale/report.hpp"
#include "reports/stability/overview.hpp"
#include "reports/stability/report.hpp"
#include "reports/thesis/report.hpp"
#include "results/json_fields.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"

namespace crossgrain {

namespace {

using namespace reports;

/// What a kind of results is written as.
template <typename Results>
struct Kind {
  std::vector<std::pair<const char*, std::string (*)(const Results&)>> tables;
  std::vector<Figure> (*figures)(const Results&);
  std::vector<Picture> (*pictures)(const Results&);
  std::string (*page)(const Results&, const Illustrations&);
  Overview (*overview)(const Results&) = nullptr;  ///< null: its report opens with none
  /// Numbers beside the matrix, to be followed over versions; null: there are none.
  std::vector<DigestValue> (*values)(const Results&) = nullptr;
};

/// What the report's matrix says, for build servers.
template <auto overviewOf, typename Results>
std::string overviewJunit(const Results& results) {
  return junitXml(results.head.kind, overviewCases(overviewOf(results), titleOf(results.head)));
}

template <typename Results>
std::vector<Picture> noPictures(const Results&) {
  return {};
}

const Kind<CompareResults> compareKind = {{{"profiles.csv", profilesCsv},
                                           {"series.csv", seriesCsv},
                                           {"endpoints.csv", endpointsCsv},
                                           {"agreement.csv", agreementCsv},
                                           {"regimes.csv", regimesCsv},
                                           {"steadiness.csv", steadinessCsv},
                                           {"distributions.csv", distributionsCsv},
                                           {"junit.xml", overviewJunit<compareOverview>}},
                                          compareFigures,
                                          comparePictures,
                                          comparePage,
                                          compareOverview,
                                          compareValues};

const Kind<CompareResults> averageKind = {{{"profiles.csv", profilesCsv},
                                           {"series.csv", seriesCsv},
                                           {"regimes.csv", regimesCsv},
                                           {"steadiness.csv", steadinessCsv},
                                           {"distributions.csv", distributionsCsv}},
                                          compareFigures,
                                          noPictures,
                                          averagePage,
                                          averageOverview};

const Kind<ConformanceResults> conformanceKind = {
    {{"junit.xml", conformanceJunit}}, conformanceFigures, noPictures, conformancePage};

const Kind<EffectsResults> effectsKind = {
    {{"effects.csv", effectsCsv}}, effectFigures, noPictures, effectsPage, effectsOverview};

const Kind<LockstepResults> lockstepKind = {
    {{"lockstep.csv", lockstepCsv}, {"junit.xml", overviewJunit<lockstepOverview>}},
    lockstepFigures,
    noPictures,
    lockstepPage,
    lockstepOverview};

const Kind<RevResults> revKind = {{{"rev.csv", revCsv}, {"rev_meetings.csv", revMeetingsCsv}},
                                  revFigures,
                                  noPictures,
                                  revPage,
                                  revOverview};

const Kind<CollideResults> collideKind = {
    {{"collisions.csv", collisionsCsv}, {"junit.xml", collideJunit}},
    collideFigures,
    noPictures,
    collidePage,
    collideOverview};

const Kind<StabilityResults> stabilityKind = {
    {{"stability.csv", stabilityCsv}, {"junit.xml", stabilityJunit}},
    stabilityFigures,
    stabilityPictures,
    stabilityPage,
    stabilityOverview};

const Kind<CostResults> costKind = {
    {{"cost.csv", costCsv}}, costFigures, noPictures, costPage, costOverview};

const Kind<ScaleResults> scaleKind = {
    {{"scale.csv", scaleCsv}}, scaleFiguresOf, noPictures, scalePage, scaleOverview};

const Kind<ThesisResults> thesisKind = {{{"claims.csv", claimsCsv},
                                         {"history.csv", historyCsv},
                                         {"regime_map.csv", regimeMapCsv},
                                         {"readings.csv", interpretationsCsv}},
                                        thesisFigures,
                                        noPictures,
                                        thesisPage,
                                        thesisOverview};

const Kind<CompareResults>& kindOf(const CompareResults& results) {
  return results.head.kind == kindAverage ? averageKind : compareKind;
}

/// @returns why there are no plots, if so
std::optional<std::string> draw(const std::vector<Figure>& figures,
                                const std::filesystem::path& plots) {
  makeDirectory(plots);
  std::vector<std::string> scripts;
  for (const Figure& figure : figures) scripts.push_back(writeFigure(figure, plots));
  try {
    runGnuplot(scripts, plots);
  } catch (const GnuplotError& error) {
    return error.what();
  }
  return std::nullopt;
}

template <typename Results>
std::vector<EngineRow> enginesOf(const Results& results) {
  if constexpr (requires { results.engines; })
    return results.engines;
  else if constexpr (std::same_as<Results, ConformanceResults>)
    return {results.engine};
  else
    return {{results.engine, "", "", "", EngineStatus::ran, ""}};  // whose snapshots
}

/// @param document  results.json
template <typename Results>
ReportDigest write(const Kind<Results>& kind, const Results& results, Json document,
                   const std::filesystem::path& dir) {
  makeDirectory(dir);
  ReportDigest digest{results.head, enginesOf(results), {}};
  if (kind.overview) {
    digest.overview = kind.overview(results);
    if (kind.values) digest.values = kind.values(results);
    document["overview"] = toJson(*digest.overview);
    writeFile(dir / "summary.md", overviewMarkdown(*digest.overview, titleOf(results.head)));
  }
  writeFile(dir / "results.json", toText(document));
  for (const auto& [name, table] : kind.tables) writeFile(dir / name, table(results));

  const auto plots = dir / "plots";
  const auto figures = kind.figures(results);
  const auto missing = draw(figures, plots);
  const auto pictures = kind.pictures(results);
  for (const Picture& picture : pictures) writePicture(picture, plots);

  writeFile(dir / "report.html", kind.page(results, {figures, pictures, plots, missing}));
  if (missing) throw std::runtime_error(*missing);
  return digest;
}

ReportDigest writeKind(const Json& results, const std::filesystem::path& dir) {
  checkSchema(results, "results");
  const std::string kind = results.at("kind");
  if (kind == kindCollide) return write(collideKind, collideFromJson(results), results, dir);
  if (kind == kindConformance)
    return write(conformanceKind, conformanceFromJson(results), results, dir);
  if (kind == kindCost) return write(costKind, costFromJson(results), results, dir);
  if (kind == kindEffects) return write(effectsKind, effectsFromJson(results), results, dir);
  if (kind == kindLockstep) return write(lockstepKind, lockstepFromJson(results), results, dir);
  if (kind == kindRev) return write(revKind, revFromJson(results), results, dir);
  if (kind == kindScale) return write(scaleKind, scaleFromJson(results), results, dir);
  if (kind == kindStability) return write(stabilityKind, stabilityFromJson(results), results, dir);
  if (kind == kindThesis) return write(thesisKind, thesisFromJson(results), results, dir);
  const CompareResults compared = compareFromJson(results);
  return write(kindOf(compared), compared, results, dir);
}

}  // namespace

void writeReport(const CollideResults& results, const std::filesystem::path& dir) {
  write(collideKind, results, toJson(results), dir);
}

void writeReport(const ConformanceResults& results, const std::filesystem::path& dir) {
  write(conformanceKind, results, toJson(results), dir);
}

void writeReport(const CostResults& results, const std::filesystem::path& dir) {
  write(costKind, results, toJson(results), dir);
}

void writeReport(const LockstepResults& results, const std::filesystem::path& dir) {
  write(lockstepKind, results, toJson(results), dir);
}

void writeReport(const ScaleResults& results, const std::filesystem::path& dir) {
  write(scaleKind, results, toJson(results), dir);
}

void writeReport(const StabilityResults& results, const std::filesystem::path& dir) {
  write(stabilityKind, results, toJson(results), dir);
}

void writeReport(const CompareResults& results, const std::filesystem::path& dir) {
  write(kindOf(results), results, toJson(results), dir);
}

void writeReport(const EffectsResults& results, const std::filesystem::path& dir) {
  write(effectsKind, results, toJson(results), dir);
}

void writeReport(const RevResults& results, const std::filesystem::path& dir) {
  write(revKind, results, toJson(results), dir);
}

void writeReport(const ThesisResults& results, const std::filesystem::path& dir) {
  write(thesisKind, results, toJson(results), dir);
}

ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir,
                         const std::filesystem::path& from) {
  return understood(from / "results.json", [&] { return writeKind(results, dir); });
}

ReportDigest writeReport(const nlohmann::json& results, const std::filesystem::path& dir) {
  return writeReport(results, dir, dir);
}

void writeSite(const std::vector<std::pair<std::filesystem::path, nlohmann::json>>& results,
               const std::filesystem::path& site) {
  makeDirectory(site);
  std::vector<std::filesystem::path> folders;
  for (const auto& [folder, document] : results) folders.push_back(folder);
  const std::vector<std::string> names = siteFolders(folders);
  std::vector<SiteReport> reports;
  for (std::size_t k = 0; k < results.size(); ++k) {
    SiteReport report{
        names[k], writeReport(results[k].second, site / names[k], results[k].first), {}};
    for (const auto& entry : std::filesystem::directory_iterator(site / names[k]))
      if (entry.path().extension() == ".csv")
        report.tables.push_back(entry.path().filename().string());
    std::ranges::sort(report.tables);
    reports.push_back(std::move(report));
  }
  writeIndex(reports, site);
}

nlohmann::json readResults(const std::filesystem::path& dir) {
  return readResultsFile(dir / "results.json");
}

}  // namespace crossgrain
