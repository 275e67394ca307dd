#include "reports/common/causes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <ranges>

#include "law/law_options.hpp"
#include "results/lockstep_text.hpp"

namespace crossgrain::reports {

namespace {

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

bool isOption(std::string_view name) {
  return std::ranges::find(lawOptions(), name, &LawOption::name) != lawOptions().end();
}

std::string termId(std::string_view option) {
  return fmt::format("term_{}", option);
}

/// The largest first. Two that are each more than twice the whole and cancel but for a tenth are
/// one: neither alone is what makes it.
std::vector<CauseAccount::Part> bySize(std::vector<CauseAccount::Part> parts, double whole) {
  constexpr double many = 2.0, cancels = 0.1;
  const auto sort = [&] {
    std::ranges::stable_sort(parts, std::greater(),
                             [](const auto& part) { return std::abs(part.value); });
  };
  sort();
  while (parts.size() > 1 && std::abs(parts[1].value) > many * std::abs(whole) &&
         std::abs(parts[0].value + parts[1].value) < cancels * std::abs(parts[0].value)) {
    parts[0] = {fmt::format("{} and {} together", parts[0].name, parts[1].name),
                parts[0].value + parts[1].value, parts[0].declared && parts[1].declared};
    parts.erase(parts.begin() + 1);
    sort();
  }
  return parts;
}

}  // namespace

std::string termWords(const std::string& name) {
  std::string all;
  for (const char c : name) all += c == '+' ? " with " : std::string(1, c);
  Names words;
  for (const auto part : std::views::split(all, ' ')) {
    const std::string word(part.begin(), part.end());
    const std::string symbol = constantSymbol(word);
    words.push_back(symbol == word ? spaced(word) : symbol);
  }
  return fmt::format("{}", fmt::join(words, " "));
}

std::string CauseAccount::largest() const {
  std::string name;
  double most = 0.0;
  const auto look = [&](const std::string& part, double value) {
    if (const double makes = whole < 0.0 ? -value : value; makes > most) {
      most = makes;
      name = part;
    }
  };
  for (const Part& part : bySize(parts, whole)) look(part.name, part.value);
  look(remainderName, remainder);
  return name;
}

std::string accountWords(const CauseAccount& account) {
  const std::vector<CauseAccount::Part> parts = bySize(account.parts, account.whole);
  const double least = leastNamed * std::abs(account.whole);
  Names words;
  double others = 0.0;
  bool any = false;
  for (const auto& [name, value, declared] : parts)
    if (words.size() < mostNamed && std::abs(value) >= least && value != 0.0) {
      words.push_back(fmt::format("{} {}{}", termWords(name), besideWhole(value, account.whole),
                                  declared ? "" : " (not declared)"));
    } else if (value != 0.0) {
      others += value;
      any = true;
    }
  if (any) words.push_back("others " + besideWhole(others, account.whole));
  if (std::abs(account.interaction) >= least && account.interaction != 0.0)
    words.push_back("interaction " + besideWhole(account.interaction, account.whole));
  if (words.empty() && account.remainderName.empty()) return "no cause is shown";
  if (account.remainder != 0.0 || words.empty())
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
  return fmt::format("{} {} → {}{}", termWords(difference.name), spaced(difference.from),
                     spaced(difference.to), difference.declared ? "" : " (not declared)");
}

std::string undeclaredSentence(const std::string& engine, const Causes& causes,
                               const std::optional<EffectiveParameters>& effective) {
  Names words, reported;
  for (const CauseName& one : causes.undeclared)
    words.push_back(
        fmt::format("{} were {}, not {}", termWords(one.name), spaced(one.to), spaced(one.from)));
  if (words.empty()) return {};
  if (effective)
    for (const Deviation& one : effective->deviations)
      if (!isOption(one.name)) addOnce(reported, one.note.empty() ? spaced(one.name) : one.note);
  return fmt::format("{} differs from the law that it declares as if {}.{}", engine, listed(words),
                     reported.empty() ? ""
                                      : fmt::format(" It reports, beside options of the law: {}.",
                                                    fmt::join(reported, "; ")));
}

std::string causesNote(const Causes& causes) {
  if (!causes.reason.empty()) return fmt::format("Not attributed: {}.", causes.reason);
  Names words;
  for (const Interaction& pair : causes.interactions)
    words.push_back(fmt::format("{} and {} ({:.0f} %)", termWords(pair.one), termWords(pair.other),
                                100.0 * pair.share));
  std::string note;
  if (!words.empty()) note = fmt::format("Act on each other: {}.", listedShortly(words, 3));
  if (!causes.path.empty()) {
    Names taken;
    for (const CauseStep& step : causes.path) taken.push_back(termWords(step.name));
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
                            termId(option.name)});
  table.note =
      "More of them is in the documentation: docs/cases.md, section Laws, why each option has its "
      "default and which engines have which value; docs/laws.md, rolling resistance and cohesion; "
      "docs/engines.md, the engines.";
  return table;
}

