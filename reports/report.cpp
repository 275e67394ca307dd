#include "reports/report.hpp"

#include <optional>
#include <stdexcept>

#include "cases/files.hpp"
#include "reports/csv.hpp"
#include "reports/figures.hpp"
#include "reports/gnuplot.hpp"
#include "reports/json_view.hpp"
#include "reports/pages.hpp"
#include "reports/pictures.hpp"
#include "reports/schema.hpp"

namespace crossgrain {

namespace {

using namespace reports;

void writeTables(const nlohmann::json& results, const std::filesystem::path& dir) {
  if (text(results, "kind") == kindCollide) {
    writeFile(dir / "collisions.csv", collisionsCsv(results));
    return;
  }
  writeFile(dir / "profiles.csv", profilesCsv(results));
  writeFile(dir / "series.csv", seriesCsv(results));
  writeFile(dir / "agreement.csv", agreementCsv(results));
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
  writeTables(results, dir);

  const bool collide = text(results, "kind") == kindCollide;
  const auto plots = dir / "plots";
  const auto figures = collide ? collideFigures(results) : compareFigures(results);
  const auto missing = draw(figures, plots);
  const auto pictures = collide ? std::vector<Picture>{} : comparePictures(results);
  for (const Picture& picture : pictures) writePicture(picture, plots);

  const Illustrations shown{figures, pictures, plots, missing};
  writeFile(dir / "report.html",
            collide ? collidePage(results, shown) : comparePage(results, shown));
  if (missing) throw std::runtime_error(*missing);
}

nlohmann::json readResults(const std::filesystem::path& dir) {
  return readResultsFile(dir / "results.json");
}

}  // namespace crossgrain
