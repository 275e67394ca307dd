#include "reports/diff/words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/couette/endpoint_words.hpp"
#include "reports/lockstep/words.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {
namespace {

/// Quantities of collisions told one by one; the JSON has all of them.
constexpr std::size_t mostQuantities = 6;

std::string orNothing(const std::string& text) {
  return text.empty() ? "nothing" : text;
}

std::string namedVersion(const std::string& engine, const std::string& version) {
  return version.empty() ? engine : fmt::format("{} ({})", engine, version);
}

std::string windowsInWords(const DiffRow& row, const LockstepRules& rules) {
  const LockstepRow& windows = *row.windows;
  std::string text = fmt::format(
      "  from {} starts, largest distance of a disk from where it was "
      "then:\n",
      windows.starts);
  for (const LockstepSeparation& at : windows.separations) {
    text += fmt::format("    after {:>7} {:>12} d", fmt::format("{} ms", readable(1e3 * at.time)),
                        readable(at.largest));
    if (at.equivalent && at.largest > 0.0)
      text += fmt::format(", {} times what the limit, {} of {}, moves it",
                          readable(*at.equivalent / rules.sameLaw), percentInWords(rules.sameLaw),
                          constantSymbol(rules.yardstick));
    text += '\n';
  }
  if (const std::string reading = readingInWords(windows, rules); !reading.empty())
    text += fmt::format("  {}\n", reading);
  if (const std::string first = firstInWords(windows); !first.empty())
    text += fmt::format("  first beyond {} d: {}\n", readableSetting(rules.rounding), first);
  if (const std::string term = termInWords(windows); !term.empty())
    text += fmt::format("  deviation found: {}\n", term);
  else if (windows.verdict == LockstepVerdict::differs)
    text += row.mirrored ? "  deviation found: none: no single change of the mirror does that\n"
                         : "  deviation found: none: no mirror stands for it in this scene\n";
  return text;
}

std::string collisionsInWords(const DiffRow& row) {
  std::string text = fmt::format("  collisions, {} sweep{}: {}\n", row.sweeps,
                                 row.sweeps == 1 ? "" : "s", spaced(nameOf(row.collisionsVerdict)));
  for (std::size_t k = 0; k < std::min(row.collisions.size(), mostQuantities); ++k) {
    const CollisionChange& change = row.collisions[k];
    text += fmt::format(
        "    {:<24} {} of {} changed, most by {} ({} of the largest) at psi_i {}, "
        "v_n {} m/s{}\n",
        change.quantity, change.changed, change.points, readable(change.largest),
        percentInWords(change.relative), readable(change.psi), readable(change.vn),
        change.variant.empty() ? "" : ", " + change.variant);
  }
  if (row.collisions.size() > mostQuantities)
    text += fmt::format("    … and {} more changed\n", row.collisions.size() - mostQuantities);
  return text;
}

std::string endpointsInWords(const DiffRow& row) {
  std::string text = fmt::format("  averages from {} starts:\n", row.windows->starts);
  for (const EndpointRow& endpoint : row.endpoints)
    text += fmt::format("    {:<24} {}\n", endpoint.endpoint, answerInWords(endpoint));
  return text;
}

std::string rowInWords(const DiffRow& row, const LockstepRules& rules) {
  std::string text =
      fmt::format("{} against {}: {}\n", namedVersion(row.engine, row.version),
                  namedVersion(row.before, row.versionBefore), verdictInWords(row, rules));
  if (!row.reason.empty()) text += fmt::format("  {}\n", row.reason);
  for (const DeclaredChange& change : row.declared)
    text += fmt::format("  declares otherwise: {}: {} → {}\n", change.name,
                        orNothing(change.before), orNothing(change.now));
  if (row.windows && row.windowsVerdict != DiffVerdict::sameBits)
    text += windowsInWords(row, rules);
  if (row.forcesVerdict == DiffVerdict::differs)
    text += fmt::format(
        "  reported forces of the same states: of contacts by {} of the largest along the normal, "
        "{} "
        "across; on walls by {}\n",
        percentInWords(row.forces->normal), percentInWords(row.forces->tangential),
        percentInWords(row.forces->walls));
  if (row.sweeps > 0 && row.collisionsVerdict != DiffVerdict::sameBits)
    text += collisionsInWords(row);
  if (!row.endpoints.empty()) text += endpointsInWords(row);
  return text;
}

}  // namespace

std::string verdictInWords(const DiffRow& row, const LockstepRules& rules) {
  if (row.verdict != DiffVerdict::differs) return spaced(nameOf(row.verdict));
  if (row.windowsVerdict == DiffVerdict::differs) return verdictInWords(*row.windows, rules);
  if (row.forcesVerdict == DiffVerdict::differs) return "differs in reported forces";
  if (row.collisionsVerdict == DiffVerdict::differs)
    return row.windows ? "differs in collisions" : "differs";
  return "differs in averages";
}

std::string diffInWords(const DiffResults& results) {
  std::string text =
      fmt::format("{}: {}, {} starts, kept by crossgrain {}\n", results.baseline,
                  results.head.setup.name, results.starts.size(), results.baselineVersion);
  for (const std::string& key : results.changedKeys)
    text += fmt::format("asked otherwise: {}\n", key);
  for (const DiffRow& row : results.rows) text += rowInWords(row, results.rules);
  return text;
}

}  // namespace crossgrain::reports
