#include "reports/common/causes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "law/law_options.hpp"

namespace crossgrain::reports {

namespace {

/// Of the whole: a part below it is not named by itself.
constexpr double leastNamed = 0.01;
constexpr std::size_t mostNamed = 4;

/// A part with the digits of the whole's third significant one, "< 0.001" where that leaves none.
std::string besideWhole(double part, double whole) {
  const double size = std::abs(whole);
  const int digits = size > 0.0 ? 2 - static_cast<int>(std::floor(std::log10(size))) : 0;
  const char* const sign = part * whole < 0.0 ? "−" : "";
  if (digits > 6 || digits < -3) {
    const double least = std::pow(10.0, -digits);
    return part != 0.0 && std::abs(part) < 0.5 * least ? fmt::format("< {}", readable(least))
                                                       : sign + readable(std::abs(part));
  }
  const int shown = std::max(0, digits);
  const double least = std::pow(10.0, -shown);
  if (part != 0.0 && std::abs(part) < 0.5 * least) return fmt::format("< {:.{}f}", least, shown);
  return fmt::format("{}{:.{}f}", sign, std::abs(part), shown);
}

}  // namespace

std::string CauseAccount::largest() const {
  std::string name = remainderName;
  double most = std::abs(remainder);
  for (const auto& [part, value] : parts)
    if (std::abs(value) > most) {
      most = std::abs(value);
      name = part;
    }
  return name;
}

std::string accountWords(const CauseAccount& account) {
  std::vector<std::pair<std::string, double>> parts = account.parts;
  std::ranges::stable_sort(parts, std::greater(),
                           [](const auto& part) { return std::abs(part.second); });
  const double least = leastNamed * std::abs(account.whole);
  Names words;
  double others = 0.0;
  bool any = false;
  for (const auto& [name, value] : parts)
    if (words.size() < mostNamed && std::abs(value) >= least && value != 0.0) {
      const bool declared = std::ranges::find(account.undeclared, name) == account.undeclared.end();
      words.push_back(fmt::format("{} {}{}", name, besideWhole(value, account.whole),
                                  declared ? "" : " (not declared)"));
    } else if (value != 0.0) {
      others += value;
      any = true;
    }
  if (any) words.push_back("others " + besideWhole(others, account.whole));
  if (std::abs(account.interaction) >= least && account.interaction != 0.0)
    words.push_back("interaction " + besideWhole(account.interaction, account.whole));
  if (words.empty() && account.remainderName.empty()) return "no cause is shown";
  words.push_back(account.remainderName + " " + besideWhole(account.remainder, account.whole));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string causeSentence(const std::string& what, const std::string& engine,
                          const std::string& reference, const std::string& where,
                          const CauseAccount& account, const std::string& unit,
                          const std::optional<double>& limit, const char* limitIs) {
  const std::string of = unit.empty() ? "" : " " + unit;
  return fmt::format("{} of {} is {}{} {} than {}'s{}{}: {}{}", what, engine,
                     besideWhole(account.whole, account.whole), of,
                     account.whole < 0.0 ? "lower" : "higher", reference, where.empty() ? "" : " ",
                     where, accountWords(account),
                     limit ? fmt::format(" (1 {} = {}{})", limitIs, readable(*limit), of) : "");
}

std::string differenceWords(const CauseName& difference) {
  return fmt::format("{} {} → {}{}", difference.name, difference.from, difference.to,
                     difference.declared ? "" : " (not declared)");
}

std::string undeclaredSentence(const std::string& engine, const Causes& causes) {
  Names words;
  for (const CauseName& one : causes.undeclared)
    words.push_back(fmt::format("{} {}, not {}", one.name, one.to, one.from));
  if (words.empty()) return {};
  return fmt::format("{} does not do what it declares: as if {}.", engine, listed(words));
}

std::string causesNote(const Causes& causes) {
  if (!causes.reason.empty()) return fmt::format("Not attributed: {}.", causes.reason);
  Names words;
  for (const Interaction& pair : causes.interactions)
    words.push_back(fmt::format("{} and {} ({:.0f} %)", pair.one, pair.other, 100.0 * pair.share));
  std::string note;
  if (!words.empty()) note = fmt::format("Act on each other: {}.", listedShortly(words, 3));
  if (!causes.path.empty()) {
    Names taken;
    for (const CauseStep& step : causes.path) taken.push_back(step.name);
    note += fmt::format("{}Taken together, {} leave {:.0f} % of the difference of the laws.",
                        note.empty() ? "" : " ", listed(taken), 100.0 * causes.path.back().left);
  }
  return note;
}

Table causeTerms(const std::vector<const Causes*>& all) {
  Table table{{"option", remarks("values"), remarks("meaning, value by value")}};
  for (const LawOption& option : lawOptions())
    if (std::ranges::any_of(all, [&](const Causes* causes) {
          return std::ranges::any_of(causes->differences, [&](const CauseName& difference) {
            return ("+" + difference.name + "+").find(fmt::format("+{}+", option.name)) !=
                   std::string::npos;
          });
        }))
      table.rows.push_back({{{std::string(option.name)},
                             {fmt::format("{}", fmt::join(option.values, ", "))},
                             {std::string(option.meaning)}},
                            {},
                            termId(std::string(option.name))});
  return table;
}

std::string termId(const std::string& difference) {
  return "term_" + difference.substr(0, difference.find('+'));
}

}  // namespace crossgrain::reports
