#include "averaging/pocock.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_roots.h>

#include <cmath>
#include <memory>
#include <vector>

namespace crossgrain::inline averaging {

namespace {

/// Points of the density and their quadrature weights on (low, high).
struct Nodes {
  std::vector<double> at, weight;
};

Nodes nodesOn(double low, double high) {
  constexpr std::size_t count = 160;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)>
      table(gsl_integration_glfixed_table_alloc(count), gsl_integration_glfixed_table_free);
  Nodes nodes{std::vector<double>(count), std::vector<double>(count)};
  for (std::size_t k = 0; k < count; ++k)
    gsl_integration_glfixed_point(low, high, k, &nodes.at[k], &nodes.weight[k], table.get());
  return nodes;
}

/// The chance that a sum of k standard normal numbers exceeds limit·√k for some k up to `analyses`:
/// the density of the sums that did not, propagated from one analysis to the next (Armitage,
/// McPherson and Rowe 1969).
double chanceToExceed(double limit, int analyses) {
  constexpr double tail = 9.0;  // standard deviations, beyond which nothing is left
  const auto nodesOf = [&](int analysis) {
    const double width = std::sqrt(analysis);
    return nodesOn(-tail * width, limit * width);
  };
  double chance = gsl_cdf_ugaussian_Q(limit);
  Nodes here = nodesOf(1);
  std::vector<double> density;
  for (const double at : here.at) density.push_back(gsl_ran_ugaussian_pdf(at));
  for (int analysis = 2; analysis <= analyses; ++analysis) {
    const Nodes next = nodesOf(analysis);
    std::vector<double> nextDensity(next.at.size(), 0.0);
    for (std::size_t k = 0; k < here.at.size(); ++k) {
      const double mass = here.weight[k] * density[k];
      chance += mass * gsl_cdf_ugaussian_Q(limit * std::sqrt(analysis) - here.at[k]);
      for (std::size_t n = 0; n < nextDensity.size(); ++n)
        nextDensity[n] += mass * gsl_ran_ugaussian_pdf(next.at[n] - here.at[k]);
    }
    here = next;
    density = std::move(nextDensity);
  }
  return chance;
}

struct Asked {
  int analyses;
  double alpha;
};

double excess(double limit, void* asked) {
  const Asked& own = *static_cast<const Asked*>(asked);
  return chanceToExceed(limit, own.analyses) - own.alpha;
}

}  // namespace

double pocockLevel(int analyses, double alpha) {
  if (analyses == 1) return alpha;
  Asked asked{analyses, alpha};
  gsl_function function{excess, &asked};
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  // A single analysis asks for the least, the union bound for the most.
  gsl_root_fsolver_set(solver.get(), &function, gsl_cdf_ugaussian_Qinv(alpha),
                       gsl_cdf_ugaussian_Qinv(alpha / analyses));
  constexpr double precise = 1e-10;
  do {
    gsl_root_fsolver_iterate(solver.get());
  } while (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()),
                                  gsl_root_fsolver_x_upper(solver.get()), precise,
                                  precise) == GSL_CONTINUE);
  return gsl_cdf_ugaussian_Q(gsl_root_fsolver_root(solver.get()));
}

}  // namespace crossgrain::inline averaging
