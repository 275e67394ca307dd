#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reports/common/causes.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

/// An endpoint of a pair, and what was found of it.
struct Explained {
  const PairCauses* pair;
  const EndpointCauses* own;
  const EndpointRow* row;
  double margins = 0.0;  ///< size of the difference

  /// From the endpoint's unit to that of words: a per cent of the reference, where margins are.
  double scale() const {
    return row->marginRelative ? 100.0 / std::abs(row->reference.value_or(1.0)) : 1.0;
  }
  std::string unit() const {
    if (row->marginRelative) return "%";
    return own->unit == "-" || own->unit == "1" ? "" : own->unit;
  }
  double margin() const { return row->marginRelative ? 100.0 * row->margin : row->margin; }

  bool isNamed(const CausePart& part) const {
    return part.isSeen() && std::abs(*part.mean) >= leastNamed * std::abs(*own->whole.mean);
  }

  /// Parts that are named; the others together are the rest. Without any there is no name.
  CauseAccount account() const {
    CauseAccount account{scale() * *own->whole.mean};
    account.remainder = account.whole;
    forParts(*pair, *own,
             [&](const std::string& name, const CauseName& one, const CausePart& part) {
               if (!isNamed(part)) return;
               account.parts.push_back({name, scale() * *part.mean, one.declared});
               account.remainder -= account.parts.back().value;
             });
    if (!account.parts.empty()) account.remainderName = "rest";
    return account;
  }

  /// The largest part that is seen and makes the difference larger; empty: none does.
  std::string shownCause() const {
    CauseAccount shown = account();
    shown.remainder = 0.0;
    return shown.largest();
  }
};

const EndpointRow* rowFor(const CompareResults& results, const PairCauses& pair,
                          const std::string& endpoint) {
  return findIf(results.endpoints.rows, [&](const EndpointRow& row) {
    return row.kind == PairKind::peer && row.endpoint == endpoint && row.b == pair.b &&
           row.a == (results.endpoints.reference.empty() ? pair.a : results.endpoints.reference);
  });
}

/// Those of which a difference is shown, by the packings of the verdict and by these, the largest
/// first.
std::vector<Explained> explained(const CompareResults& results) {
  std::vector<Explained> found;
  for (const PairCauses& pair : results.causes)
    for (const EndpointCauses& own : pair.endpoints) {
      Explained one{&pair, &own, rowFor(results, pair, own.endpoint)};
      const bool decided =
          one.row && (one.row->verdict == Verdict::fail || one.row->verdict == Verdict::borderline);
      const bool holds0 = own.whole.low && !own.whole.isSeen();
      if (!one.row || !own.whole.mean || !(decided || (one.row->differenceSeen() && !holds0)))
        continue;
      one.margins = std::abs(one.scale() * *own.whole.mean) / one.margin();
      found.push_back(one);
    }
  std::ranges::stable_sort(found, std::greater(), &Explained::margins);
  return found;
}

bool isOfReference(const CompareResults& results, const PairCauses& pair) {
  return !results.endpoints.reference.empty() || pair.a == referenceOf(results);
}

std::string pairWords(const PairCauses& pair) {
  return pair.b + " against " + pair.a;
}

std::string takes(double seconds) {
  return fmt::format("about {}; --causes asks for them", shortDuration(seconds));
}

/// "1.2 (0.8 to 1.6)"
std::string withInterval(const Explained& one, const CausePart& part) {
  const auto scaled = [&](const std::optional<double>& value) { return times(value, one.scale()); };
  return readableInterval(scaled(part.mean), scaled(part.low), scaled(part.high));
}

