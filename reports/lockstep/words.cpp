#include "reports/lockstep/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {
namespace {

/// "kn" → "k_n", as everywhere in reports.
std::string symbolOf(const std::string& constant) {
  const std::pair<const char*, const char*> symbols[] = {
      {"kn", "k_n"}, {"kn3", "k_n3"}, {"gn", "γ_n"}, {"kt", "k_t"},
      {"gt", "γ_t"}, {"mu", "µ"},     {"en", "e_n"}, {"et0", "e_t0"}};
  const auto* const found = std::ranges::find(
      symbols, constant, [](const auto& pair) { return std::string(pair.first); });
  return found == std::end(symbols) ? constant : found->second;
}

std::string percent(double fraction) {
  return fmt::format("{} %", readable(100.0 * fraction));
}

std::string milliseconds(double time) {
  return fmt::format("{} ms", readable(1e3 * time));
}

}  // namespace

std::string verdictInWords(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != LockstepVerdict::differs) return spaced(nameOf(row.verdict));
  return fmt::format("differs, like {} of {}", percent(row.equivalent.value_or(NAN)),
                     symbolOf(rules.yardstick));
}

std::string termInWords(const LockstepRow& row) {
  if (!row.term) return {};
  const NamedTerm& term = *row.term;
  const std::string amount = term.amount ? fmt::format(" {}{}", *term.amount < 0.0 ? "−" : "+",
                                                       percent(std::abs(*term.amount)))
                                         : std::string();
  return fmt::format("{}{} (leaves {} of the separation)", symbolOf(term.name), amount,
                     percent(term.unexplained));
}

std::string firstInWords(const LockstepRow& row) {
  if (!row.first) return {};
  const FirstExceedance& first = *row.first;
  std::string words = fmt::format("between {} and {} after start {}: disk {}",
                                  first.after > 0.0 ? milliseconds(first.after) : "0",
                                  milliseconds(first.until), first.start + 1, first.disk);
  if (first.partner) words += fmt::format(" with {}", *first.partner);
  if (!first.contact.empty()) words += fmt::format(" ({})", first.contact);
  return words;
}

std::string sentenceOf(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict == LockstepVerdict::notMeasured)
    return fmt::format("{}: not measured: {}.", row.engine, row.reason);
  std::string words =
      fmt::format("{}: {} over {} starts", row.engine, verdictInWords(row, rules), row.starts);
  if (!row.separations.empty())
    words += fmt::format(
        "; largest separation {} d after {}, {} d after {}", readable(row.separations[1].largest),
        milliseconds(row.separations[1].time), readable(row.separations.back().largest),
        milliseconds(row.separations.back().time));
  if (row.verdict == LockstepVerdict::sameLaw)
    words += fmt::format(" (as {} of {} would)", percent(row.equivalent.value_or(NAN)),
                         symbolOf(rules.yardstick));
  if (const std::string term = termInWords(row); !term.empty())
    words += fmt::format("; what is off: {}", term);
  else if (row.verdict == LockstepVerdict::differs)
    words += "; no single term accounts for it";
  if (row.verdict == LockstepVerdict::differs && row.first)
    words += fmt::format("; first seen {}", firstInWords(row));
  if (!row.failure.empty()) words += fmt::format("; then it failed: {}", row.failure);
  return words + '.';
}

}  // namespace crossgrain::reports
