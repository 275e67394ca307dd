#include "reports/collide/table.hpp"

#include <algorithm>

namespace crossgrain::reports {

std::size_t rowCount(const Json& table) {
  return list(table, "psi_i").size();
}

std::optional<double> at(const Json& table, std::string_view column, std::size_t row) {
  return number(element(list(table, column), row));
}

std::string caseOf(const Json& results, const Json& variant) {
  const std::string own = text(variant, "case");
  return own.empty() ? text(member(results, "case"), "name") : own;
}

std::vector<CaseGroup> casesOf(const Json& results) {
  std::vector<CaseGroup> groups;
  for (const Json& variant : list(results, "variants")) {
    const std::string name = caseOf(results, variant);
    auto group = std::ranges::find(groups, name, &CaseGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->variants.push_back(&variant);
  }
  return groups;
}

std::vector<const Json*> curvesOf(const Json& variant, const std::string& engine) {
  std::vector<const Json*> curves;
  for (const Json& curve : list(variant, "curves"))
    if (text(curve, "engine") == engine) curves.push_back(&curve);
  std::ranges::stable_sort(curves, std::ranges::greater{},
                           [](const Json* curve) { return number(*curve, "dt").value_or(0.0); });
  return curves;
}

const Json* coarsestCurve(const Json& variant, const std::string& engine) {
  for (const Json* curve : curvesOf(variant, engine))
    if (rowCount(member(*curve, "points")) > 0) return curve;
  return nullptr;
}

std::string verdictOf(const Json& curve) {
  const std::string status = text(curve, "status");
  const std::string verdict = text(member(curve, "score"), "verdict");
  return verdict.empty() || status == "refused" || status == "failed" ? status : verdict;
}

CollideCount countOf(const Json& results) {
  CollideCount count;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves")) {
      const std::string verdict = verdictOf(curve);
      count.held += verdict == "held";
      count.fellShort += verdict == "fell short";
      count.notJudged += verdict == "not judged";
      count.refused += verdict == "refused";
      count.failed += verdict == "failed";
    }
  return count;
}

std::string nothingJudged(const Json& results) {
  if (countOf(results).judged() > 0) return {};
  bool measured = false, limitless = false;
  std::string noOracle;
  for (const Json& variant : list(results, "variants")) {
    if (noOracle.empty()) noOracle = text(variant, "oracle_reason");
    limitless = limitless || !list(variant, "no_limit").empty();
    for (const Json& curve : list(variant, "curves"))
      for (const QuantityLabel& quantity : quantityLabels())
        measured = measured || number(member(member(curve, "score"), quantity.name), "max");
  }
  if (measured) return "the case has no [collision.margins] for what was measured";
  if (!noOracle.empty()) return "there is no oracle to judge by: " + noOracle;
  if (limitless) return "the law has no limit of small time steps at any point of the sweep";
  return "no engine has an outcome to judge";
}

const std::vector<QuantityLabel>& quantityLabels() {
  static const std::vector<QuantityLabel> labels = {{"psi_f", "Ψ_f"},
                                                    {"e_n", "e_n"},
                                                    {"beta", "β"},
                                                    {"e_t", "e_t"},
                                                    {"centre_psi_f", "centres' v_t"},
                                                    {"rebound_angle", "angle"},
                                                    {"spin_i", "ω_i"},
                                                    {"spin_j", "ω_j"},
                                                    {"duration", "duration"},
                                                    {"max_overlap", "overlap"},
                                                    {"energy_lost", "energy lost"},
                                                    {"lost_normal_damping", "normal"},
                                                    {"lost_tangential", "tangential"},
                                                    {"lost_tangential_damping", "sticking"},
                                                    {"lost_stiffening", "stiffening"},
                                                    {"lost_sliding", "sliding"},
                                                    {"lost_stored", "stored"}};
  return labels;
}

}  // namespace crossgrain::reports
