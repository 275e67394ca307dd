#include "tests/coverage/studies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <ranges>

#include "averaging/agreement.hpp"
#include "averaging/interim_analyses.hpp"
#include "averaging/statistics.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::coverage {

namespace {

constexpr const char* engineName = "grain";
constexpr int shuffles = 20;

/// Counts over shuffles of the packings; groups of one shuffle share none.
struct Tally {
  double hits = 0.0, trials = 0.0;

  void add(bool hit) {
    hits += hit;
    ++trials;
  }
  double rate() const { return trials > 0.0 ? hits / trials : 0.0; }
};

std::vector<Numbers> ringsOfLeg(const Sample& sample, const std::string& leg,
                                const std::string& field) {
  return fieldByRing(finishedRuns(sample.runs, engineName, leg),
                     sample.setup->averaging.methods.front(), field, sample.packings);
}

/// Indices of the packings that a leg has run, in an order of its own for every shuffle.
std::vector<std::size_t> shuffled(const Sample& sample, const std::string& leg, int shuffle) {
  std::vector<std::size_t> order;
  for (const FlowRun* run : finishedRuns(sample.runs, engineName, leg))
    order.push_back(static_cast<std::size_t>(run->packing));
  std::mt19937_64 generator(static_cast<std::uint64_t>(shuffle));
  std::ranges::shuffle(order, generator);
  return order;
}

Numbers pick(const Numbers& values, const std::vector<std::size_t>& order, std::size_t first,
             int group) {
  Numbers picked;
  for (int k = 0; k < group; ++k) picked.push_back(values[order[first + static_cast<size_t>(k)]]);
  return picked;
}

/// Does something with every group of packings of a leg, for every shuffle.
/// @param what  given the order of the packings and the place of the group's first in it
/// @returns groups that share no run
int forEachGroup(const Sample& sample, const std::string& leg, int group, const auto& what) {
  int independent = 0;
  for (int shuffle = 0; shuffle < shuffles; ++shuffle) {
    const auto order = shuffled(sample, leg, shuffle);
    independent = static_cast<int>(order.size()) / group;
    for (int g = 0; g < independent; ++g) what(order, static_cast<std::size_t>(g * group));
  }
  return independent;
}

/// All rings of all fields with a margin: one family, as `compare` has it.
struct Family {
  std::vector<std::string> field;
  std::vector<int> ring;
  std::vector<Margin> margin;
  std::vector<Numbers> reference, other;
};

Family familyOf(const Sample& sample, const std::string& leg) {
  Family family;
  for (const auto& [field, margin] : sample.setup->averaging.margins) {
    const auto reference = ringsOfLeg(sample, "", field), other = ringsOfLeg(sample, leg, field);
    for (std::size_t ring = 0; ring < std::min(reference.size(), other.size()); ++ring) {
      family.field.push_back(field);
      family.ring.push_back(static_cast<int>(ring));
      family.margin.push_back(margin);
      family.reference.push_back(reference[ring]);
      family.other.push_back(other[ring]);
    }
  }
  return family;
}

std::vector<PairedSample> grouped(const Family& family, bool withMargins,
                                  const std::vector<std::size_t>& order, std::size_t first,
                                  std::size_t otherFirst, int group) {
  std::vector<PairedSample> samples;
  for (std::size_t k = 0; k < family.field.size(); ++k) {
    Margin margin = family.margin[k];
    if (!withMargins) margin.value = 0.0;
    samples.push_back(testedRing(margin, pick(family.reference[k], order, first, group),
                                 pick(family.other[k], order, otherFirst, group))
                          .sample);
  }
  return samples;
}

/// One endpoint of a group of packings on the scale of its test, the other engine's values moved by
/// so many margins.
PairedSample shiftedSample(const Case& setup, const std::string& name, const Runs& reference,
                           const Runs& other, std::size_t packings,
                           const std::vector<std::size_t>& order, std::size_t first, int group,
                           double margins) {
  const Endpoint& endpoint = endpointNamed(name);
  const auto values = [&](const Runs& runs) {
    return pick(endpointByPacking(endpoint, setup, runs, packings), order, first, group);
  };
  PairedSample sample =
      testedEndpoint(endpoint, setup.averaging.endpoints.at(name), values(reference), values(other))
          .sample;
  for (auto& value : sample.other)
    if (value) *value += margins * sample.margin;
  return sample;
}

double deviationOf(const PairedTest& ring) {
  Numbers differences;
  for (std::size_t k = 0; k < ring.sample.reference.size(); ++k)
    if (ring.sample.reference[k] && ring.sample.other[k])
      differences.emplace_back(*ring.sample.other[k] - *ring.sample.reference[k]);
  const auto mean = ensembleMean(differences);
  return *mean->standardError * std::sqrt(mean->packings);
}

}  // namespace

