#include "reports/common/blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/worker/json.hpp"
#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

using Kind = Column::Kind;

/// Adds a row unless the table has it: engines report some things again for every run.
void addRowOnce(Table& table, const Names& texts) {
  const bool known = std::ranges::any_of(table.rows, [&](const TableRow& row) {
    return std::ranges::equal(row.cells, texts, {}, &Cell::text);
  });
  if (!known) table.rows.push_back({{texts.begin(), texts.end()}});
}

Table deviationTable(const std::vector<EffectiveScene>& effective) {
  Table table{{"engine", "deviation", numbers("value"), remarks("note")}};
  for (const auto& [engine, scene, calledFor] : effective)
    for (const auto& [name, value, unit, note] : scene->deviations) {
      const bool has = std::isfinite(value) && (value != 0.0 || !unit.empty());
      addRowOnce(table, {engine, spaced(name),
                         has ? readable(value) + (unit.empty() || unit == "-" ? "" : " " + unit)
                             : absentText,
                         note});
    }
  return table;
}

/// A constant of strength 0 is none; restitutions are of pairs without a spring, the tangential one
/// of those with friction.
Table pairTable(const std::vector<EffectiveScene>& effective) {
  Table table{{"engine", "pair"}};
  for (const char* name : {"k_n", "γ_n", "k_t", "γ_t", "µ", "e_n", "e_t0"})
    table.columns.push_back(numbers(name));
  table.note =
      "In the law's own units: of a linear one N/m and kg/s (docs/cases.md has all). –: the "
      "engine's contacts have no such constant.";
  for (const auto& [engine, scene, calledFor] : effective)
    for (const PairCoefficients& pair : scene->pairs) {
      const bool springs = pair.kn > 0.0;
      Names cells = {engine, pair.pair};
      for (const double constant : {pair.kn, pair.gn, pair.kt, pair.gt, pair.mu})
        cells.push_back(constant != 0.0 ? readableSetting(constant) : absentText);
      cells.push_back(springs ? absentText : readableSetting(pair.en));
      cells.push_back(springs || pair.mu == 0.0 ? absentText : readableSetting(pair.et0));
      addRowOnce(table, cells);
    }
  return table;
}

Names effectsOf(const EffectiveParameters& effective) {
  Names names;
  for (const Effect effect : effective.effects) names.emplace_back(toString(effect));
  return names;
}

/// "", or " in 2 of 3 runs" where it is not all of them.
std::string partOf(std::size_t some, std::size_t all) {
  return some == all ? std::string() : fmt::format(" in {} of {}", some, counted(all, "run"));
}

/// How often an engine simulated an effect, of the scenes that called for it and the others.
Cell effectCell(const std::string& effect, const std::vector<EffectiveScene>& scenes) {
  std::size_t calledFor = 0, missing = 0, extra = 0;
  for (const EffectiveScene& scene : scenes) {
    const bool called = contains(*scene.calledFor, effect);
    const bool simulated = contains(effectsOf(*scene.effective), effect);
    calledFor += called;
    missing += called && !simulated;
    extra += simulated && !called;
  }
  Names words;
  if (missing < calledFor) words.push_back("✓ simulated" + partOf(calledFor - missing, calledFor));
  if (missing > 0) words.push_back("✗ not simulated" + partOf(missing, calledFor));
  if (extra > 0) words.push_back("+ though not called for" + partOf(extra, scenes.size()));
  Cell cell(words.empty() ? absentText : fmt::format("{}", fmt::join(words, "; ")));
  if (missing + extra > 0) cell.verdict = Verdict::borderline;
  return cell;
}