Table causesTable(const CompareResults& results) {
  Table table{{engineNames("engine"), engineNames("against"), "endpoint", numbers("difference"),
               numbers("in margins"), remarks("what makes it"), numbers("packings")}};
  for (const Explained& one : explained(results)) {
    std::vector<std::pair<double, std::string>> parts;
    forParts(*one.pair, *one.own,
             [&](const std::string& name, const CauseName& difference, const CausePart& part) {
               if (one.isNamed(part))
                 parts.emplace_back(std::abs(*part.mean),
                                    termWords(name) + " " + withInterval(one, part) +
                                        (difference.declared ? "" : " (not declared)"));
             });
    std::ranges::stable_sort(parts, std::greater(), [](const auto& part) { return part.first; });
    Names seen;
    for (const auto& [size, words] : parts) seen.push_back(words);
    const std::size_t others = one.own->parts.size() + 1 +
                               (one.pair->mixtures == Mixtures::bothEnds ? 1 : 0) - seen.size();
    const std::string unit = one.unit().empty() ? "" : " " + one.unit();
    TableRow row{
        {one.pair->b,
         one.pair->a,
         endpointWords(one.own->endpoint),
         withInterval(one, one.own->whole) + unit,
         shortly(one.margins),
         {seen.empty() ? "no cause is shown" : listed(seen),
          {others == 0 ? std::string()
                       : fmt::format("rest {} of {} not shown, or below a hundredth",
                                     readable(one.account().remainder), counted(others, "part"))}},
         fmt::format("{}", one.own->packings)}};
    row.cells[5].link = termLink(one.shownCause());
    table.rows.push_back(std::move(row));
  }
  const bool mixed = std::ranges::any_of(results.causes, [](const PairCauses& pair) {
    return !pair.endpoints.empty() && !pair.differences.empty();
  });
  table.note = fmt::format(
      "{} All of them add up to the difference, with the sign that they have in the engine's value "
      "minus that of the other. No part is named whose interval holds 0: the "
      "chance that any of a pair's is named by accident is at most that of a false disagreement. "
      "causes.csv has all.",
      mixed ? "Parts are measured by runs of the in-house engine under mixtures of both engines' "
              "laws, on the same packings; what is left is the implementation, or of rigid "
              "contacts the solver."
            : "Laws that do not differ have no part in a difference: all of it is the "
              "implementation, or of rigid contacts the solver.");
  return table;
}

