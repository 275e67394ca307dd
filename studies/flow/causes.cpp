#include "studies/flow/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/declared_law.hpp"
#include "cases/effect_switch.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/materials.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/paired_runs.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr double leastMargins = 0.01;
constexpr std::size_t mostMixed = 2;

}  // namespace

Case caseAsRun(const Case& setup, double dt, const EngineEntry& entry, const Capabilities& can,
               const EffectiveParameters& effective) {
  Case own = setup;
  inDimensionOf(setup, [&]<int D>() {
    const SceneOf<D> scene = sceneFor(can, entry, setup, unplacedScene<D>(setup, dt)).scene;
    own.law = scene.law;
    if (!scene.materials)
      own.materials.reset();
    else
      own.materials->laws = scene.materials->laws;
    own.bottom = scene.bottom;
    if (isAssembly(setup)) {
      assemblyIn<D>(own).rotation = scene.rotation;
      assemblyIn<D>(own).gravity = scene.gravity;
    } else {
      couetteIn(own).particles.rotation = scene.rotation;
    }
    if (effectsOf(unplacedScene<D>(own, dt)) != effectsOf(scene))
      throw UnsupportedScene(entry.name + " lacks an effect that no case can leave out");
  });
  changeLaws(own, [&](ContactLaw& law) {
    const auto declared = declaredLaw(can, law, effective);
    if (!declared)
      throw UnsupportedScene(entry.name +
                             " has another normal law, whose constants it does not report");
    law = *declared;
  });
  Settings& settings = own.engines[engineRegistry().front().name];
  settings.erase("stiffness");
  settings["dt"] = effective.dt;
  own.run.keepSnapshots = 0;
  return own;
}

namespace {

/// Mixtures that attribute() asks for; laws that do not differ take no run.
std::set<Mixture> mixturesOf(std::size_t differences) {
  std::set<Mixture> all;
  if (differences == 0) return all;
  const Mixture last = (Mixture{1} << differences) - 1;
  if (differences <= mostMixed) {
    for (Mixture m = 0; m <= last; ++m) all.insert(m);
    return all;
  }
  all = {0, last};
  for (std::size_t k = 0; k < differences; ++k)
    all.insert({Mixture{1} << k, last ^ Mixture{1} << k});
  return all;
}

/// Two engines on their way to the causes of their differences.
struct Pair {
  PairCauses causes;
  std::vector<const EndpointRow*> rows;  ///< those with a value
  double largest = 0.0;                  ///< of what is shown, in margins
  bool ofReference = false;
  int available = 0, measured = 0;  ///< packings
  Case from = {}, to = {};
  std::vector<Difference<Case>> differences = {};
  bool open = true;  ///< has not met the end of the budget
};

class CausesOfPairs {
 public:
  CausesOfPairs(Campaign& campaign, const Case& setup, const RunCommand& command,
                const EndpointFindings& found, double until,
                const UndeclaredDifferences& undeclared)
      : campaign_(campaign),
        setup_(setup),
        command_(command),
        found_(found),
        until_(until),
        undeclared_(undeclared) {
    for (const InterimRow& look : found.looks.planned) looks_.push_back(look.packings);
    if (hasClosedForms(setup)) looks_ = {closedFormRuns};
  }

  std::vector<PairCauses> result() {
    plan();
    for (const int look : looks_)
      for (Pair& pair : pairs_) advance(pair, look);
    std::vector<PairCauses> all;
    for (Pair& pair : pairs_) {
      if (pair.causes.reason.empty() && pair.measured > 0) measure(pair);
      all.push_back(std::move(pair.causes));
    }
    return all;
  }

 private:
  // Pairs.

  bool isShown(const EndpointRow& row) const {
    const bool decided = row.verdict == Verdict::fail || row.verdict == Verdict::borderline;
    return (decided || row.differenceSeen()) && row.packings > 0 &&
           std::abs(row.distance.value_or(0.0)) >= leastMargins;
  }