double Rate::error() const {
  return std::sqrt(value * (1.0 - value) / std::max(independent, 1));
}

std::vector<Rate> withinRuns(const Case& setup, const std::vector<WindowRun>& entries) {
  struct Counts {
    Tally whole, next;
    double distance = 0.0, bar = 0.0;
  };
  std::map<std::pair<std::string, int>, Counts> counts;
  std::map<int, const WindowRun*> whole;
  std::map<int, std::map<int, const WindowRun*>> windows;
  for (const WindowRun& entry : entries) {
    if (entry.rotations == couetteIn(setup).times.rotations)
      windows[entry.packing][entry.window] = &entry;
    else
      whole[entry.packing] = &entry;
  }
  int independent = 0;
  for (const auto& [packing, truth] : whole) {
    independent += static_cast<int>(windows[packing].size());
    for (const Profile& profile : truth->profiles) {
      const std::string& field = profile.field;
      const Numbers& mean = profile.mean;
      for (std::size_t ring = 0; ring < mean.size(); ++ring) {
        Counts& here = counts[{field, static_cast<int>(ring)}];
        double before = 0.0, beforeError = 0.0, beforeDof = 0.0;
        for (const auto& [window, entry] : windows[packing]) {
          const Profile& part = *profileOf(entry->profiles, profile.method, field);
          if (!mean[ring] || !part.standardError[ring]) continue;
          const double value = *part.mean[ring], error = *part.standardError[ring],
                       dof = *part.dof[ring];
          here.whole.add(std::abs(value - *mean[ring]) <= studentQuantile(0.95, dof) * error);
          here.distance += (value - *mean[ring]) * (value - *mean[ring]);
          here.bar += error * error;
          if (window > 0) {
            const double both = error * error + beforeError * beforeError;
            // Welch's degrees of freedom
            const double joint =
                both * both / (std::pow(error, 4) / dof + std::pow(beforeError, 4) / beforeDof);
            here.next.add(std::abs(value - before) <=
                          studentQuantile(0.95, joint) * std::sqrt(both));
          }
          before = value;
          beforeError = error;
          beforeDof = dof;
        }
      }
    }
  }
  std::vector<Rate> rates;
  for (const auto& [key, here] : counts) {
    const auto& [field, ring] = key;
    rates.push_back({"within", "", field, ring, 1, independent, here.whole.rate()});
    rates.push_back({"within_next", "", field, ring, 1, independent, here.next.rate()});
    rates.push_back({"within_ratio", "", field, ring, 1, independent,
                     std::sqrt(here.distance / std::max(here.bar, 1e-300))});
  }
  return rates;
}

std::vector<Rate> ensembles(const Sample& sample, int group) {
  std::vector<Rate> rates;
  const FlowRun& first = *finishedRuns(sample.runs, engineName).front();
  for (const Profile& profile : first.profiles) {
    const std::string& field = profile.field;
    const auto rings = ringsOfLeg(sample, "", field);
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
      const auto truth = ensembleMean(rings[ring]);
      if (!truth) continue;
      Tally tally;
      const int independent = forEachGroup(
          sample, "", group, [&](const std::vector<std::size_t>& order, std::size_t from) {
            const auto mean = ensembleMean(pick(rings[ring], order, from, group));
            if (!mean || !mean->standardError) return;
            tally.add(std::abs(mean->mean - truth->mean) <=
                      studentQuantile(0.95, mean->packings - 1) * *mean->standardError);
          });
      if (tally.trials > 0.0)
        rates.push_back(
            {"ensemble", "", field, static_cast<int>(ring), group, independent, tally.rate()});
    }
  }
  return rates;
}

