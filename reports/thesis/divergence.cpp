#include "reports/thesis/divergence.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>

#include "cases/thesis_claims.hpp"

namespace crossgrain::reports {

DivergenceRule divergenceRule(const ThesisResults& results) {
  if (results.rules.empty()) return {};
  const ClaimRules rules = claimRulesOf(results.rules);
  return {rules.number("band_to"), rules.number("first_layer_to"), rules.number("bulk_to"),
          rules.of("C27").number("factor")};
}

std::optional<double> traceOfDivergence(const RingView& view, const DivergenceRule& rule) {
  const Numbers place = valuesIn(view, {"r_tilde"}), trace = valuesIn(view, {"fabric_trace"});
  const Numbers ratio = valuesIn(view, {"shear_modulus", "fabric_trace"});
  const auto counts = [&](std::size_t k) { return ratio[k] && *ratio[k] > 0.0; };
  std::vector<double> band;
  for (std::size_t k = 0; k < ratio.size(); ++k)
    if (counts(k) && *place[k] < rule.bandTo) band.push_back(*ratio[k]);
  if (band.empty()) return std::nullopt;
  std::ranges::sort(band);
  const double limit = rule.factor * gsl_stats_median_from_sorted_data(band.data(), 1, band.size());
  std::optional<double> found;
  for (std::size_t k = ratio.size(); k-- > 0;) {
    if (!counts(k) || *place[k] < rule.from || *place[k] >= rule.to) continue;
    if (!(*ratio[k] > limit)) break;
    found = trace[k];
  }
  return found;
}

}  // namespace crossgrain::reports
