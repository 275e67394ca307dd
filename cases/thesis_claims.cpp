#include "cases/thesis_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "cases/loader_document.hpp"
#include "cases/loader_reader.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr std::string_view reasonWanted = "must give the reason";

/// Those named, in the order named; another one is an unknown key, a missing one is missing.
std::vector<ClaimNumber> readNumbers(Reader in, const std::vector<std::string>& names) {
  std::vector<ClaimNumber> numbers;
  for (const std::string& name : names) {
    if (!in.has(name)) in.failMissing(name, "the judgement needs it");
    Reader each = in.section(name);
    ClaimNumber& number = numbers.emplace_back();
    number.name = name;
    each.require("value", number.value, Range{});
    each.requireText("why", number.why, reasonWanted);
    each.finish();
  }
  in.finish();
  return numbers;
}

ClaimBand readBand(Reader in, const std::string& name) {
  ClaimBand band;
  band.name = name;
  in.requireText("label", band.label, "must say what it is");
  in.read("unit", band.unit);
  in.read("low", band.low, Range{});
  in.read("high", band.high, Range{});
  in.read("testable", band.testable);
  in.requireText("why", band.why, reasonWanted);
  in.finish();
  if (!band.testable && band.judged())
    in.fail("testable", "what cannot be tested has neither low nor high");
  if (band.low && band.high && !(*band.low < *band.high))
    in.fail("high", fmt::format("must be above low = {}", *band.low));
  return band;
}

std::vector<ClaimBand> readBands(Reader in, const std::vector<std::string>& names) {
  std::vector<ClaimBand> bands;
  for (const std::string& name : names) {
    if (!in.has(name)) in.failMissing(name, "the judgement gives this figure");
    bands.push_back(readBand(in.section(name), name));
  }
  in.finish();
  if (std::ranges::none_of(bands,
                           [](const ClaimBand& band) { return band.judged() || !band.testable; }))
    in.failMissing(names.front() + ".low", "or high: a claim has a figure with a band");
  return bands;
}

ClaimRule readRule(Reader in, const ClaimSchema* schema) {
  static const std::vector<std::string> interpretations{"spacing", "mass", "radius", "tension"};
  ClaimRule rule;
  if (!in.has("id")) in.failMissing("id", "one of C1 … C27");
  const ClaimNeeds* needs = nullptr;
  if (schema) {
    std::vector<std::string> ids;
    for (const ClaimNeeds& each : schema->claims) ids.push_back(each.id);
    in.read("id", rule.id, ids);
    needs = &*std::ranges::find(schema->claims, rule.id, &ClaimNeeds::id);
  } else {
    in.read("id", rule.id);
  }
  in.requireText("claim", rule.claim, "must say what is claimed");
  in.requireText("rule", rule.rule, "must say what is measured, and what it means");
  in.require("figure", rule.figure);
  in.read("readings", rule.interpretations, interpretations);
  const Reader numbers = in.section("numbers"), figures = in.section("figures");
  rule.numbers = readNumbers(numbers, needs ? needs->numbers : numbers.keys());
  rule.figures = readBands(figures, needs ? needs->figures : figures.keys());
  in.finish();
  return rule;
}

ClaimRules rulesOf(const CaseDocument& document, const std::string& name, std::string text,
                   const ClaimSchema* schema) {
  Reader in(&document.root, "", name);
  ClaimRules rules;
  rules.text = std::move(text);
  if (!in.has("common")) in.failMissing("common", "numbers of all rules");
  const Reader common = in.section("common");
  rules.common = readNumbers(common, schema ? schema->common : common.keys());
  const auto has = [&](const std::string& id) {
    return std::ranges::find(rules.claims, id, &ClaimRule::id) != rules.claims.end();
  };
  for (Reader& each : in.sections("claims")) {
    ClaimRule rule = readRule(each, schema);
    if (has(rule.id)) each.fail("id", "is there twice");
    rules.claims.push_back(std::move(rule));
  }
  in.finish();
  if (schema)
    for (const ClaimNeeds& needs : schema->claims)
      if (!has(needs.id)) in.failMissing("claims", fmt::format("there is no rule of {}", needs.id));
  return rules;
}

