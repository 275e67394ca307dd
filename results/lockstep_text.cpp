#include "results/lockstep_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "support/numbers.hpp"

namespace crossgrain::inline results {
namespace {

std::string milliseconds(double time) {
  return fmt::format("{} ms", readable(1e3 * time));
}

struct Constant {
  std::string name, symbol, words;
};

/// A term that is no constant, as "tension = cut", stands for itself.
Constant lookUp(const std::string& name) {
  static const Constant constants[] = {{"kn", "k_n", "the normal stiffness"},
                                       {"kn3", "k_n3", "the cubic normal stiffness"},
                                       {"gn", "γ_n", "the normal damping"},
                                       {"kt", "k_t", "the tangential stiffness"},
                                       {"gt", "γ_t", "the tangential damping"},
                                       {"mu", "µ", "the coefficient of friction"},
                                       {"en", "e_n", "the normal restitution"},
                                       {"et0", "e_t0", "the tangential restitution"},
                                       {"kr", "k_r", "the rolling stiffness"},
                                       {"gr", "γ_r", "the rolling damping"},
                                       {"mu_r", "µ_r", "the coefficient of rolling resistance"},
                                       {"kc", "k_c", "the constant of cohesion"},
                                       {"w", "w", "the work of adhesion"},
                                       {"k_unload", "k₂", "the stiffness of unloading"},
                                       {"plastic_depth", "φ", "the plastic depth"}};
  const auto* const found = std::ranges::find(constants, name, &Constant::name);
  return found == std::end(constants) ? Constant{name, name, name} : *found;
}

}  // namespace

std::string percentText(double fraction) {
  return fmt::format("{} %", readable(100.0 * fraction));
}

std::string constantSymbol(const std::string& constant) {
  return lookUp(constant).symbol;
}

std::string plainSymbol(const std::string& constant) {
  std::string symbol = constantSymbol(constant);
  for (const auto& [mark, below] :
       {std::pair("_n", "ₙ"), std::pair("_t", "ₜ"), std::pair("_r", "ᵣ")})
    if (const std::size_t at = symbol.find(mark); at != std::string::npos)
      symbol.replace(at, 2, below);
  return symbol;
}

std::string constantWords(const std::string& constant) {
  return lookUp(constant).words;
}

std::string verdictWord(Equivalence verdict) {
  constexpr std::array words = {"not measured",
                                "same bits",
                                "identical to rounding",
                                "identical to its precision",
                                "equivalent",
                                "undecided",
                                "differs"};
  return words.at(static_cast<std::size_t>(verdict));
}

std::string describeVerdict(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != Equivalence::differs) return verdictWord(row.verdict);
  if (row.term && row.term->name == rules.referencePerturbation && row.term->amount)
    return fmt::format("differs (equivalent to {} of {})", percentText(std::abs(*row.term->amount)),
                       constantSymbol(rules.referencePerturbation));
  if (row.equivalent.value_or(0.0) > rules.sameLaw)
    return fmt::format("differs ({} times the limit)", readable(*row.equivalent / rules.sameLaw));
  return fmt::format("differs from {} of {} starts", row.beyond, row.read);
}

std::string describeReading(const LockstepRow& row, const LockstepRules& rules) {
  if (row.read == 0) return {};
  std::string words;
  if (row.equivalent)
    words = fmt::format("ε_eq {}, limit {}; ",
                        readableInterval(row.equivalent, row.equivalentLow, row.equivalentHigh),
                        readableSetting(rules.sameLaw));
  words += fmt::format("read from {} starts, beyond the limit from {}", row.read, row.beyond);
  if (row.shareHigh && *row.shareHigh < 1.0)
    words += fmt::format(" (at most {} of all states)", percentText(*row.shareHigh));
  return words;
}

std::string describeTerm(const LockstepRow& row) {
  if (!row.term) return {};
  const NamedTerm& term = *row.term;
  const std::string amount = term.amount ? fmt::format(" {}{}", *term.amount < 0.0 ? "−" : "+",
                                                       percentText(std::abs(*term.amount)))
                                         : std::string();
  return fmt::format("{}{} (leaves {} of the difference)", constantSymbol(term.name), amount,
                     percentText(term.unexplained));
}