  void plan() {
    const std::string& reference = campaign_.engines().front().name;
    for (const EndpointRow& row : found_.rows) {
      if (row.kind != PairKind::peer || !row.distance) continue;
      if (campaign_.isNeutral() != (row.a == medianName)) continue;
      const std::string a = campaign_.isNeutral() ? inHouseName() : row.a;
      if (a == row.b) continue;
      auto pair = std::ranges::find_if(
          pairs_, [&](const Pair& one) { return one.causes.a == a && one.causes.b == row.b; });
      if (pair == pairs_.end()) {
        pair = pairs_.insert(pair, Pair{});
        pair->causes.a = a;
        pair->causes.b = row.b;
        pair->ofReference = campaign_.isNeutral() || a == reference;
      }
      pair->rows.push_back(&row);
      pair->available = std::max(pair->available, row.packings + row.lost);
      if (isShown(row)) pair->largest = std::max(pair->largest, std::abs(*row.distance));
    }
    std::erase_if(pairs_, [](const Pair& pair) { return pair.largest == 0.0; });
    std::ranges::stable_sort(pairs_, std::greater(), [](const Pair& pair) {
      return std::pair(pair.ofReference, pair.largest);
    });
    for (Pair& pair : pairs_) guarded(pair, [&] { describe(pair); });
  }

  /// Why there is nothing to be measured is the pair's reason.
  void guarded(Pair& pair, const auto& work) {
    try {
      work();
    } catch (const UnsupportedScene& refusal) {
      pair.causes.reason = refusal.what();
    } catch (const EngineFailure& failure) {
      pair.causes.reason = failure.what();
    }
  }

  /// Laws of both and what tells them apart.
  void describe(Pair& pair) {
    if (std::ranges::any_of(pair.rows, [](const auto* row) { return row->unpaired.has_value(); }))
      throw UnsupportedScene("runs of files have no law that could be mixed with another");
    pair.from = asRun(pair.causes.a);
    pair.to = asRun(pair.causes.b);
    if (const auto of = undeclared_.find(pair.causes.a); of != undeclared_.end())
      for (const auto& difference : of->second) difference.take(pair.from);
    pair.differences = differencesOf(pair.from, pair.to);
    if (pair.from.law.soft() != pair.to.law.soft()) {
      const Case& rigid = pair.from.law.soft() ? pair.to : pair.from;
      CauseName& normal = pair.differences.front().words;
      (pair.from.law.soft() ? normal.to : normal.from) +=
          fmt::format(" (e_n = {:.3g}, mean over kinds of pairs)", rigid.law.en);
    }
    if (const auto of = undeclared_.find(pair.causes.b); of != undeclared_.end())
      for (Difference<Case> difference : of->second) {
        difference.take(pair.to);
        difference.words.declared = false;
        pair.differences.push_back(std::move(difference));
      }
    static_cast<Causes&>(pair.causes) = causesOf(pair.differences);
    pair.causes.remainder =
        pair.from.law.soft() && pair.to.law.soft() ? "implementation" : "solver";
    if (pair.differences.size() > mostMixed) pair.causes.mixtures = Mixtures::bothEnds;
  }

  /// Those that are run, by what pairs are compared with.
  std::set<Mixture> mixturesOf(const Pair& pair) const {
    std::set<Mixture> all = studies::mixturesOf(pair.differences.size());
    if (campaign_.isNeutral()) all.insert(0);
    return all;
  }

  static bool isInHouse(const EngineEntry& entry) {
    return entry.name == inHouseName() || !entry.mirrors.empty();
  }
  static const std::string& inHouseName() { return engineRegistry().front().name; }

  std::size_t indexOf(const std::string& name) {
    const auto engines = campaign_.engines();
    for (std::size_t e = 0; e < engines.size(); ++e)
      if (engines[e].name == name && campaign_.effective(e)) return e;
    if (name == inHouseName()) return campaign_.inHouse();
    throw EngineFailure(name + " could not be asked what it runs");
  }

