#include "reports/report.hpp"

#include <optional>
#include <stdexcept>

#include "reports/common/csv.hpp"
#include "reports/common/figures.hpp"
#include "reports/common/gnuplot.hpp"
#include "reports/common/json_view.hpp"
#include "reports/common/pages.hpp"
#include "reports/common/pictures.hpp"
#include "reports/junit.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"

namespace crossgrain {

namespace {

using namespace reports;

/// What a kind of results is written as.
struct Kind {
  std::vector<std::pair<const char*, std::string (*)(const Json&)>> tables;
  std::vector<Figure> (*figures)(const Json&);
  std::vector<Picture> (*pictures)(const Json&);
  std::string (*page)(const Json&, const Illustrations&);
};

std::vector<Picture> noPictures(const Json&) {
  return {};
}

Kind kindOf(const Json& results) {
  const std::string kind = text(results, "kind");
  if (kind == kindCollide)
    return {{{"collisions.csv", collisionsCsv}, {"junit.xml", collideJunit}},
            collideFigures,
            noPictures,
            collidePage};
  if (kind == kindEffects)
    return {{{"effects.csv", effectsCsv}}, effectFigures, noPictures, effectsPage};
  if (kind == kindStability)
    return {{{"stability.csv", stabilityCsv}, {"junit.xml", stabilityJunit}},
            stabilityFigures,
            stabilityPictures,
            stabilityPage};
  if (kind == kindCost) return {{{"cost.csv", costCsv}}, costFigures, noPictures, costPage};
  if (kind == kindAverage)
    return {{{"profiles.csv", profilesCsv},
             {"series.csv", seriesCsv},
             {"regimes.csv", regimesCsv},
             {"steadiness.csv", steadinessCsv},
             {"distributions.csv", distributionsCsv}},
            compareFigures,
            noPictures,
            averagePage};
  if (kind == kindRev)
    return {{{"rev.csv", revCsv}, {"rev_meetings.csv", revMeetingsCsv}},
            revFigures,
            noPictures,
            revPage};
  return {{{"profiles.csv", profilesCsv},
           {"series.csv", seriesCsv},
           {"agreement.csv", agreementCsv},
           {"regimes.csv", regimesCsv},
           {"steadiness.csv", steadinessCsv},
           {"distributions.csv", distributionsCsv}},
          compareFigures,
          comparePictures,
          comparePage};
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

}  // namespace

void writeReport(const nlohmann::json& results, const std::filesystem::path& dir) {
  checkSchema(results, "results");
  makeDirectory(dir);
  writeFile(dir / "results.json", toText(results));
  const Kind kind = kindOf(results);
  for (const auto& [name, table] : kind.tables) writeFile(dir / name, table(results));

  const auto plots = dir / "plots";
  const auto figures = kind.figures(results);
  const auto missing = draw(figures, plots);
  const auto pictures = kind.pictures(results);
  for (const Picture& picture : pictures) writePicture(picture, plots);

  writeFile(dir / "report.html", kind.page(results, {figures, pictures, plots, missing}));
  if (missing) throw std::runtime_error(*missing);
}

void writeReport(const CompareResults& results, const std::filesystem::path& dir) {
  writeReport(toJson(results), dir);
}
void writeReport(const EffectsResults& results, const std::filesystem::path& dir) {
  writeReport(toJson(results), dir);
}
void writeReport(const RevResults& results, const std::filesystem::path& dir) {
  writeReport(toJson(results), dir);
}

nlohmann::json readResults(const std::filesystem::path& dir) {
  return readResultsFile(dir / "results.json");
}

}  // namespace crossgrain
