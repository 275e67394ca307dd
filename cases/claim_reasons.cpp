#include "cases/claim_reasons.hpp"

#include "cases/loader_document.hpp"
#include "cases/loader_reader.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cases {
namespace {

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
  in.take("above");  // known, whether or not it is there
  in.take("below");
  if (in.has("above")) in.read("above", condition.above.emplace(), Range{});
  if (in.has("below")) in.read("below", condition.below.emplace(), Range{});
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

}  // namespace

ClaimReasons loadClaimReasons(const std::filesystem::path& file, const ClaimRules& rules) {
  return reasonsOf(readBaseDocument(file), file.string(), readFile(file).value_or(""), rules);
}

ClaimReasons claimReasonsOf(const std::string& text, const ClaimRules& rules) {
  return reasonsOf(documentOf(text, "", ""), "the claims' reasons", text, rules);
}

}  // namespace crossgrain::inline cases