/// Effects by engine, of the scenes whose effects are known.
Table effectTable(const std::vector<EffectiveScene>& effective) {
  Table table{{"effect", "scene"}};
  std::vector<std::pair<std::string, std::vector<EffectiveScene>>> engines;
  std::set<const Names*> scenes;
  Names effects;
  const auto add = [&](const Names& names) {
    for (const std::string& name : names)
      if (!contains(effects, name)) effects.push_back(name);
  };
  for (const EffectiveScene& entry : effective) {
    if (!entry.calledFor) continue;
    auto engine = std::ranges::find(engines, entry.engine, [](const auto& e) { return e.first; });
    if (engine == engines.end()) engine = engines.insert(engine, {entry.engine, {}});
    engine->second.push_back(entry);
    scenes.insert(entry.calledFor);
    add(*entry.calledFor);
  }
  for (const auto& [engine, entries] : engines) {
    table.columns.emplace_back(engine, Kind::engine);
    for (const EffectiveScene& entry : entries) add(effectsOf(*entry.effective));
  }
  for (const std::string& effect : effects) {
    const auto calling = static_cast<std::size_t>(std::ranges::count_if(
        scenes, [&](const Names* calledFor) { return contains(*calledFor, effect); }));
    TableRow row{{spaced(effect),
                  calling == 0 ? absentText
                  : calling == scenes.size()
                      ? "called for"
                      : fmt::format("called for in {} of {} scenes", calling, scenes.size())}};
    for (const auto& [engine, entries] : engines) row.cells.push_back(effectCell(effect, entries));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// "CASE, VARIANT"
std::string caseOf(const ResultsHead& head) {
  const CaseHead& setup = head.setup;
  return setup.variant.empty() ? setup.name : setup.name + ", " + setup.variant;
}

}  // namespace

Drawings drawingsOf(const std::vector<Figure>& figures, std::string_view prefix) {
  Drawings drawings;
  for (const Figure& figure : figures)
    if (figure.name.starts_with(prefix)) drawings.names.push_back(figure.name);
  return drawings;
}

Drawings drawingsOf(const std::vector<Picture>& pictures, Picture::Shows shows) {
  Drawings drawings;
  for (const Picture& picture : pictures)
    if (picture.shows == shows) drawings.names.push_back(picture.name);
  return drawings;
}

std::string nameOf(const ResultsHead& head) {
  const std::string name = caseOf(head);
  return name.empty() ? head.kind : head.kind + " " + name;
}

std::string titleOf(const ResultsHead& head) {
  constexpr std::pair<std::string_view, std::string_view> titles[] = {
      {kindCompare, "Engine agreement"}, {kindAverage, "Averages"},
      {kindCollide, "Collisions"},       {kindLockstep, "Lockstep comparison"},
      {kindEffects, "Effects"},          {kindCost, "Accuracy and cost"},
      {kindRev, "Ring widths"},          {kindStability, "Stability"},
      {kindConformance, "Conformance"}};
  const auto* const found =
      std::ranges::find(titles, head.kind, [](const auto& t) { return t.first; });
  std::string title(found == std::end(titles) ? std::string_view(head.kind) : found->second);
  const std::string name = caseOf(head);
  if (title.empty() || name.empty()) return title + name;
  return title + ": " + name;
}

std::vector<JUnitCase> matrixChecks(const Report& report) {
  return overviewCases(report.overview, titleOf(report.head));
}

void addDetails(Report& report, const std::vector<EffectiveScene>& effective) {
  Section& section = report.section("deviations", "Deviations from the scene", "Deviations");
  if (Table table = deviationTable(effective); table.rows.empty())
    section.blocks.push_back(Paragraph{"No engine reports any deviation from the scene."});
  else
    section.blocks.push_back(std::move(table));
  if (Table table = pairTable(effective); !table.rows.empty())
    section.blocks.push_back(
        Details{"Contact coefficients after each engine's own mixing rule", {std::move(table)}});
  if (Table table = effectTable(effective); !table.rows.empty())
    section.blocks.push_back(Details{"Effects: called for and simulated", {std::move(table)}});
}

void addPackings(Report& report, const std::vector<PackingRow>& packings) {
  Table table{{numbers("packing"), numbers("seed"), "content hash", "prepared"}};
  for (const PackingRow& packing : packings)
    table.rows.push_back({{fmt::format("{}", packing.index), fmt::format("{}", packing.seed),
                           packing.hash, packing.fromCache ? "earlier, kept" : "for this run"}});
  report.section("packings", "Packings")
      .blocks.push_back(Details{counted(packings.size(), "packing"), {std::move(table)}});
}

void addEngines(Report& report) {
  Table table{
      {engineNames("engine"), "version", remarks("status"), "mirrors", remarks("description")}};
  for (const EngineRow& engine : report.engines)
    table.rows.push_back({{engine.name, engine.version,
                           std::string(nameOf(engine.status, engineStatusNames)) +
                               (engine.reason.empty() ? "" : ": " + engine.reason),
                           engine.mirrors, engine.summary}});
  report.section("engines", "Engines").blocks.push_back(std::move(table));
}

}  // namespace crossgrain::reports
