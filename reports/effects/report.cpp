#include "reports/effects/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/flow/endpoint_text.hpp"

namespace crossgrain::reports {

namespace {

/// Two figures, three and more as they are: never a power of ten.
std::string roughly(double percent) {
  return percent < 99.5 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
}

std::string signedRoughly(double percent) {
  const std::string digits = roughly(std::abs(percent));
  if (digits == "0") return digits;
  return (percent < 0.0 ? "−" : "+") + digits;
}

std::optional<double> inPercent(std::optional<double> fraction) {
  return times(fraction, 100.0);
}

/// "−20 % (−25 to −15 %)": with the interval that the verdict rests on; else with one standard
/// error.
std::string changePercent(const FieldChange& change) {
  const auto value = inPercent(change.change);
  if (change.low && change.high)
    return fmt::format("{} % ({} to {} %)", signedRoughly(*value),
                       signedRoughly(100.0 * *change.low), signedRoughly(100.0 * *change.high));
  if (!change.error) return readableDifference(value, {}) + " %";
  return readableDifference(value, inPercent(change.error)) + " % (one standard error)";
}

std::string describeChange(const FieldChange& change) {
  return fmt::format("{} in {}, {}", fieldWords(change.field), change.bin, changePercent(change));
}

std::vector<const FieldChange*> detectedOf(const VariantSummary& variant) {
  std::vector<const FieldChange*> found;
  for (const FieldChange& change : variant.judged)
    if (change.detected.value_or(false)) found.push_back(&change);
  std::ranges::stable_sort(found, std::ranges::greater(),
                           [](const FieldChange* change) { return std::abs(change->change); });
  return found;
}

/// "0.8 % (volume fraction) to 45 % (spin)"
std::string detectableInWords(const VariantSummary& variant) {
  const FieldChange *least = nullptr, *most = nullptr;
  for (const FieldChange& change : variant.judged) {
    if (!change.detectable) continue;
    if (!least || *change.detectable < *least->detectable) least = &change;
    if (!most || *change.detectable > *most->detectable) most = &change;
  }
  if (!least) return {};
  const auto one = [](const FieldChange& change) {
    return fmt::format("{} % ({})", roughly(100.0 * *change.detectable), fieldWords(change.field));
  };
  return least == most ? one(*least) : one(*least) + " to " + one(*most);
}

/// ", with 45 contacts instead of 424".
std::string contactsInWords(const VariantSummary& variant) {
  constexpr double notable = 0.2;
  if (!variant.contacts || !variant.wholeContacts) return {};
  if (std::abs(*variant.contacts - *variant.wholeContacts) < notable * *variant.wholeContacts)
    return {};
  return fmt::format(" (without it there are {} contacts instead of {})",
                     readableCount(variant.contacts), readableCount(variant.wholeContacts));
}

/// "takes 12.1 ± 0.4 % of a step"
std::string describeCost(const VariantSummary& variant) {
  if (!variant.saved) return "was not timed";
  const std::string part =
      readable(inPercent(std::abs(*variant.saved)), inPercent(variant.timeRatioError));
  if (!variant.changesTime())
    return fmt::format(
        "costs nothing measurable ({} % of a step)",
        readableDifference(inPercent(variant.saved), inPercent(variant.timeRatioError)));
  return (*variant.saved > 0.0
              ? fmt::format("takes {} % of a step", part)
              : fmt::format("saves time: a step without it takes {} % longer", part)) +
         contactsInWords(variant);
}

/// "significant changes without it: azimuthal velocity in ring 3, −34 % (−45 to −23 %)", or the
/// smallest that this run would have resolved; empty where there are too few packings.
std::string describeChanges(const VariantSummary& variant) {
  const auto found = detectedOf(variant);
  if (found.empty())
    return variant.decidable()
               ? "no significant change; smallest resolvable one, field by field: " +
                     detectableInWords(variant)
               : std::string();
  constexpr std::size_t most = 3;
  Names words;
  for (std::size_t k = 0; k < std::min(found.size(), most); ++k)
    words.push_back(describeChange(*found[k]));
  const std::size_t more = found.size() - words.size();
  return fmt::format("significant changes without it: {}{}", fmt::join(words, "; "),
                     more == 0 ? "" : fmt::format("; and {}", counted(more, "further field")));
}

/// Beyond only where that is shown, and where: the field may exceed its margin elsewhere.
std::string againstMargin(const FieldChange& change) {
  if (change.verdict == Verdict::notApplicable) return {};
  if (change.verdict == Verdict::pass) return "shown within the margin";
  if (change.verdictHere == Verdict::fail) return "shown beyond the margin";
  return change.verdict == Verdict::fail ? "shown beyond the margin elsewhere"
                                         : "margin: undecided";
}

const char* symbolOf(const FieldChange& change) {
  if (!change.detected) return "";
  if (!*change.detected) return "○";
  return change.change > 0.0 ? "▲" : "▼";
}

Cell fieldCell(const VariantSummary& variant, const std::string& field) {
  const FieldChange* const change = variant.of(field);
  if (!change) return absentText;
  const bool found = change->detected.value_or(false);
  std::string detail = change->bin;
  if (!change->detected) detail += fmt::format("; {}", variant.untested());
  if (!found && change->detectableHere)
    detail += fmt::format("; seen from {} %", roughly(100.0 * *change->detectableHere));
  if (const std::string margin = againstMargin(*change); !margin.empty()) detail += "; " + margin;
  return {fmt::format("{} {}", symbolOf(*change), changePercent(*change)),
          {std::move(detail)},
          found ? Verdict::modelDifference : Verdict::undecided};
}

/// "+31 N/m² (12 to 50) of 206 N/m²": what is without the effect less what is with it.
Cell endpointChange(const EndpointRow& row) {
  if (row.verdict == Verdict::notMeasured || !finite(row.difference))
    return {absentText, {row.reason}, Verdict::notMeasured};
  const std::string unit = row.unit == "-" || row.unit == "1" ? "" : " " + row.unit;
  std::string text = readableInterval(row.difference, row.low, row.high, unit, Sign::ofAll);
  Names detail = {fmt::format("of {}{}", readable(row.reference), unit)};
  detail.emplace_back(row.verdict == Verdict::pass   ? "shown within the margin"
                      : row.verdict == Verdict::fail ? "shown beyond the margin"
                                                     : "margin: undecided");
  if (!row.reason.empty()) detail.push_back(row.reason);
  return {std::move(text),
          {fmt::format("{}", fmt::join(detail, "; "))},
          row.verdict == Verdict::fail ? Verdict::modelDifference : row.verdict};
}

/// Changes of every endpoint by each effect; empty where the case has none.
Table endpointChanges(const EffectsResults& results, const std::string& engine) {
  Table table{{"switched off"}};
  for (const VariantSummary& variant : variantSummaries(results, engine)) {
    if (!variant.ran() || variant.changes.endpoints.empty()) continue;
    if (table.rows.empty())
      for (const EndpointRow& row : variant.changes.endpoints)
        table.columns.emplace_back(endpointWords(row.endpoint));
    TableRow line{{effectLabel(variant.effect)}};
    for (const EndpointRow& row : variant.changes.endpoints)
      line.cells.push_back(endpointChange(row));
    table.rows.push_back(std::move(line));
  }
  table.note =
      "The value without the effect minus that with everything on, in brackets the interval that "
      "the verdict against the case's margin rests on.";
  return table;
}

/// The largest value of a field with everything on, which changes are shares of.
std::string scaleOf(const EngineRuns& whole, const std::string& field) {
  const Profile* profile = profileOf(whole.profiles(), field);
  double scale = 0.0;
  if (profile)
    for (const auto& mean : profile->mean)
      scale = std::max(scale, std::abs(finite(mean).value_or(0.0)));
  const std::string unit = profile ? profile->unit : std::string();
  return readable(scale) + (unit == "-" || unit == "1" ? "" : " " + unit);
}

/// Effects of one engine: cost, contacts, and the change of each field that is judged.
Table effectTable(const EffectsResults& results, const std::string& engine) {
  const std::vector<VariantSummary> variants = variantSummaries(results, engine);
  const Names fields = judgedFields(variants);
  const EffectVariant* whole = wholeVariant(results, engine);
  const EngineRuns everything = variantRuns(results, engine).front();
  Table table{{"switched off", numbers("saves of a step [%]"), numbers("a step [µs]"),
               numbers("contacts in a step")}};
  TableRow first{{"nothing: largest value", absentText, readable(times(finite(whole->step), 1e6)),
                  readableCount(whole->contacts)}};
  for (const std::string& field : fields) {
    table.columns.emplace_back(fieldLabel(field));
    first.cells.emplace_back(scaleOf(everything, field));
  }
  table.rows.push_back(std::move(first));
  for (const VariantSummary& variant : variants) {
    TableRow row{{effectLabel(variant.effect)}};
    if (!variant.ran()) {
      row.cells.front().notes = {
          fmt::format("{}: {}", nameOf(variant.status, engineStatusNames), variant.reason)};
    } else {
      row.cells.emplace_back(readable(inPercent(variant.saved), inPercent(variant.timeRatioError)));
      row.cells.emplace_back(readable(times(variant.step, 1e6)));
      row.cells.emplace_back(readableCount(variant.contacts));
      for (const std::string& field : fields) row.cells.push_back(fieldCell(variant, field));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string effectSentence(const VariantSummary& variant) {
  const std::string effect = capitalised(effectLabel(variant.effect));
  if (!variant.ran())
    return fmt::format("{}: {}: {}.", effect, nameOf(variant.status, engineStatusNames),
                       variant.reason);
  const std::string changes = describeChanges(variant);
  return fmt::format("{} {}{}{}.", effect, describeCost(variant), changes.empty() ? "" : "; ",
                     changes);
}

Names effectsNotes(const EffectsResults& results) {
  Names notes;
  for (const EngineRow& engine : results.engines)
    if (engine.status == Status::refused)
      notes.push_back(fmt::format("{} refused the scene: {}", engine.name, engine.reason));
  const bool oneStart = results.hasOneStart();
  if (oneStart)
    notes.emplace_back(
        "The scene has one start: endpoints are judged by how far they change, changes of profiles "
        "have no scatter that they could be tested against.");
  else if (results.packings.size() < 4)
    notes.emplace_back(
        "Fewer than 4 packings: changes cannot be distinguished from the scatter between "
        "packings.");
  const std::string runs = oneStart
                               ? fmt::format("One start, run {} times", results.packings.size())
                               : counted(results.packings.size(), "packing");
  notes.push_back(results.region
                      ? fmt::format("{}; averaged in each run: {} to {} s.", runs,
                                    readableSetting(results.region->from),
                                    readableSetting(results.region->to))
                      : fmt::format("{}; rotations averaged in each run: {}, after {} of settling.",
                                    runs, readableSetting(results.averaging.rotations),
                                    readableSetting(results.averaging.settleRotations)));
  std::ranges::copy(results.notes, std::back_inserter(notes));
  return notes;
}

std::string barsOf(const EffectsResults& results) {
  const std::size_t packings = results.packings.size();
  if (results.hasOneStart()) return "of one start, without an error";
  if (packings >= 4)
    return "in brackets the interval that the verdict rests on, paired over packings: it leaves "
           "out 0 exactly where the change is significant";
  return packings > 1 ? "± one standard error of the change, paired over packings"
                      : "± one standard error within the two runs of one packing: it says nothing "
                        "about other packings";
}

List effectsReading(const EffectsResults& results) {
  return {
      {{"Changes", fmt::format("the run without the effect minus the run with everything on, in "
                               "one {}, in % of the profile's largest value with everything on; "
                               "{}. effects.csv has every {}, in the field's unit.",
                               binWord(results), barsOf(results), binWord(results))},
       {"▲ ▼",
        fmt::format(
            "significant (larger, smaller without the effect); ○: not, and \"seen from\" is the "
            "smallest change that this {0} would have shown. All {0}s of all fields shown are one "
            "family of tests for each effect: the chance of any false alarm among them is at most "
            "{1:.3g} % (paired t tests, Holm's procedure). It takes at least 4 packings.",
            binWord(results), 100.0 * (1.0 - results.averaging.confidence))},
       {"Margin",
        fmt::format("the case's: a change within the margin in every {} shows that this scene does "
                    "not need the effect for that field, as two engines would agree.",
                    binWord(results))},
       {"Time",
        fmt::format("one run at a time, in {} rounds that take turns, a packing each, at least {} "
                    "s each over the same steps; the mean of the rounds counts, its error is that "
                    "over rounds. What other programs had of the core meanwhile is not counted. A "
                    "run without an effect is in another state and may have more or fewer "
                    "contacts, which is part of the number: see the column of contacts.",
                    readableCount(results.timing.rounds), readableSetting(results.timing.seconds))},
       {"Sum", "effects do not add up: with friction go rotation, springs and dashpots."}}};
}

std::string profilesWords(const std::vector<VariantSummary>& variants) {
  const auto ran = static_cast<std::size_t>(std::ranges::count_if(variants, &VariantSummary::ran));
  const std::string others =
      fmt::format(" Of {}, those {} that change a profile most; effects.csv has all.",
                  counted(ran, "effect"), mostVariants);
  return "Black: everything on." + (ran > mostVariants ? others : std::string());
}

/// @param number  of the engine, from 1
void addStudy(Report& report, const EffectsResults& results, const std::string& engine,
              std::size_t number) {
  const std::string prefix = fmt::format("effects_{}_", number);
  const std::vector<VariantSummary> variants = variantSummaries(results, engine);
  Blocks& blocks = report
                       .section(fmt::format("effects-{}", number),
                                "What each effect costs and changes: " + engine, engine)
                       .blocks;
  List sentences;
  for (const VariantSummary& variant : variants)
    sentences.items.push_back({"", effectSentence(variant)});
  blocks.push_back(std::move(sentences));
  Drawings cost = drawingsOf(report.figures, prefix + "cost");
  cost.side = false;
  blocks.push_back(std::move(cost));
  blocks.push_back(Details{"Time, contacts and change of each profile, effect by effect",
                           {effectTable(results, engine)}});
  if (Table endpoints = endpointChanges(results, engine); !endpoints.rows.empty())
    blocks.push_back(Details{"What each effect changes in the endpoints", {std::move(endpoints)}});
  Drawings profiles = drawingsOf(report.figures, prefix + "profile_");
  if (profiles.names.empty()) return;
  const bool faint = std::ranges::any_of(variants, [](const VariantSummary& variant) {
    return variant.ran() && std::ranges::any_of(variant.judged, [](const FieldChange& change) {
             return change.detected == std::optional(false);
           });
  });
  blocks.push_back(Details{
      "Profiles with and without each effect",
      {Paragraph{profilesWords(variants) +
                 (faint ? " Grey: runs whose change of this field is not significant." : "")},
       std::move(profiles)}});
}

std::string yesOrNo(const std::optional<bool>& value) {
  return value ? (*value ? "yes" : "no") : "";
}

std::string effectsCsv(const EffectsResults& results) {
  std::string table =
      "engine,effect,time_ratio,field,ring,change,stderr,r_tilde,reference,unit,resolved,p_"
      "adjusted,smallest_resolvable,family_level,packings,stderr_kind,time_ratio_stderr,step_s,"
      "contacts_per_step,precision,status,reason\n";
  const double level = std::round((1.0 - results.averaging.confidence) * 1e12) / 1e12;
  for (const EffectVariant& variant : results.variants) {
    if (!variant.isSwitched()) continue;  // everything on: the reference of the others
    const bool refused = variant.status == Status::refused;
    const auto packings =
        refused ? std::nullopt : std::optional(static_cast<double>(variant.changes.packings));
    const std::string bars(refused ? "" : nameOf(variant.changes.bars));
    const auto line = [&](const ChangedField& field, const std::string& place,
                          const RingChange& ring) {
      const auto rTilde = place.empty() ? std::nullopt : at(results.rings.rTilde, ring.ring);
      table += row(
          variant.engine, variant.effect, variant.timeRatio, field.field, place, ring.change,
          ring.standardError, rTilde, ring.reference, field.unit, yesOrNo(ring.resolved), ring.p,
          ring.smallest, finite(ring.p) ? std::optional(level) : std::nullopt, packings, bars,
          variant.timeRatioError, variant.step, variant.contacts, variant.precision.value_or(""),
          std::string(nameOf(variant.status, engineStatusNames)), variant.reason);
    };
    for (const ChangedField& field : variant.changes.fields)
      for (const RingChange& ring : field.rings)
        line(field, fmt::format("{}", ring.ring + 1), ring);
    if (variant.changes.fields.empty()) line({}, "", {});
  }
  return table;
}

}  // namespace

Report reportOf(const EffectsResults& results) {
  const Engines engines = engineRuns(results, results.ensemble);
  Report report{{results.head, results.engines, effectsOverview(results)}, results.elapsed};
  report.notes = effectsNotes(results);
  report.engineColours = false;  // colours are variants
  report.figures = effectFigures(results);
  for (std::size_t k = 0; k < engines.size(); ++k)
    if (wholeVariant(results, engines[k].name)) addStudy(report, results, engines[k].name, k + 1);
  Table switches{{"switch", remarks("meaning")}};
  for (const SwitchRow& one : results.switches)
    switches.rows.push_back({{variantLabel(one.effect), one.what}});
  report.section("reading", "How to read it").blocks = {
      effectsReading(results),
      Paragraph{describeAverages(results, engines), Paragraph::Style::small},
      Heading{"What was switched"}, std::move(switches)};
  addEngineTable(report.section("engines", "Engines, with everything on", "Engines").blocks,
                 engines);
  addDetails(report, effectiveOf(results, engines));
  addPackings(report, results.packings);
  for (Section& section : report.sections) section.folded = !section.id.starts_with("effects-");
  report.tables = {{"effects.csv", effectsCsv(results)}};
  return report;
}

}  // namespace crossgrain::reports
