#include "reports/lockstep/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {
namespace {

/// "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string percent(double fraction) {
  return fmt::format("{} %", readable(100.0 * fraction));
}

std::string milliseconds(double time) {
  return fmt::format("{} ms", readable(1e3 * time));
}

}  // namespace

std::string constantSymbol(const std::string& constant) {
  const std::pair<const char*, const char*> symbols[] = {
      {"kn", "k_n"}, {"kn3", "k_n3"}, {"gn", "γ_n"}, {"kt", "k_t"},
      {"gt", "γ_t"}, {"mu", "µ"},     {"en", "e_n"}, {"et0", "e_t0"}};
  const auto* const found = std::ranges::find(
      symbols, constant, [](const auto& pair) { return std::string(pair.first); });
  return found == std::end(symbols) ? constant : found->second;
}

std::string verdictInWords(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != LockstepVerdict::differs) return spaced(nameOf(row.verdict));
  return fmt::format("differs, like {} of {}", percent(row.equivalent.value_or(NAN)),
                     constantSymbol(rules.yardstick));
}

std::string termInWords(const LockstepRow& row) {
  if (!row.term) return {};
  const NamedTerm& term = *row.term;
  const std::string amount = term.amount ? fmt::format(" {}{}", *term.amount < 0.0 ? "−" : "+",
                                                       percent(std::abs(*term.amount)))
                                         : std::string();
  return fmt::format("{}{} (leaves {} of the separation)", constantSymbol(term.name), amount,
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
  if (row.separations.size() > 1)
    words += fmt::format(
        "; largest separation {} d after {}, {} d after {}", readable(row.separations[1].largest),
        milliseconds(row.separations[1].time), readable(row.separations.back().largest),
        milliseconds(row.separations.back().time));
  if (row.verdict == LockstepVerdict::sameLaw)
    words += fmt::format(" (as {} of {} would)", percent(row.equivalent.value_or(NAN)),
                         constantSymbol(rules.yardstick));
  if (const std::string term = termInWords(row); !term.empty())
    words += fmt::format("; what is off: {}", term);
  else if (row.verdict == LockstepVerdict::differs)
    words += "; no single term accounts for it";
  if (row.verdict == LockstepVerdict::differs && row.first)
    words += fmt::format("; first seen {}", firstInWords(row));
  if (!row.failure.empty()) words += fmt::format("; then it failed: {}", row.failure);
  return words + '.';
}

std::string leadOf(const LockstepFindings& findings) {
  std::vector<std::string> same, differ, open;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == LockstepVerdict::notMeasured)
      open.push_back(row.engine);
    else
      (row.verdict == LockstepVerdict::differs ? differ : same).push_back(row.engine);
  }
  if (same.empty() && differ.empty()) return "Nothing was measured.";
  std::vector<std::string> parts;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (!names.empty())
      parts.push_back(fmt::format("{} {}", listed(names), names.size() == 1 ? one : many));
  };
  add(same, "is the law that it declares", "are the laws that they declare");
  add(differ, "is another law than it declares", "are other laws than they declare");
  add(open, "was not measured", "were not measured");
  return fmt::format("{}.", fmt::join(parts, "; "));
}

}  // namespace crossgrain::reports