  Case asRun(const std::string& name) {
    const std::size_t e = indexOf(name);
    return caseAsRun(setup_, campaign_.dt(), campaign_.engines()[e], *campaign_.capabilities(e),
                     *campaign_.effective(e));
  }

  // Runs.

  /// Of the in-house engine under its own law or as a mirror, by what they ran.
  const std::string* engineThatRan(const std::string& fingerprint) {
    if (inHouse_.empty())
      for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
        const EngineEntry& entry = campaign_.engines()[e];
        if (!isInHouse(entry) || !campaign_.effective(e)) continue;
        try {
          inHouse_.emplace(fingerprintOf(asRun(entry.name)), entry.name);
        } catch (const UnsupportedScene&) {
          // Its runs stand for no other.
        }
      }
    const auto found = inHouse_.find(fingerprint);
    return found == inHouse_.end() ? nullptr : &found->second;
  }

  /// Packings from 0 on, without the mixture's own runs where a finished one is there.
  std::map<int, const FlowRun*> runsThere(const std::string& fingerprint) {
    std::map<int, const FlowRun*> there;
    for (const auto& [id, run] : ran_)
      if (id.variant == nameOf(fingerprint)) there[id.packing] = &run;
    if (const std::string* const engine = engineThatRan(fingerprint))
      for (const FlowRun* run : finishedRuns(campaign_.runs(), *engine)) there[run->packing] = run;
    return there;
  }

  static std::string nameOf(const std::string& fingerprint) { return "mixture-" + fingerprint; }

  const std::string& keep(const Pair& pair, Mixture mixture) {
    const bool all = mixture + 1 == Mixture{1} << pair.differences.size();
    Case setup = all ? pair.to : mixed(pair.from, pair.differences, mixture);
    const std::string fingerprint = fingerprintOf(setup);
    return cases_.try_emplace(fingerprint, std::move(setup)).first->first;
  }

  /// Runs that are missing of these mixtures on the first packings.
  std::vector<PlannedRuns> missing(const Pair& pair, const std::set<Mixture>& mixtures,
                                   int packings) {
    std::vector<PlannedRuns> lists;
    std::set<std::string> seen;
    for (const Mixture mixture : mixtures) {
      const std::string& fingerprint = keep(pair, mixture);
      if (!seen.insert(fingerprint).second) continue;
      const auto there = runsThere(fingerprint);
      int first = 0;
      while (first < packings && there.contains(first)) ++first;
      if (first < packings)
        lists.push_back(
            {{{indexOf(inHouseName()), "", &cases_.at(fingerprint), nameOf(fingerprint)}},
             {first, packings}});
    }
    return lists;
  }

  /// By the in-house engine's finished runs, where there are any, and how far such a prediction was
  /// right so far.
  double secondsOf(const std::vector<PlannedRuns>& lists) const {
    double wall = 0.0, steps = 0.0, seconds = 0.0;
    const auto add = [&](const FlowRun& run) {
      if (!run.finished() || !run.stats) return;
      wall += run.stats->wallSeconds;
      steps += static_cast<double>(run.stats->steps);
    };
    for (const EngineEntry& entry : campaign_.engines())
      for (const FlowRun& run : campaign_.runs())
        if (isInHouse(entry) && run.engine == entry.name) add(run);
    for (const auto& [id, run] : ran_) add(run);
    if (steps == 0.0) return campaign_.secondsOf(lists) * pace_;
    for (const PlannedRuns& list : lists)
      seconds += static_cast<double>(campaign_.missingRuns(list)) * wall / steps *
                 flowDuration(setup_) / stepOf(*list.variants.front().setup);
    return seconds / std::max(command_.jobs, 1) * pace_;
  }

  static double stepOf(const Case& setup) {
    return std::get<double>(setup.engines.at(inHouseName()).at("dt"));
  }