/// In what the laws of a pair differ, and what was left out.
Names causesNotes(const CompareResults& results) {
  Names notes;
  for (const PairCauses& pair : results.causes) {
    Names words;
    for (const CauseName& one : pair.differences) words.push_back(differenceWords(one));
    std::string note = pairWords(pair) + ": ";
    if (!pair.reason.empty())
      note += causesNote(pair);
    else
      note += words.empty() ? "their laws do not differ."
                            : "their laws differ in " + listed(words) + ".";
    if (pair.missing && pair.reason.empty())
      note += fmt::format(" {}: {}.",
                          pair.endpoints.empty() ? "Causes were not measured, which takes"
                                                 : "Further packings take",
                          takes(*pair.missing));
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace

Names causeSentences(const CompareResults& results, std::size_t most) {
  Names sentences;
  std::vector<Explained> all = explained(results);
  // That engines of one law differ by their solvers says nothing where they agree.
  std::erase_if(all, [&](const auto& one) {
    return !isOfReference(results, *one.pair) ||
           (one.pair->differences.empty() && one.row->verdict == Verdict::pass);
  });
  for (const Explained& one : all) {
    if (sentences.size() == most) break;
    const bool closed = one.row->look == std::nullopt;
    sentences.push_back(
        capitalised(causeSentence(
            endpointWords(one.own->endpoint), one.pair->b, one.pair->a,
            closed ? ""
                   : fmt::format("on {}",
                                 counted(static_cast<std::size_t>(one.own->packings), "packing")),
            one.account(), one.unit(), one.margin(), "margin")) +
        ".");
  }
  SaidOf reasons;
  Names open, partly;
  double seconds = 0.0, further = 0.0;
  for (const PairCauses& pair : results.causes) {
    if (!isOfReference(results, pair)) continue;
    if (!pair.reason.empty()) {
      reasons.add(results.endpoints.reference.empty()
                      ? pairWords(pair)
                      : pair.b + " against " + called(results.endpoints.reference),
                  pair.reason);
    } else if (pair.missing) {
      (pair.endpoints.empty() ? open : partly).push_back(pair.b);
      (pair.endpoints.empty() ? seconds : further) += *pair.missing;
    }
  }
  for (const auto& [reason, pairs] : reasons.all())
    sentences.push_back(
        fmt::format("The differences of {} are not attributed: {}.", listed(pairs), reason));
  if (!open.empty())
    sentences.push_back(
        fmt::format("Causes of the differences of {} were not measured: they take {}.",
                    listed(open), takes(seconds)));
  if (!partly.empty())
    sentences.push_back(
        fmt::format("The other packings for causes of the differences of {} take {}.",
                    listed(partly), takes(further)));
  return sentences;
}

std::string largestCause(const CompareResults& results, const EndpointRow& row) {
  for (const Explained& one : explained(results))
    if (one.row == &row) return termWords(one.shownCause());
  return {};
}

void addCauses(Report& report, const CompareResults& results) {
  if (results.causes.empty()) return;
  Blocks& blocks = report.section("causes", "Causes of differences", "Causes").blocks;
  if (Table table = causesTable(results); !table.rows.empty()) blocks.push_back(std::move(table));
  if (Drawings profile = drawingsOf(report.figures, "causes_"); !profile.names.empty())
    blocks.push_back(std::move(profile));
  List notes;
  for (const std::string& note : causesNotes(results)) notes.items.push_back({"", note});
  blocks.push_back(std::move(notes));
  std::vector<const Causes*> all;
  for (const PairCauses& pair : results.causes) all.push_back(&pair);
  if (Table terms = causeTerms(all); !terms.rows.empty())
    blocks.push_back(Details{"Options of laws", {std::move(terms)}});
}

std::vector<Figure> profileCausesFigures(const CompareResults& results) {
  std::vector<StackedCauses> panels;
  for (const PairCauses& pair : results.causes) {
    if (pair.profile.empty()) continue;
    StackedCauses& panel = panels.emplace_back();
    panel.name = pairWords(pair);
    panel.xLabel = binAxis(results);
    panel.yLabel = fieldAxis(pair.profile.front().endpoint);
    for (const CauseName& one : pair.differences) panel.parts.push_back({one.name, {}});
    for (const char* const name : {"interaction", "rest"}) panel.parts.push_back({name, {}});
    for (const EndpointCauses& own : pair.profile) {
      panel.x.push_back(at(binPlaces(results), *own.bin));
      panel.whole.push_back(own.whole.mean);
      panel.error.push_back(own.whole.low ? std::optional(0.5 * (*own.whole.high - *own.whole.low))
                                          : std::nullopt);
      double rest = *own.whole.mean;
      std::size_t next = 0;
      forParts(pair, own, [&](const std::string&, const CauseName&, const CausePart& part) {
        const double value = part.isSeen() ? *part.mean : 0.0;
        if (next + 1 < panel.parts.size()) {
          panel.parts[next++].second.emplace_back(value);
          rest -= value;
        }
      });
      panel.parts.back().second.emplace_back(rest);
    }
  }
  std::erase_if(panels, [](const StackedCauses& panel) {
    return std::ranges::none_of(panel.x, [](const auto& x) { return x && std::isfinite(*x); });
  });
  if (panels.empty()) return {};
  const std::string& field = results.causes.front().profile.front().endpoint;
  return {stackedFigure(
      "causes_" + field,
      fmt::format("Differences of the {} bin by bin, and their causes", fieldWords(field)),
      "Line: the difference with its interval. Bands: parts whose intervals hold no 0, one on the "
      "other, by runs of the in-house engine under mixtures of both laws; grey: the rest.",
      panels)};
}

std::string causesCsv(const CompareResults& results) {
  std::string csv = "a,b,endpoint,unit,packings,part,from,to,declared,mean,low,high,seen,bin\n";
  for (const PairCauses& pair : results.causes)
    for (const auto* all : {&pair.endpoints, &pair.profile})
      for (const EndpointCauses& own : *all) {
        const auto add = [&](const std::string& name, const CauseName& words,
                             const CausePart& part) {
          csv += row(pair.a, pair.b, own.endpoint, own.unit, static_cast<std::size_t>(own.packings),
                     name, words.from, words.to, std::string(words.declared ? "yes" : "no"),
                     part.mean, part.low, part.high, std::string(part.isSeen() ? "yes" : "no"),
                     own.bin ? fmt::format("{}", *own.bin) : std::string());
        };
        add("whole", {}, own.whole);
        forParts(pair, own, add);
      }
  return csv;
}

}  // namespace crossgrain::reports
