#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/cost/cells.hpp"
#include "reports/cost/report.hpp"
#include "reports/cost/tables.hpp"
#include "reports/cost/words.hpp"

namespace crossgrain::reports {

namespace {

/// What errors are shares of.
const char* unitOf(CostKind kind) {
  constexpr std::array units = {"of the curve's range", "of a small disk's diameter",
                                "of the profile's largest value"};
  return units[static_cast<std::size_t>(kind)];
}

std::string basisText(CostBasis basis) {
  return basis == CostBasis::own ? "its own limit" : "the case's law";
}

/// "its limit of small steps is 25 % off the case's law in Ψ_f (24 % to 26 %)"
std::string modelText(const CostModel& model) {
  const std::string low = percentText(model.low), high = percentText(model.high);
  return fmt::format("its limit of small steps is {} off the case's law in {}{}",
                     percentText(model.error), measureWords(model.measure),
                     low == high ? "" : fmt::format(" ({} to {})", low, high));
}

/// How far an engine's limit is shown to be from the case's law, measure by measure; what may be
/// nothing is left out.
std::vector<std::string> modelTexts(const CostResults& results, const std::string& engine,
                                    CostKind kind, CostBasis basis) {
  std::vector<std::string> texts;
  for (const CostModel& model : results.models)
    if (basis == CostBasis::scene && model.engine == engine && model.kind == kind &&
        model.low > 0.0)
      texts.push_back(modelText(model));
  return texts;
}

/// The measured figure: what decides, by which measure.
std::string figureOf(const CostResults& results, const CostCell& cell) {
  if (cell.model && *cell.model < results.models.size())
    return modelText(results.models[*cell.model]);
  const CostPoint* point = pointAt(results.points, cell.point);
  return point ? fmt::format("{}: {}", measureWords(sceneOf(point->measure)), intervalText(*point))
               : "";
}

std::string settingOf(const CostCell& cell) {
  return cell.setting.empty() ? "" : settingWords(cell.knob, cell.setting);
}

Json accuracyCell(const CostResults& results, const CostCell& cell) {
  const bool reached = cell.verdict == CostVerdict::reached;
  const std::string verdict = toString(cell.verdict), setting = settingOf(cell);
  const std::string best = setting.empty() || reached || cell.model ? "" : "best: " + setting;
  const std::string time =
      cell.wallSeconds && !cell.model ? readableDuration(cell.wallSeconds) : "";
  return verdictCell(cell.verdict, reached ? setting : verdict,
                     {best, time, figureOf(results, cell), decidesText(cell.decides)});
}

/// Cells of one engine, kind and basis, in the order of their targets.
std::vector<const CostCell*> lineOf(const CostResults& results, const std::string& engine,
                                    CostKind kind, CostBasis basis) {
  std::vector<const CostCell*> line;
  for (const CostCell& cell : results.cells)
    if (cell.engine == engine && cell.kind == kind && cell.basis == basis) line.push_back(&cell);
  return line;
}

std::vector<double> targetsOf(const CostResults& results) {
  std::vector<double> targets;
  for (const CostCell& cell : results.cells)
    if (std::ranges::find(targets, cell.target) == targets.end()) targets.push_back(cell.target);
  return targets;
}

std::string oneLine(const CostResults& results, const CostCell& cell) {
  std::vector<std::string> words;
  const bool reached = cell.verdict == CostVerdict::reached;
  if (!reached) words.push_back(toString(cell.verdict));
  if (reached) words.push_back(settingOf(cell));
  if (reached && cell.wallSeconds) words.push_back(readableDuration(cell.wallSeconds));
  if (const std::string figure = figureOf(results, cell); !figure.empty()) words.push_back(figure);
  if (!cell.decides.empty()) words.push_back(decidesText(cell.decides));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

const CostCell* cheapestOf(const CostResults& results, CostKind kind, double target) {
  const CostCell* cheapest = nullptr;
  for (const CostCell& cell : results.cells)
    if (cell.kind == kind && cell.basis == CostBasis::scene && cell.target == target &&
        cell.verdict == CostVerdict::reached && cell.wallSeconds &&
        (!cheapest || *cell.wallSeconds < *cheapest->wallSeconds))
      cheapest = &cell;
  return cheapest;
}

std::string decidedInWords(const CostResults& results) {
  std::vector<std::string> words;
  for (const CostBasis basis : costBases) {
    std::size_t all = 0, decided = 0;
    for (const CostCell& cell : results.cells)
      if (cell.basis == basis) ++all, decided += cell.decided();
    if (all > 0)
      words.push_back(fmt::format(
          "{} of {} against {}", decided, all,
          basis == CostBasis::own ? "engines' own limits of small steps" : "the case's law"));
  }
  if (words.empty()) return "Nothing was measured.";
  return fmt::format("Which setting reaches an accuracy for the least time is decided for {}.",
                     fmt::join(words, " and "));
}

std::vector<std::string> accuracyInWords(const CostResults& results) {
  std::vector<std::string> sentences;
  for (const double target : targetsOf(results)) {
    std::vector<std::string> parts;
    for (const CostKind kind : kindsIn(results.points)) {
      const CostCell* cheapest = cheapestOf(results, kind, target);
      parts.push_back(cheapest
                          ? fmt::format("{} with {} at {}, {} for {}", toString(kind),
                                        cheapest->engine, settingOf(*cheapest),
                                        readableDuration(cheapest->wallSeconds), timeUnit(kind))
                          : fmt::format("{}: no engine is shown to", toString(kind)));
    }
    sentences.push_back(fmt::format("{} of the case's law is reached for the least time in: {}.",
                                    targetText(target), fmt::join(parts, "; ")));
  }
  return sentences;
}

Json accuracyGroups(const CostResults& results, const std::vector<CostEngine>& engines) {
  Json groups = Json::array();
  for (const CostKind kind : kindsIn(results.points)) {
    Json rows = Json::array();
    for (const CostEngine& engine : engines)
      for (const CostBasis basis : costBases) {
        const auto line = lineOf(results, engine.name, kind, basis);
        if (line.empty()) continue;
        Json row = headOf(engine);
        row["basis"] = basisText(basis);
        row["models"] = modelTexts(results, engine.name, kind, basis);
        row["cells"] = Json::array();
        for (const CostCell* cell : line) row["cells"].push_back(accuracyCell(results, *cell));
        rows.push_back(std::move(row));
      }
    if (!rows.empty())
      groups.push_back({{"title", fmt::format("{}, {}; time of {}", toString(kind), unitOf(kind),
                                              timeUnit(kind))},
                        {"span", targetsOf(results).size() + 2},
                        {"rows", std::move(rows)}});
  }
  return groups;
}

Json accuracyTargets(const CostResults& results) {
  Json targets = Json::array();
  for (const double target : targetsOf(results)) targets.push_back(targetText(target));
  return targets;
}

std::string costAccuracyText(const CostResults& results) {
  std::string text;
  for (const CostEngine& engine : costEngines(results))
    for (const CostKind kind : kindsIn(results.points))
      for (const CostBasis basis : costBases) {
        const auto line = lineOf(results, engine.name, kind, basis);
        if (line.empty()) continue;
        text += fmt::format("{}, {}, {}:\n", engine.name, toString(kind), basisText(basis));
        for (const std::string& model : modelTexts(results, engine.name, kind, basis))
          text += fmt::format("  {}\n", model);
        for (const CostCell* cell : line)
          text += fmt::format("  {:>5}  {}\n", targetText(cell->target), oneLine(results, *cell));
      }
  return text + decidedInWords(results) + "\n";
}

}  // namespace crossgrain::reports
