#include "reports/lockstep/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {
namespace {

std::string milliseconds(double time) {
  return fmt::format("{} ms", readable(1e3 * time));
}

}  // namespace

std::string percentInWords(double fraction) {
  return fmt::format("{} %", readable(100.0 * fraction));
}

std::string constantSymbol(const std::string& constant) {
  const std::pair<const char*, const char*> symbols[] = {
      {"kn", "k_n"}, {"kn3", "k_n3"}, {"gn", "γ_n"}, {"kt", "k_t"},
      {"gt", "γ_t"}, {"mu", "µ"},     {"en", "e_n"}, {"et0", "e_t0"}};
  const auto* const found = std::ranges::find(
      symbols, constant, [](const auto& pair) { return std::string(pair.first); });
  return found == std::end(symbols) ? constant : found->second;
}

std::string plainSymbol(const std::string& constant) {
  std::string symbol = constantSymbol(constant);
  for (const auto& [mark, below] : {std::pair("_n", "ₙ"), std::pair("_t", "ₜ")})
    if (const std::size_t at = symbol.find(mark); at != std::string::npos)
      symbol.replace(at, 2, below);
  return symbol;
}

std::string constantWords(const std::string& constant) {
  const std::pair<const char*, const char*> words[] = {
      {"kn", "the normal stiffness"},   {"kn3", "the cubic normal stiffness"},
      {"gn", "the normal damping"},     {"kt", "the tangential stiffness"},
      {"gt", "the tangential damping"}, {"mu", "the coefficient of friction"},
      {"en", "the normal restitution"}, {"et0", "the tangential restitution"}};
  const auto* const found =
      std::ranges::find(words, constant, [](const auto& pair) { return std::string(pair.first); });
  return found == std::end(words) ? constant : found->second;
}

std::string verdictInWords(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != LockstepVerdict::differs) return spaced(nameOf(row.verdict));
  if (row.term && row.term->name == rules.yardstick && row.term->amount)
    return fmt::format("differs, like {} of {}", percentInWords(std::abs(*row.term->amount)),
                       constantSymbol(rules.yardstick));
  if (row.equivalent.value_or(0.0) > rules.sameLaw)
    return fmt::format("differs, {} times the limit", readable(*row.equivalent / rules.sameLaw));
  return fmt::format("differs from {} of {} starts", row.beyond, row.read);
}

std::string readingInWords(const LockstepRow& row, const LockstepRules& rules) {
  if (row.read == 0) return {};
  std::string words;
  if (row.equivalent)
    words = fmt::format("ε_eq {}{}, limit {}; ", readable(*row.equivalent),
                        row.equivalentLow < row.equivalentHigh
                            ? fmt::format(" ({} to {})", readable(*row.equivalentLow),
                                          readable(*row.equivalentHigh))
                            : "",
                        readableSetting(rules.sameLaw));
  words += fmt::format("read from {} starts, beyond the limit from {}", row.read, row.beyond);
  if (row.shareHigh && *row.shareHigh < 1.0)
    words += fmt::format(" (at most {} of all states)", percentInWords(*row.shareHigh));
  return words;
}

std::string termInWords(const LockstepRow& row) {
  if (!row.term) return {};
  const NamedTerm& term = *row.term;
  const std::string amount = term.amount ? fmt::format(" {}{}", *term.amount < 0.0 ? "−" : "+",
                                                       percentInWords(std::abs(*term.amount)))
                                         : std::string();
  return fmt::format("{}{} (leaves {} of the separation)", constantSymbol(term.name), amount,
                     percentInWords(term.unexplained));
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

std::string openInLaw(const LockstepRow& row, const LockstepRules& rules) {
  if (rules.yardstick != "en" || row.term || !row.severalAtOnce) return {};
  return "where they part a disk touches several at once, and in which order these collide the law "
         "of rigid disks leaves open";
}

std::string resolutionInWords(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != LockstepVerdict::sameToPrecision) return {};
  return row.resolution && *row.resolution < 1.0
             ? fmt::format("{} of {} would show", percentInWords(*row.resolution),
                           constantSymbol(rules.yardstick))
             : fmt::format("no change of {} would show", constantSymbol(rules.yardstick));
}

std::string sentenceOf(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict == LockstepVerdict::notMeasured)
    return fmt::format("{}: not measured: {}.", row.engine, row.reason);
  std::string words =
      fmt::format("{}: {} over {} starts", row.engine, verdictInWords(row, rules), row.starts);
  if (row.verdict == LockstepVerdict::undecided) words += ": " + row.reason;
  if (row.separations.size() > 1)
    words += fmt::format(
        "; largest separation {} d after {}, {} d after {}", readable(row.separations[0].largest),
        milliseconds(row.separations[0].time), readable(row.separations.back().largest),
        milliseconds(row.separations.back().time));
  if (const std::string reading = readingInWords(row, rules);
      !reading.empty() && row.verdict != LockstepVerdict::sameToRounding &&
      row.verdict != LockstepVerdict::sameToPrecision)
    words += "; " + reading;
  if (const std::string resolution = resolutionInWords(row, rules); !resolution.empty())
    words += fmt::format(" ({})", resolution);
  if (const std::string term = termInWords(row); !term.empty())
    words += fmt::format("; deviation found: {}", term);
  else if (row.verdict == LockstepVerdict::differs)
    words += "; no single term accounts for it";
  if (row.verdict != LockstepVerdict::sameToPrecision && row.precise > 0)
    words += fmt::format("; {} starts of them stay the same to its precision", row.precise);
  if (row.verdict == LockstepVerdict::differs && row.first)
    words += fmt::format("; first seen {}", firstInWords(row));
  if (const std::string open = openInLaw(row, rules);
      row.verdict == LockstepVerdict::differs && !open.empty())
    words += fmt::format("; {}", open);
  if (!row.failure.empty()) words += fmt::format("; then it failed: {}", row.failure);
  return words + '.';
}

std::string leadOf(const LockstepFindings& findings) {
  std::vector<std::string> same, differ, ordered, open, undecided;
  for (const LockstepRow& row : findings.rows) {
    if (row.verdict == LockstepVerdict::notMeasured)
      open.push_back(row.engine);
    else if (row.verdict == LockstepVerdict::undecided)
      undecided.push_back(row.engine);
    else if (row.verdict == LockstepVerdict::differs && !openInLaw(row, findings.rules).empty())
      ordered.push_back(row.engine);
    else
      (row.verdict == LockstepVerdict::differs ? differ : same).push_back(row.engine);
  }
  if (same.empty() && differ.empty() && ordered.empty() && undecided.empty())
    return "Nothing was measured.";
  std::vector<std::string> parts;
  const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
    if (!names.empty())
      parts.push_back(fmt::format("{} {}", listed(names), names.size() == 1 ? one : many));
  };
  add(same, "is the law that it declares", "are the laws that they declare");
  add(differ, "is another law than it declares", "are other laws than they declare");
  add(ordered, "parts from its mirror where disks touch several at once",
      "part from their mirrors where disks touch several at once");
  add(undecided, "is undecided", "are undecided");
  add(open, "was not measured", "were not measured");
  return fmt::format("{}.", fmt::join(parts, "; "));
}

}  // namespace crossgrain::reports