std::string describeFirst(const LockstepRow& row) {
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
  if (rules.referencePerturbation != "en" || row.term || !row.severalAtOnce) return {};
  return "where they part a disk touches several at once, and the law of rigid disks leaves the "
         "order of these collisions open";
}

std::string describeResolution(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict != Equivalence::sameToPrecision) return {};
  return row.resolution && *row.resolution < 1.0
             ? fmt::format("{} of {} would show", percentText(*row.resolution),
                           constantSymbol(rules.referencePerturbation))
             : fmt::format("no change of {} would show",
                           constantSymbol(rules.referencePerturbation));
}

std::string describeCauses(const LockstepRow& row) {
  if (!row.causes || row.causes->parts.empty()) return {};
  const LockstepCauses& causes = *row.causes;
  constexpr std::size_t mostNamed = 4;
  constexpr double leastInteraction = 0.1;  // of the divergence
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < causes.parts.size(); ++k)
    if (causes.firstStep[k]) order.push_back(k);
  if (order.empty()) return fmt::format("none acts within {}", milliseconds(causes.time.back()));
  std::ranges::sort(order, {}, [&](std::size_t k) {  // of those in one step the largest part
    return std::pair(*causes.firstStep[k], -std::abs(causes.parts[k].back().value_or(0.0)));
  });
  std::string words;
  for (const std::size_t k : order | std::views::take(mostNamed)) {
    const CauseName& one = causes.differences[k];
    const auto part = causes.parts[k].back();
    const std::string share = part ? percentText(*part) : "rounding";
    words += fmt::format(
        "{}{}{} in step {}, {}{}", words.empty() ? "" : "; ", one.name,
        one.declared ? "" : " (not declared)", *causes.firstStep[k], share,
        words.empty() ? fmt::format(" of the divergence after {}", milliseconds(causes.time.back()))
                      : "");
  }
  // Parts of what hardly parts may be many times the whole, and this takes them back.
  if (const auto rest = causes.interaction.back(); rest && std::abs(*rest) >= leastInteraction)
    words += fmt::format("; {} where they act together", percentText(*rest));
  return "in the order in which they act: " + words;
}

std::string describe(const LockstepRow& row, const LockstepRules& rules) {
  if (row.verdict == Equivalence::notMeasured)
    return fmt::format("{}: not measured: {}.", row.engine, row.reason);
  std::string words =
      fmt::format("{}: {} over {} starts", row.engine, describeVerdict(row, rules), row.starts);
  if (row.verdict == Equivalence::undecided) words += ": " + row.reason;
  if (row.separations.size() > 1)
    words += fmt::format(
        "; largest difference {} d after {}, {} d after {}", readable(row.separations[0].largest),
        milliseconds(row.separations[0].time), readable(row.separations.back().largest),
        milliseconds(row.separations.back().time));
  if (const std::string reading = describeReading(row, rules);
      !reading.empty() && row.verdict != Equivalence::sameToRounding &&
      row.verdict != Equivalence::sameToPrecision)
    words += "; " + reading;
  if (const std::string resolution = describeResolution(row, rules); !resolution.empty())
    words += fmt::format(" ({})", resolution);
  if (const std::string term = describeTerm(row); !term.empty())
    words += fmt::format("; deviation found: {}", term);
  else if (row.verdict == Equivalence::differs)
    words += "; no single term accounts for it";
  if (row.verdict != Equivalence::sameToPrecision && row.precise > 0)
    words += fmt::format("; {} of these starts stay identical to its precision", row.precise);
  if (row.verdict == Equivalence::differs && row.first)
    words += fmt::format("; first seen {}", describeFirst(row));
  if (const std::string open = openInLaw(row, rules);
      row.verdict == Equivalence::differs && !open.empty())
    words += fmt::format("; borderline: {}", open);
  if (!row.failure.empty()) words += fmt::format("; then it failed: {}", row.failure);
  if (const std::string causes = describeCauses(row); !causes.empty())
    words += ". Known differences from the case's law, " + causes;
  return words + '.';
}

}  // namespace crossgrain::inline results