std::string termLink(const std::string& difference) {
  const std::string option = difference.substr(0, difference.find('+'));
  return isOption(option) ? "#" + termId(option) : "";
}

namespace {

/// Colours that tell eight parts apart (Okabe and Ito 2008).
constexpr const char* bandColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                       "#e69f00", "#56b4e9", "#f0e442", "#7f3fbf"};

/// @param colours  of parts by name, one for all panels
Panel stackedPanel(const StackedCauses& one, std::map<std::string, const char*>& colours) {
  Panel panel;
  panel.name = one.name;
  panel.xLabel = one.xLabel;
  panel.yLabel = one.yLabel;
  panel.level = 0.0;
  panel.key = Key::none;
  const auto add = [&](Curve curve) {
    std::ranges::sort(curve.points, {}, &Point::x);
    panel.curves.push_back(std::move(curve));
  };
  const auto size = [](const auto& value) { return std::abs(value.value_or(0.0)); };
  const double least = 1e-3 * size(*std::ranges::max_element(one.whole, {}, size));
  // Stacks parts above zero upwards, parts below zero downwards.
  std::vector<double> above(one.x.size(), 0.0), below = above;
  for (const auto& [name, values] : one.parts) {
    if (std::ranges::none_of(values, [&](const auto& value) { return size(value) > least; }))
      continue;
    const bool isRest = &values == &one.parts.back().second;
    const char* const next = bandColours[colours.size() % std::size(bandColours)];
    Curve band{termWords(name),
               {isRest ? "#b0b0b0" : colours.try_emplace(name, next).first->second, 0, false},
               Draw::bands,
               {},
               1.0};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double value = values[k].value_or(0.0);
      double& base = value < 0.0 ? below[k] : above[k];
      if (one.x[k]) band.points.push_back({*one.x[k], base + 0.5 * value, 0.5 * std::abs(value)});
      base += value;
    }
    add(std::move(band));
  }
  Curve line{"difference", {"#000000", 0, false}, Draw::lines, {}, 2.0};
  for (std::size_t k = 0; k < one.whole.size(); ++k)
    if (one.x[k] && one.whole[k])
      line.points.push_back({*one.x[k], *one.whole[k], at(one.error, k)});
  if (!one.error.empty()) line.draw = Draw::linesAndPoints;
  add(std::move(line));
  return panel;
}

}  // namespace

Figure stackedFigure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<StackedCauses>& all) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.caption = caption;
  std::map<std::string, const char*> colours;
  for (const StackedCauses& one : all) figure.panels.push_back(stackedPanel(one, colours));
  figure.keyAbove = true;
  figure.columns = std::clamp(static_cast<int>(all.size()), 1, 3);
  figure.panelWidth = 1240 / std::max(figure.columns, 2);
  figure.panelHeight = 300;
  return figure;
}

}  // namespace crossgrain::reports