std::vector<Rate> disagreements(const Sample& sample, const std::string& leg, int group) {
  std::vector<Rate> rates;
  const Family family = familyOf(sample, leg);
  const double confidence = sample.setup->averaging.confidence;
  const int span = leg.empty() ? 2 * group : group;
  for (const bool withMargins : {false, true}) {
    Tally any;
    std::map<std::string, Tally> perField;
    const int independent = forEachGroup(
        sample, leg, span, [&](const std::vector<std::size_t>& order, std::size_t first) {
          const auto found = comparePaired(
              grouped(family, withMargins, order, first,
                      leg.empty() ? first + static_cast<std::size_t>(group) : first, group),
              confidence);
          bool anywhere = false;
          std::map<std::string, bool> inField;
          for (std::size_t k = 0; k < found.size(); ++k) {
            const bool hit = found[k] && found[k]->verdict == Verdict::fail;
            anywhere |= hit;
            inField[family.field[k]] |= hit;
          }
          any.add(anywhere);
          for (const auto& [field, hit] : inField) perField[field].add(hit);
        });
    const std::string study = withMargins ? "disagree" : "disagree_0";
    rates.push_back({study, leg, "any", {}, group, independent, any.rate()});
    for (const auto& [field, tally] : perField)
      rates.push_back({study, leg, field, {}, group, independent, tally.rate()});
  }
  return rates;
}

std::vector<Rate> looks(const Sample& sample) {
  const Case& setup = *sample.setup;
  const InterimPlan plan = interimPlanOf(setup);
  const int group = plan.packings.back();
  const Runs whole = finishedRuns(sample.runs, engineName);
  const Runs again = finishedRuns(sample.runs, engineName, "again");
  const auto names = std::views::keys(setup.averaging.endpoints);
  std::map<std::string, Tally> decided, falseAgree, found;
  Tally falseDisagree;
  const int independent = forEachGroup(
      sample, "again", group, [&](const std::vector<std::size_t>& order, std::size_t first) {
        // Alternate signs, so that neither side of the margin is the easier one.
        const double sign = first / static_cast<std::size_t>(group) % 2 ? 1.0 : -1.0;
        const auto shifted = [&](double margins, const std::string& only) {
          std::vector<PairedSample> family;
          for (const std::string& name : names)
            family.push_back(shiftedSample(setup, name, whole, again, sample.packings, order, first,
                                           group, only.empty() || only == name ? margins : 0.0));
          return answersAfterInterims(family, plan, group);
        };
        const auto same = shifted(0.0, ""), edge = shifted(sign, "");
        bool any = false;
        std::size_t k = 0;
        for (const std::string& name : names) {
          decided[name].add(same[k]->verdict == Verdict::pass);
          falseAgree[name].add(edge[k]->verdict == Verdict::pass);
          any = any || edge[k]->verdict == Verdict::fail;
          found[name].add(shifted(2.0 * sign, name)[k]->verdict == Verdict::fail);
          ++k;
        }
        falseDisagree.add(any);
      });
  std::vector<Rate> rates = {
      {"looks_false_disagree", "again", "any", {}, group, independent, falseDisagree.rate()}};
  for (const auto& [study, tallies] : {std::pair("looks_decided", &decided),
                                       {"looks_false_agree", &falseAgree},
                                       {"looks_found", &found}})
    for (const auto& [name, tally] : *tallies)
      rates.push_back({study, "again", name, {}, group, independent, tally.rate()});
  return rates;
}

std::vector<Rate> power(const Sample& sample, int group) {
  const Family family = familyOf(sample, "again");
  const double confidence = sample.setup->averaging.confidence;
  const double level = (1.0 - confidence) / static_cast<double>(family.field.size());
  std::vector<Rate> rates;
  for (std::size_t k = 0; k < family.field.size(); ++k) {
    const PairedTest all = testedRing(family.margin[k], family.reference[k], family.other[k]);
    const double shift = *smallestDetectable(deviationOf(all) / std::sqrt(group), group - 1,
                                             all.sample.margin, level);
    Tally tally;
    const int independent = forEachGroup(
        sample, "again", group, [&](const std::vector<std::size_t>& order, std::size_t first) {
          auto samples = grouped(family, true, order, first, first, group);
          for (auto& value : samples[k].other)
            if (value) *value += shift;
          tally.add(comparePaired(samples, confidence)[k]->verdict == Verdict::fail);
        });
    rates.push_back(
        {"power", "again", family.field[k], family.ring[k], group, independent, tally.rate()});
    rates.push_back({"detects_ratio", "again", family.field[k], family.ring[k], group, independent,
                     shift / all.sample.margin});
  }
  return rates;
}

}  // namespace crossgrain::coverage