  void run(const std::vector<PlannedRuns>& lists) {
    if (lists.empty()) return;
    int packings = 0;
    for (const PlannedRuns& list : lists) packings = std::max(packings, list.packings.to);
    campaign_.preparePackings(packings);
    const double before = campaign_.elapsed(), predicted = secondsOf(lists);
    ran_.merge(campaign_.runSome(lists, "measuring causes of differences"));
    if (predicted > 0.0) pace_ *= std::max(1.0, (campaign_.elapsed() - before) / predicted);
  }

  void advance(Pair& pair, int look) {
    const int packings = std::min(look, pair.available);
    if (!pair.open || !pair.causes.reason.empty() || packings <= pair.measured) return;
    guarded(pair, [&] {
      const auto mixtures = mixturesOf(pair);
      const std::vector<PlannedRuns> lists = missing(pair, mixtures, packings);
      const bool free = std::ranges::all_of(
          lists, [&](const PlannedRuns& list) { return campaign_.missingRuns(list) == 0; });
      if (!free && campaign_.elapsed() + secondsOf(lists) > until_) {
        pair.open = false;
        pair.causes.missing = secondsOf(missing(pair, mixtures, pair.available));
        return;
      }
      run(lists);
      pair.measured = packings;
    });
  }

  // Numbers.

  /// Finished ones of a mixture on the packings that were measured.
  Runs runsOf(const Pair& pair, Mixture mixture) {
    const std::string& fingerprint = keep(pair, mixture);
    run(missing(pair, {mixture}, pair.measured));
    Runs runs;
    for (const auto& [packing, run] : runsThere(fingerprint))
      if (packing < pair.measured && run->finished()) runs.push_back(run);
    return runs;
  }

  Runs runsOf(const Pair& pair, const std::string& engine) const {
    Runs runs = runsFor(campaign_.runs(), engine, found_.surrogates);
    std::erase_if(runs, [&](const FlowRun* run) { return run->packing >= pair.measured; });
    return runs;
  }

  PairedTest testOf(const Pair& pair, const EndpointRow& row, const Runs& a, const Runs& b) const {
    const Endpoint& endpoint = endpointNamed(setup_, row.endpoint);
    const auto packings = static_cast<std::size_t>(pair.measured);
    return testedEndpoint(endpoint, setup_.averaging.endpoints.at(row.endpoint),
                          endpointByPacking(endpoint, setup_, a, packings),
                          endpointByPacking(endpoint, setup_, b, packings));
  }

  void measure(Pair& pair) {
    guarded(pair, [&] {
      const Runs a = campaign_.isNeutral() ? runsOf(pair, Mixture{0}) : runsOf(pair, pair.causes.a),
                 b = runsOf(pair, pair.causes.b);
      AttributionPlan plan{pair.differences.size(), mostMixed, false};
      for (const EndpointRow* row : pair.rows)
        plan.units.insert(plan.units.end(), static_cast<std::size_t>(pair.measured),
                          testOf(pair, *row, a, a).sample.margin);
      const auto numbersOf = [&](const Runs& runs) {
        Numbers numbers;
        for (const EndpointRow* row : pair.rows)
          std::ranges::copy(testOf(pair, *row, a, runs).sample.other, std::back_inserter(numbers));
        return numbers;
      };
      const auto parts = attribute(plan, [&](Mixture mixture) -> std::optional<Numbers> {
        return pair.differences.empty() ? Numbers(plan.units.size(), 0.0)
                                        : numbersOf(runsOf(pair, mixture));
      });
      pair.causes.mixtures = parts->mixtures;
      for (std::size_t r = 0; r < pair.rows.size(); ++r)
        if (auto own = endpointCauses(pair, *pair.rows[r], testOf(pair, *pair.rows[r], a, b),
                                      *parts, r * static_cast<std::size_t>(pair.measured)))
          pair.causes.endpoints.push_back(std::move(*own));
      count(pair);
      if (pair.causes.endpoints.empty()) pair.causes.reason = whyNothing(pair);
    });
  }

