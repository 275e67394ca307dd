#include "reports/effects/views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

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
  return fraction ? std::optional(100.0 * *fraction) : std::nullopt;
}

/// "−20 % (−25 to −15 %)": with the interval that the verdict rests on; else with one standard
/// error, which is called so.
std::string changePercent(const FieldChange& change) {
  const auto value = inPercent(change.change);
  if (change.low && change.high)
    return fmt::format("{} % ({} to {} %)", signedRoughly(*value),
                       signedRoughly(100.0 * *change.low), signedRoughly(100.0 * *change.high));
  if (!change.error) return readableDifference(value, {}) + " %";
  return readableDifference(value, inPercent(change.error)) + " % (one standard error)";
}

bool measured(const VariantSummary& variant) {
  return !variant.savedError || std::abs(*variant.saved) > 2.0 * *variant.savedError;
}

std::string ringName(const FieldChange& change) {
  return fmt::format("ring {}", change.ring + 1);
}

std::string changeInWords(const FieldChange& change) {
  return fmt::format("{} in {}, {}", fieldWords(change.field), ringName(change),
                     changePercent(change));
}

std::vector<const FieldChange*> detectedOf(const VariantSummary& variant) {
  std::vector<const FieldChange*> found;
  for (const FieldChange& change : variant.changes)
    if (change.detected.value_or(false)) found.push_back(&change);
  std::ranges::stable_sort(found, std::ranges::greater(),
                           [](const FieldChange* change) { return std::abs(change->change); });
  return found;
}

/// "0.8 % (volume fraction) to 45 % (spin)"
std::string detectableInWords(const VariantSummary& variant) {
  const FieldChange *least = nullptr, *most = nullptr;
  for (const FieldChange& change : variant.changes) {
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

}  // namespace

namespace {

/// ", with 45 contacts instead of 424": where that is part of what a step takes.
std::string contactsInWords(const VariantSummary& variant) {
  constexpr double notable = 0.2;
  if (!variant.contacts || !variant.wholeContacts) return {};
  if (std::abs(*variant.contacts - *variant.wholeContacts) < notable * *variant.wholeContacts)
    return {};
  return fmt::format(" (without it there are {} contacts instead of {})",
                     readableCount(variant.contacts), readableCount(variant.wholeContacts));
}

}  // namespace

bool costsTime(const VariantSummary& variant) {
  return variant.saved && *variant.saved > 0.0 && measured(variant);
}

std::string costInWords(const VariantSummary& variant) {
  if (!variant.saved) return "was not timed";
  const std::string part =
      readable(inPercent(std::abs(*variant.saved)), inPercent(variant.savedError));
  if (!measured(variant))
    return fmt::format("costs nothing measurable ({} % of a step)",
                       readableDifference(inPercent(variant.saved), inPercent(variant.savedError)));
  return (*variant.saved > 0.0
              ? fmt::format("takes {} % of a step", part)
              : fmt::format("saves time: a step without it takes {} % longer", part)) +
         contactsInWords(variant);
}

std::string changesInWords(const VariantSummary& variant) {
  const auto found = detectedOf(variant);
  if (found.empty())
    return variant.decidable() ? "no change told apart from none; the smallest that this run could "
                                 "have, field by field: " +
                                     detectableInWords(variant)
                               : std::string();
  constexpr std::size_t told = 3;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(found.size(), told); ++k)
    words.push_back(changeInWords(*found[k]));
  const std::size_t more = found.size() - words.size();
  return fmt::format("told apart from no change without it: {}{}", fmt::join(words, "; "),
                     more == 0 ? "" : fmt::format("; and {}", counted(more, "further field")));
}

namespace {

/// Beyond only where that is shown, and where: the field may exceed its margin in another ring.
std::string againstMargin(const FieldChange& change) {
  if (change.verdict == AgainstMargin::untold) return {};
  if (change.verdict == AgainstMargin::agree) return "shown within the margin";
  if (change.verdictHere == AgainstMargin::disagree) return "shown beyond the margin";
  return change.verdict == AgainstMargin::disagree ? "shown beyond the margin in another ring"
                                                   : "margin: undecided";
}

const char* symbolOf(const FieldChange& change) {
  if (!change.detected) return "";
  if (!*change.detected) return "○";
  return change.change > 0.0 ? "▲" : "▼";
}

Json fieldCell(const FieldChange* change) {
  if (!change) return {{"symbol", ""}, {"text", absentText}, {"detail", ""}, {"class", ""}};
  const bool found = change->detected.value_or(false);
  std::string detail = ringName(*change);
  if (!change->detected) detail += "; too few packings to tell";
  if (!found && change->detectableHere)
    detail += fmt::format("; seen from {} %", roughly(100.0 * *change->detectableHere));
  if (const std::string margin = againstMargin(*change); !margin.empty()) detail += "; " + margin;
  return {{"symbol", symbolOf(*change)},
          {"text", changePercent(*change)},
          {"detail", detail},
          {"class", found ? "disagree" : "undecided"}};
}

Json tableRow(const VariantSummary& variant, const std::vector<std::string>& fields) {
  Json row = {{"label", effectLabel(variant.effect)},
              {"refused", ""},
              {"saved", readable(inPercent(variant.saved), inPercent(variant.savedError))},
              {"step", readable(variant.step ? std::optional(*variant.step * 1e6) : std::nullopt)},
              {"contacts", readableCount(variant.contacts)},
              {"cells", Json::array()}};
  if (!variant.ran())
    row["refused"] = fmt::format("{}: {}", nameOf(variant.status), variant.reason);
  for (const std::string& field : fields) row["cells"].push_back(fieldCell(variant.of(field)));
  return row;
}

/// The largest value of each field with everything on: what shares are of.
Json scales(const EffectsResults& results, const std::string& engine,
            const std::vector<std::string>& fields) {
  const auto all = variantRuns(results, engine);
  Json cells = Json::array();
  for (const std::string& field : fields) {
    const Profile* profile = profileOf(all.front().profiles(), field);
    double scale = 0.0;
    if (profile)
      for (const auto& mean : profile->mean)
        scale = std::max(scale, std::abs(finite(mean).value_or(0.0)));
    const std::string unit = profile ? profile->unit : std::string();
    cells.push_back(readable(scale) + (unit == "-" || unit == "1" ? "" : " " + unit));
  }
  return cells;
}

}  // namespace

Json effectTable(const EffectsResults& results, const std::string& engine) {
  std::vector<VariantSummary> variants = variantSummaries(results);
  std::erase_if(variants, [&](const VariantSummary& variant) { return variant.engine != engine; });
  const std::vector<std::string> fields = judgedFields(variants);
  const EffectVariant* whole = wholeVariant(results, engine);
  const auto step = whole ? finite(whole->step) : std::nullopt;
  Json table = {{"fields", Json::array()},
                {"span", fields.size() + 3},
                {"wholeStep", readable(step ? std::optional(*step * 1e6) : std::nullopt)},
                {"wholeContacts", whole ? readableCount(whole->contacts) : std::string(absentText)},
                {"scales", scales(results, engine, fields)},
                {"rows", Json::array()}};
  for (const std::string& field : fields) table["fields"].push_back(fieldLabel(field));
  for (const VariantSummary& variant : variants) table["rows"].push_back(tableRow(variant, fields));
  return table;
}

}  // namespace crossgrain::reports