std::vector<std::string> idsOf(const ClaimRules& rules) {
  std::vector<std::string> ids;
  for (const ClaimRule& rule : rules.claims) ids.push_back(rule.id);
  return ids;
}

ReasonCondition readCondition(Reader in, const std::string& claim, const ClaimRules& rules) {
  ReasonCondition condition;
  condition.claim = claim;
  in.read("claim", condition.claim, idsOf(rules));
  std::vector<std::string> figures;
  for (const ClaimBand& band : rules.of(condition.claim).figures) figures.push_back(band.name);
  in.require("figure", condition.figure, figures);
  if (!in.has("above") && !in.has("below")) in.failMissing("above", "or below: when it holds");
  in.read("above", condition.above, Range{});
  in.read("below", condition.below, Range{});
  in.finish();
  return condition;
}

ClaimReason readReason(Reader in, const ClaimRules& rules) {
  ClaimReason reason;
  if (!in.has("claim")) in.failMissing("claim", "whose reason it is");
  in.read("claim", reason.claim, idsOf(rules));
  in.read("engine", reason.engine);
  in.requireText("text", reason.text, "must say why the claim fails");
  in.requireText("evidence", reason.evidence, "must name what it rests on");
  std::vector<Reader> conditions = in.sections("when");
  in.finish();
  if (conditions.empty()) in.failMissing("when", "a reason says of which figures it holds");
  for (Reader& each : conditions) reason.when.push_back(readCondition(each, reason.claim, rules));
  return reason;
}

ClaimReasons reasonsOf(const CaseDocument& document, const std::string& name, std::string text,
                       const ClaimRules& rules) {
  Reader in(&document.root, "", name);
  ClaimReasons all;
  all.text = std::move(text);
  for (Reader& each : in.sections("reasons")) all.reasons.push_back(readReason(each, rules));
  in.finish();
  return all;
}

/// The one of that name. @param of  whose, for the message
template <typename Named>
const Named& named(const std::vector<Named>& list, std::string_view name, std::string_view of) {
  const auto found = std::ranges::find(list, name, &Named::name);
  if (found == list.end()) throw std::logic_error(fmt::format("rules: {} has no {}", of, name));
  return *found;
}

}  // namespace

double ClaimRule::number(std::string_view name) const {
  return named(numbers, name, id).value;
}

const ClaimBand& ClaimRule::band(std::string_view name) const {
  return named(figures, name, id);
}

bool ClaimRule::judgedUnder(std::string_view interpretation) const {
  return std::ranges::find(interpretations, interpretation) != interpretations.end();
}

int ClaimRule::judgedFigures() const {
  return static_cast<int>(std::ranges::count_if(figures, &ClaimBand::judged));
}

double ClaimRules::number(std::string_view name) const {
  return named(common, name, "common").value;
}

const ClaimRule& ClaimRules::of(std::string_view id) const {
  const auto found = std::ranges::find(claims, id, &ClaimRule::id);
  if (found == claims.end()) throw std::logic_error(fmt::format("rules: there is no {}", id));
  return *found;
}

ClaimRules loadClaimRules(const std::filesystem::path& file, const ClaimSchema* schema) {
  return rulesOf(readBaseDocument(file), file.string(), readFile(file).value_or(""), schema);
}

ClaimRules claimRulesOf(const std::string& text, const ClaimSchema* schema) {
  return rulesOf(documentOf(text, "", ""), "the claims' rules", text, schema);
}

ClaimReasons loadClaimReasons(const std::filesystem::path& file, const ClaimRules& rules) {
  return reasonsOf(readBaseDocument(file), file.string(), readFile(file).value_or(""), rules);
}

ClaimReasons claimReasonsOf(const std::string& text, const ClaimRules& rules) {
  return reasonsOf(documentOf(text, "", ""), "the claims' reasons", text, rules);
}

CaseConstants caseConstants(const std::string& caseToml) {
  const toml::table root = documentOf(caseToml, "", "").root;
  return {root.at_path("particles.large_mass").value<double>(),
          root.at_path("law.kt").value<double>()};
}

}  // namespace crossgrain::inline cases