  void count(Pair& pair) {
    std::set<std::string> names;
    for (const Mixture mixture : mixturesOf(pair)) names.insert(nameOf(keep(pair, mixture)));
    for (const auto& [id, run] : ran_)
      if (names.contains(id.variant)) {
        ++pair.causes.runs;
        if (run.stats) pair.causes.cpuSeconds += run.stats->cpuSeconds;
      }
  }

  std::string whyNothing(const Pair& pair) {
    for (const Mixture mixture : mixturesOf(pair))
      for (const auto& [packing, run] : runsThere(keep(pair, mixture)))
        if (!run->finished()) return run->reason;
    return "no packing has a value under all mixtures of both laws";
  }

  /// @param from  of the endpoint's numbers among all
  std::optional<EndpointCauses> endpointCauses(const Pair& pair, const EndpointRow& row,
                                               const PairedTest& test, const Attribution& found,
                                               std::size_t from) const {
    const std::size_t k = found.parts.size();
    std::vector<std::vector<double>> values(k + 3);  // whole, parts, interaction, remainder
    for (std::size_t p = 0; p < static_cast<std::size_t>(pair.measured); ++p) {
      const auto &a = test.sample.reference[p], &b = test.sample.other[p];
      bool all = a && b && found.interaction[from + p];
      for (const Numbers& part : found.parts) all = all && part[from + p];
      if (!all) continue;
      double left = *b - *a;
      values[0].push_back(left);
      for (std::size_t i = 0; i <= k; ++i) {
        values[i + 1].push_back(*(i < k ? found.parts[i] : found.interaction)[from + p]);
        left -= values[i + 1].back();
      }
      values[k + 2].push_back(left);
    }
    if (values[0].empty()) return std::nullopt;
    const double whole = ensembleMean(Numbers(values[0].begin(), values[0].end()))->mean;
    const double factor = !test.logarithmic ? 1.0
                          : whole == 0.0    ? std::abs(test.reference)
                                            : inUnit(test, whole) / whole;
    const auto part = [&](std::size_t i, double bound = 0.0) {
      const PairedSample sample{Numbers(values[i].size(), 0.0),
                                Numbers(values[i].begin(), values[i].end()),
                                0.0,
                                0.0,
                                {}};
      const auto mean = comparePaired({&sample, 1}, 1.0 - level()).front();
      const auto made = [&](double value) { return i == 0 ? inUnit(test, value) : factor * value; };
      if (!mean->low || (mean->packings < fewestPackings && !hasClosedForms(setup_)))
        return CausePart{made(mean->difference), {}, {}};
      return CausePart{made(mean->difference), made(*mean->low - bound), made(*mean->high + bound)};
    };
    const double bound = row.bound.value_or(0.0) * test.sample.margin;
    EndpointCauses own{row.endpoint,      row.unit, static_cast<int>(values[0].size()),
                       part(0, bound),    {},       part(k + 1),
                       part(k + 2, bound)};
    for (std::size_t i = 1; i <= k; ++i) own.parts.push_back(part(i));
    return own;
  }

  double level() const {
    return found_.looks.agreeAlpha.value_or(1.0 - setup_.averaging.confidence);
  }

  Campaign& campaign_;
  const Case& setup_;
  const RunCommand& command_;
  const EndpointFindings& found_;
  double until_;
  const UndeclaredDifferences& undeclared_;
  std::vector<int> looks_;
  std::vector<Pair> pairs_;
  std::map<std::string, std::string> inHouse_;  ///< engines by the fingerprint of what they run
  std::map<std::string, Case> cases_;           ///< mixtures by their fingerprints
  RunsById ran_;
  double pace_ = 1.0;  ///< time that runs took, of what was predicted
};

}  // namespace

std::vector<PairCauses> causesOfPairs(Campaign& campaign, const Case& setup,
                                      const RunCommand& command, const EndpointFindings& found,
                                      double until, const UndeclaredDifferences& undeclared) {
  return CausesOfPairs(campaign, setup, command, found, until, undeclared).result();
}

}  // namespace crossgrain::inline studies
