#include "reports/flow/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "results/schema.hpp"

namespace crossgrain::reports {

namespace {

/// Verbs for a packing in each regime; for several packings.
struct Verb {
  std::optional<Regime> regime;  ///< absent: undecided
  const char *one, *many;
};
constexpr Verb verbs[] = {
    {Regime::blocked, "is blocked", "are blocked"},
    {Regime::collisional, "is collisional", "are collisional"},
    {Regime::flowing, "flows", "flow"},
    {{}, "is undecided", "are undecided"},
};

/// Engines by regime, of one packing.
using ByRegime = std::map<std::optional<Regime>, Names>;

std::map<int, ByRegime> regimesByPacking(const Engines& engines) {
  std::map<int, ByRegime> packings;
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.finished)
      if (run->regime) packings[run->packing][run->regime->regime].push_back(engine.name);
  return packings;
}

/// "is blocked on a, b; flows on c", or "flows on every engine" of those that finished anything.
std::string doesWhat(const ByRegime& engines, std::size_t all, bool many) {
  Names parts;
  for (const Verb& verb : verbs) {
    const auto found = engines.find(verb.regime);
    if (found == engines.end()) continue;
    const bool every = all > 1 && found->second.size() == all;
    parts.push_back(
        fmt::format("{} on {}", many ? verb.many : verb.one,
                    every ? "every engine" : fmt::format("{}", fmt::join(found->second, ", "))));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

void addRegimes(Names& sentences, const Engines& engines) {
  const auto packings = regimesByPacking(engines);
  if (packings.empty()) return;
  const auto all = static_cast<std::size_t>(
      std::ranges::count_if(engines, [](const auto& engine) { return !engine.finished.empty(); }));
  // Packings that do the same are listed together, those that flow everywhere last.
  std::map<std::string, std::vector<int>> alike;
  for (const auto& [packing, byRegime] : packings)
    alike[doesWhat(byRegime, all, false)].push_back(packing);
  const auto flows = [&](const std::vector<int>& group) {
    const ByRegime& first = packings.at(group.front());
    return first.size() == 1 && first.begin()->first == Regime::flowing;
  };
  for (const bool last : {false, true})
    for (const auto& [what, group] : alike) {
      if (flows(group) != last) continue;
      const bool many = group.size() > 1;
      const std::string does = doesWhat(packings.at(group.front()), all, many);
      sentences.push_back(
          alike.size() == 1 && many
              ? fmt::format("All {} packings {}.", group.size(), does)
              : fmt::format("Packing{} {} {}.", many ? "s" : "", indicesText(group), does));
    }
  Names mixed;
  for (const EngineRuns& engine : engines) {
    std::set<Regime> regimes;
    for (const FlowRun* run : engine.finished)
      if (run->regime && run->regime->regime) regimes.insert(*run->regime->regime);
    if (regimes.size() > 1) mixed.push_back(engine.name);
  }
  if (!mixed.empty())
    sentences.push_back(
        fmt::format("Means over packings mix regimes on {}: they describe none of them.",
                    fmt::join(mixed, ", ")));
}

std::string packingsInWords(const std::vector<int>& indices) {
  return fmt::format("packing{} {}", indices.size() > 1 ? "s" : "", fmt::join(indices, ", "));
}

void addPairs(Names& sentences, const CompareResults& results, const std::string& reference) {
  Names pairs;
  for (const RegimesOfPair& pair : results.regimes) {
    if (pair.differ.empty() || (pair.a != reference && pair.b != reference)) continue;
    pairs.push_back(fmt::format("{} on {}", pair.a == reference ? pair.b : pair.a,
                                packingsInWords(pair.differ)));
  }
  if (!pairs.empty())
    sentences.push_back(fmt::format(
        "Not in the same regime as {}: {}. These pairs are compared in different states.",
        reference, fmt::join(pairs, "; ")));
}

/// How one engine's answers on its series add up.
struct Answers {
  Names drifts;                    ///< "outer pressure falls by 40 ± 8 %"
  std::optional<double> excluded;  ///< the largest change that is not excluded in any series
  std::string worst;               ///< in which
  bool seenNone = true;            ///< every series: no drift seen
};

std::map<std::string, Answers> answersByEngine(const std::vector<EngineDrift>& steadiness) {
  std::map<std::string, Answers> engines;
  for (const EngineDrift& row : steadiness) {
    Answers& answers = engines[row.engine];
    const std::string quantity = spaced(row.quantity);
    const auto change = finite(row.drift.change), half = finite(row.drift.half);
    const auto excluded = finite(row.drift.excluded);
    answers.seenNone = answers.seenNone && row.drift.verdict == Drift::notSeen;
    if (row.drift.verdict == Drift::drifts && change && half)
      answers.drifts.push_back(
          fmt::format("{} {} by {} ± {} %", quantity, *change < 0.0 ? "falls" : "rises",
                      readablePercent(std::abs(*change)), readablePercent(*half)));
    if (excluded && *excluded > answers.excluded.value_or(-1.0)) {
      answers.excluded = excluded;
      answers.worst = quantity;
    }
  }
  return engines;
}

void addSteadiness(Names& sentences, const CompareResults& results, const Engines& engines) {
  const auto answers = answersByEngine(results.steadiness);
  Names none, open;
  std::optional<double> largest;
  std::string series;
  for (const EngineRuns& engine : engines) {
    const auto found = answers.find(engine.name);
    if (found == answers.end()) continue;
    const Answers& here = found->second;
    if (!here.drifts.empty()) continue;
    if (here.seenNone && here.excluded) {
      none.push_back(
          fmt::format("{} (down to {} %)", engine.name, readablePercent(*here.excluded)));
    } else {
      open.push_back(engine.name);
      if (here.excluded && *here.excluded > largest.value_or(-1.0)) {
        largest = here.excluded;
        series = here.worst;
      }
    }
  }
  if (!none.empty())
    sentences.push_back(
        fmt::format("No drift seen over the averaged time: {}.", fmt::join(none, ", ")));
  if (!open.empty())
    sentences.push_back(
        fmt::format("Steady or not is undecided for {}{}.", fmt::join(open, ", "),
                    largest ? fmt::format(": changes of {} by up to {} % are not excluded", series,
                                          readablePercent(*largest))
                            : std::string()));
}

std::string range(double from, double to) {
  return readableSetting(from) + " to " + readableSetting(to);
}

using Rows = std::vector<TableRow>;

/// The run's regime with the numbers that it follows from.
Cell regimeOfRun(const FlowRun& run) {
  if (!run.regime) return absentText;
  const RegimeRow& regime = *run.regime;
  std::string numbers = fmt::format("contacts {}, slip {}, shear {}, I {}",
                                    readable(regime.wheelContacts), readable(regime.wheelSlip),
                                    readable(regime.shearShare), readable(regime.inertialNumber));
  // A run that is blocked throughout, or never, is named so.
  if (const auto blocked = finite(regime.blockedFraction);
      blocked && *blocked > 0.0 && *blocked < 1.0)
    numbers += fmt::format("; blocked {} % of the time", readablePercent(*blocked));
  return {std::string(regime.regime ? toString(*regime.regime) : "undecided"),
          {std::move(numbers), regime.reason}};
}

Table regimeTable(const Engines& engines) {
  Table table{engineColumns({numbers("packing")}, engines)};
  std::set<int> packings;
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.finished)
      if (run->regime) packings.insert(run->packing);
  for (const int packing : packings) {
    TableRow row{{fmt::format("{}", packing)}};
    for (const EngineRuns& engine : engines) {
      const auto* const run = findBy(engine.finished, packing, &FlowRun::packing);
      row.cells.push_back(run ? regimeOfRun(**run) : absentText);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table regimePairTable(const std::vector<RegimesOfPair>& pairs) {
  Table table{{"pair", "packings in the same regime", "not in the same"}};
  for (const RegimesOfPair& pair : pairs)
    table.rows.push_back(
        {{pair.a + " – " + pair.b,
          fmt::format("{} of {}", pair.packings - static_cast<int>(pair.differ.size()),
                      pair.packings),
          pair.differ.empty() ? std::string(absentText) : indicesText(pair.differ)}});
  return table;
}

/// "−40 ± 8 %"
std::string describeChange(const RelativeDrift& drift) {
  const auto change = finite(drift.change), half = finite(drift.half);
  if (!change || !half) return absentText;
  return fmt::format("{}{} ± {} %", *change < 0.0 ? "−" : "+", readablePercent(std::abs(*change)),
                     readablePercent(*half));
}

Cell steadinessCell(const EngineDrift& row) {
  std::string word(toString(row.drift.verdict));
  if (row.drift.verdict == Drift::notSeen)
    word += fmt::format(" down to {} %", readablePercent(row.drift.excluded.value_or(0.0)));
  Cell cell(word, {describeChange(row.drift)});
  if (!row.drifting.empty())
    cell.notes.push_back("by themselves drift: " + indicesText(row.drifting));
  return cell;
}

Table steadinessTable(const std::vector<EngineDrift>& all, const Engines& engines) {
  Table table{engineColumns({"series"}, engines)};
  Names quantities;
  for (const EngineDrift& row : all) addOnce(quantities, row.quantity);
  for (const std::string& quantity : quantities) {
    TableRow row{{spaced(quantity)}};
    for (const EngineRuns& engine : engines) {
      const EngineDrift* const found = findIf(all, [&](const EngineDrift& drift) {
        return drift.engine == engine.name && drift.quantity == quantity;
      });
      row.cells.push_back(found ? steadinessCell(*found) : absentText);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

using Text = std::function<std::string(const EngineRuns&)>;

TableRow tableRow(const std::string& label, const std::string& unit, const Engines& engines,
                  const Text& text) {
  TableRow row{{label}};
  for (const EngineRuns& engine : engines) row.cells.emplace_back(text(engine));
  row.cells.emplace_back(unit == "-" ? "" : unit);
  return row;
}

/// Adds rows under a heading.
void addGroup(Table& table, const std::string& title, Rows rows) {
  if (!rows.empty()) rows.front().group = title;
  for (TableRow& row : rows) table.rows.push_back(std::move(row));
}

Table emptyTable(const Engines& engines) {
  Table table{engineColumns({""}, engines)};
  table.columns.emplace_back("unit");
  return table;
}

Text fromEffective(std::string EffectiveParameters::*member) {
  return [member](const EngineRuns& engine) {
    const EffectiveParameters* effective = engine.effective();
    return !effective || (effective->*member).empty() ? std::string(absentText)
                                                      : spaced(effective->*member);
  };
}

std::string statusOf(const EngineRuns& engine) {
  if (engine.runs.empty()) return std::string(nameOf(engine.status, engineStatusNames));
  return fmt::format("{} of {}", engine.finished.size(), engine.runs.size());
}

Rows whatRan(const Engines& engines) {
  Rows rows;
  const auto add = [&](const char* label, const Text& text) {
    rows.push_back(tableRow(label, "", engines, text));
  };
  add("version", &EngineRuns::version);
  if (std::ranges::any_of(engines, [](const auto& e) { return !e.mirrors.empty(); }))
    add("mirrors", &EngineRuns::mirrors);
  add("runs finished", statusOf);
  if (std::ranges::any_of(engines, [](const auto& e) { return !e.surrogate.empty(); }))
    add("verdicts rest on the runs of", [](const EngineRuns& engine) {
      return engine.surrogate.empty() ? engine.name : engine.surrogate;
    });
  add("precision", fromEffective(&EffectiveParameters::precision));
  add("integrator", fromEffective(&EffectiveParameters::integrator));
  return rows;
}

const HeadNumber* headOf(const EngineRuns& engine, const std::string& name) {
  return findBy(engine.head(), name, &HeadNumber::name);
}

TableRow headRow(const std::string& name, const Engines& engines) {
  std::string unit;
  for (const EngineRuns& engine : engines)
    if (const HeadNumber* number = headOf(engine, name); number && unit.empty())
      unit = number->unit;
  return tableRow(headLabel(name), unit, engines, [&name](const EngineRuns& engine) {
    const HeadNumber* number = headOf(engine, name);
    if (!number) return std::string(absentText);
    return readable(number->value, number->standardError) + (engine.isSingle ? " (one run)" : "");
  });
}

/// Counters that engines keep of their own, summed over finished runs.
Rows counterRows(const Engines& engines) {
  std::set<std::string> names;
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.finished)
      if (run->stats)
        for (const auto& [name, value] : run->stats->counters) names.insert(name);
  Rows rows;
  for (const std::string& name : names)
    rows.push_back(tableRow(headLabel(name), "", engines, [&name](const EngineRuns& engine) {
      std::optional<double> sum;
      for (const FlowRun* run : engine.finished) {
        if (!run->stats) continue;
        const auto counter = run->stats->counters.find(name);
        const auto value =
            counter == run->stats->counters.end() ? std::nullopt : finite(counter->second);
        if (value) sum = sum.value_or(0.0) + *value;
      }
      return readableCount(sum);
    }));
  return rows;
}

constexpr const char* stepFraction = "dt_over_tc";

Rows costRows(const Engines& engines) {
  Rows rows;
  const auto add = [&](const char* label, const char* unit, const Text& text) {
    rows.push_back(tableRow(label, unit, engines, text));
  };
  add("time step dt", "s", [](const EngineRuns& engine) {
    return engine.effective() ? readableSetting(engine.effective()->dt) : std::string(absentText);
  });
  rows.push_back(headRow(stepFraction, engines));
  add("steps", "", [](const auto& e) { return readableCount(costOf(e).steps); });
  add("wall time", "", [](const auto& e) { return readableDuration(costOf(e).wall); });
  add("CPU time", "", [](const auto& e) { return readableDuration(costOf(e).cpu); });
  add("wall time per step", "µs", [](const EngineRuns& engine) {
    const EngineCost cost = costOf(engine);
    return readable(times(quotient(cost.wall, cost.steps), 1e6));
  });
  add("CPU time per simulated second", "s",
      [](const auto& e) { return readable(costOf(e).cpuPerSecond()); });
  std::ranges::move(counterRows(engines), std::back_inserter(rows));
  return rows;
}

Rows stateRows(const Engines& engines) {
  Names names;
  for (const EngineRuns& engine : engines)
    for (const HeadNumber& number : engine.head())
      if (number.name != stepFraction) addOnce(names, number.name);
  Rows rows;
  for (const std::string& name : names) rows.push_back(headRow(name, engines));
  return rows;
}

/// Engines and runs that did not run to the end.
Table troubleTable(const Engines& engines) {
  Table table{{engineNames("engine"), "packing", "status", remarks("reason")}};
  for (const EngineRuns& engine : engines) {
    if (engine.status != Status::finished)
      table.rows.push_back(
          {{engine.name, "all", std::string(nameOf(engine.status, engineStatusNames)),
            engine.reason}});
    for (const FlowRun* run : engine.runs)
      if (!run->finished())
        table.rows.push_back({{engine.name, readableCount(run->packing),
                               std::string(nameOf(run->status, runStatusNames)), run->reason}});
  }
  return table;
}

/// "10 slabs of width 0.01 m along y", "1 bin"
std::string binsInWords(const FlowFrame& frame) {
  const RegionRow& region = *frame.region;
  const std::size_t bins = frame.rings.r.size();
  if (region.bins == "whole") return "The whole box as one bin";
  if (region.bins == "grid") return fmt::format("A grid of {} bins", bins);
  return fmt::format("{} {} of width {} m{}", bins, region.bins, readable(frame.rings.width),
                     region.along.empty() ? "" : " along " + region.along);
}

/// "20 snapshots a run", "20 snapshots a run, 9 to 21 of mine": files have their own.
std::string snapshotsInWords(const FlowFrame& frame, const Engines& engines) {
  const auto ofFiles = [](const EngineRuns& engine) {
    return !engine.finished.empty() && engine.finished.front()->ofFiles() &&
           !engine.snapshots().empty();
  };
  Names others;
  for (const EngineRuns& engine : engines)
    if (ofFiles(engine)) others.push_back(fmt::format("{} of {}", engine.snapshots(), engine.name));
  if (engines.size() == 1 && engines.front().snapshots().find(' ') == std::string::npos)
    others.clear();  // what was averaged alone has its number in the study
  const bool files = !others.empty() && std::ranges::all_of(engines, ofFiles);
  if (files) return "snapshots a run: " + listed(others);
  const std::string words = fmt::format(
      "{} snapshots a run", readableCount(static_cast<double>(frame.averaging.snapshots)));
  return others.empty() ? words : fmt::format("{}, {}", words, listed(others));
}

}  // namespace

void addStates(Blocks& blocks, const CompareResults& results, const Engines& engines) {
  if (Table regimes = regimeTable(engines); !regimes.rows.empty()) {
    const std::string when = averagedRotations(results.averaging);
    blocks.push_back(Heading{"Regimes", "regimes"});
    blocks.push_back(Paragraph{
        (when.empty() ? std::string() : "Averaged: " + when + ". ") +
        "Flowing: disks touch for long and layers pass one another. Blocked: the wheel slips over "
        "disks that keep their neighbours; less than a tenth of its rotation goes into shear. "
        "Collisional: the wheel touches less than one disk at a time, or the inertial number I "
        "there exceeds 0.1. Slip and shear are shares of Ω; contacts are the wheel's, at a time."});
    blocks.push_back(std::move(regimes));
    blocks.push_back(regimePairTable(results.regimes));
  }
  if (results.steadiness.empty()) return;
  blocks.push_back(Heading{"Steady or not", "steady-or-not"});
  blocks.push_back(Paragraph{fmt::format(
      "Change of the straight line through each series over the averaged time, in % of its mean; "
      "{:.3g} % intervals: over packings where there are four (shared out over the series), else "
      "of each run with its autocorrelation. No drift seen: down to the largest change that is not "
      "excluded, if that is at most a quarter; else: cannot tell.",
      100.0 * results.averaging.confidence)});
  blocks.push_back(steadinessTable(results.steadiness, engines));
}

std::string averagedRotations(const FlowAveraging& averaging) {
  const auto from = averaging.fromRotation, to = averaging.toRotation;
  if (!from || !to) return {};
  std::string words = fmt::format("rotations {} since the hand-over", range(*from, *to));
  if (const auto before = averaging.preparedRotations)
    words += fmt::format(", {} since the ring had closed", range(*before + *from, *before + *to));
  return words;
}

std::string driftSentence(const CompareResults& results, const Engines& engines) {
  const auto answers = answersByEngine(results.steadiness);
  Names drifts;
  for (const EngineRuns& engine : engines)
    if (const auto found = answers.find(engine.name);
        found != answers.end() && !found->second.drifts.empty())
      drifts.push_back(fmt::format("on {} {}", engine.name, fmt::join(found->second.drifts, ", ")));
  return drifts.empty() ? ""
                        : fmt::format("Not steady: {}, of the mean, over the averaged time.",
                                      fmt::join(drifts, "; "));
}

Names stateSentences(const CompareResults& results, const Engines& engines) {
  Names sentences;
  addRegimes(sentences, engines);
  if (!engines.empty()) addPairs(sentences, results, referenceOf(results));
  if (std::string drift = driftSentence(results, engines); !drift.empty())
    sentences.push_back(std::move(drift));
  addSteadiness(sentences, results, engines);
  return sentences;
}

void addEngineTable(Blocks& blocks, const Engines& engines) {
  Table table = emptyTable(engines);
  addGroup(table, "What ran", whatRan(engines));
  addGroup(table, "Cost", costRows(engines));
  addGroup(table, "State", stateRows(engines));
  table.note =
      "Cost: of the finished runs together, of stepping alone. State: means over the averaged "
      "time, with ± one standard error over packings where there are several, whatever their "
      "regime.";
  blocks.push_back(std::move(table));
  if (Table troubles = troubleTable(engines); !troubles.rows.empty()) {
    blocks.push_back(Heading{"What did not run"});
    blocks.push_back(std::move(troubles));
  }
}

Table stateTable(const Engines& engines) {
  Table table = emptyTable(engines);
  addGroup(table, "State", stateRows(engines));
  table.note = "Means over the snapshots.";
  return table;
}

std::string describeAverages(const FlowFrame& frame, const Engines& engines) {
  const std::string snapshots = snapshotsInWords(frame, engines);
  if (frame.region)
    return fmt::format("{}, weights by {}, {}, {} to {} s after the start.", binsInWords(frame),
                       frame.averaging.method, snapshots, readableSetting(frame.region->from),
                       readableSetting(frame.region->to));
  const std::string when = averagedRotations(frame.averaging);
  return fmt::format("{} rings of width {} m, weights by {}, {}{}.", frame.rings.r.size(),
                     readable(frame.rings.width), frame.averaging.method, snapshots,
                     when.empty() ? std::string() : ", " + when);
}

std::vector<EffectiveScene> effectiveOf(const FlowFrame& frame, const Engines& engines) {
  std::vector<EffectiveScene> effective;
  for (const EngineRuns& engine : engines)
    if (engine.effective()) effective.push_back({engine.name, engine.effective(), &frame.effects});
  return effective;
}

}  // namespace crossgrain::reports
