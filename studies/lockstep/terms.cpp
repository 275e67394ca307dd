#include "studies/lockstep/terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/materials.hpp"
#include "studies/lockstep/rules.hpp"

namespace crossgrain::inline studies {
std::string referencePerturbationOf(const ContactLaw& law) {
  return law.soft() ? "kn" : "en";
}

LockstepRules lockstepRules(const ContactLaw& law) {
  return {lockstepRounding, lockstepSameLaw, std::ranges::max(referencePerturbations),
          referencePerturbationOf(law), strayShare};
}

void changeReference(ContactLaw& law, double by) {
  (law.soft() ? law.kn : law.en) *= 1.0 + by;
}

std::vector<double> proportionalRates(const std::vector<double>& responses) {
  const std::size_t disks = responses.size() / referencePerturbations.size();
  std::vector<double> rates(disks, 0.0);
  std::size_t moved = 0, alike = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < disks; ++i) {
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0, sum = 0.0, most = 0.0;
    for (std::size_t c = 0; c < referencePerturbations.size(); ++c) {
      const double response = responses[c * disks + i];
      const double rate = response / std::abs(referencePerturbations[c]);
      slowest = std::min(slowest, rate);
      fastest = std::max(fastest, rate);
      most = std::max(most, response);
      sum += rate;
    }
    if (!(most > lockstepRounding)) continue;
    ++moved;
    if (!(fastest <= responsesAlike * slowest)) continue;
    ++alike;
    largest = std::max(largest, most);
    rates[i] = sum / static_cast<double>(referencePerturbations.size());
  }
  if (moved == 0 || 2 * alike < moved || !(largest < largestResponse)) return {};
  return rates;
}

std::optional<double> equivalentChange(const std::vector<double>& apart,
                                       const std::vector<double>& responses) {
  const std::vector<double> rates = proportionalRates(responses);
  if (rates.empty() || rates.size() != apart.size()) return std::nullopt;
  const std::size_t disks = rates.size();
  double own = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < disks; ++i) {
    double distance = apart[i];
    if (rates[i] == 0.0) {
      double event = 0.0;
      for (std::size_t c = 0; c < referencePerturbations.size(); ++c)
        event = std::max(event, responses[c * disks + i]);
      distance = std::max(0.0, distance - event);
    }
    own += distance * distance;
    moved += rates[i] * rates[i];
  }
  return std::sqrt(own / moved);
}

void changeConstant(ContactLaw& law, const std::string& constant, double by) {
  if (constant == "mu")
    law.mu *= 1.0 + by;
  else
    changeReference(law, by);
}

std::vector<ChangedCase> changedCases(const Case& setup) {
  std::vector<std::string> constants = {referencePerturbationOf(setup.law)};
  if (setup.law.mu > 0.0) constants.emplace_back("mu");
  std::vector<ChangedCase> cases;
  for (const std::string& constant : constants) {
    cases.push_back({constant, fmt::format("{}+{:g}%", constant, 100.0 * responseChange), setup});
    changeLaws(cases.back().setup,
               [&](ContactLaw& law) { changeConstant(law, constant, responseChange); });
  }
  return cases;
}

}  // namespace crossgrain::inline studies
