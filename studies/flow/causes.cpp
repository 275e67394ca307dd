#include "studies/flow/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "adapters/declared_law.hpp"
#include "averaging/pocock.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "cases/materials.hpp"
#include "studies/causes/changes.hpp"
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

/// Two engines on their way to the causes of their differences.
struct Pair {
  PairCauses causes;
  std::vector<const EndpointRow*> rows;  ///< those with a value
  double largest = 0.0;                  ///< of what is shown, in margins
  bool ofReference = false;
  int available = 0, measured = 0;  ///< packings
  Case from = {}, to = {};
  std::vector<Difference<Case>> differences = {};
};

class CausesOfPairs {
 public:
  CausesOfPairs(Campaign& campaign, const Case& setup, const RunCommand& command,
                const EndpointFindings& found, double until, const UndeclaredTerms& undeclared)
      : campaign_(campaign),
        setup_(setup),
        command_(command),
        found_(found),
        until_(until),
        undeclared_(undeclared) {
    const double alpha = 1.0 - setup.averaging.confidence;
    for (const InterimRow& look : found.looks.planned) looks_.push_back(look.packings);
    if (hasClosedForms(setup)) looks_ = {closedFormRuns};
    level_ = found.looks.agreeAlpha.value_or(alpha);
    if (looks_.front() <= fewestPackings) return;
    looks_.insert(looks_.begin(), fewestPackings);
    level_ = pocockLevel(static_cast<int>(looks_.size()), alpha);
  }

  std::vector<PairCauses> result() {
    plan();
    if (!pairs_.empty()) takeVerdictsRuns();
    for (const int look : looks_)
      for (Pair& pair : pairs_) advance(pair, look);
    std::vector<PairCauses> all;
    for (Pair& pair : pairs_) {
      if (pair.causes.reason.empty() && pair.measured > 0) guarded(pair, [&] { measure(pair); });
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

  /// In what lockstep found an engine's law to be another than that of the case as it declares to
  /// run it.
  std::vector<Difference<Case>> undeclaredIn(const Case& own, const std::string& engine) {
    const auto term = undeclared_.find(engine);
    if (term == undeclared_.end()) return {};
    return inDimensionOf(own, [&]<int D>() {
      SceneOf<D> scene = unplacedScene<D>(own, campaign_.dt());
      for (const MirrorChangeOf<D>& change :
           changesOf(scene, engineRegistry().front().make()->capabilities()))
        if (change.name == term->second.name)
          change.apply(scene, term->second.amount.value_or(0.0));
      return lawDifferences<Case>(own.law, scene.law);
    });
  }

  /// Laws of both and in what they differ.
  void describe(Pair& pair) {
    if (std::ranges::any_of(pair.rows, [](const auto* row) { return row->unpaired.has_value(); }))
      throw UnsupportedScene("runs of files have no law that could be mixed with another");
    pair.from = asRun(pair.causes.a);
    pair.to = asRun(pair.causes.b);
    for (const auto& difference : undeclaredIn(pair.from, pair.causes.a))
      difference.take(pair.from);
    pair.differences = differencesOf(pair.from, pair.to);
    if (pair.from.law.soft() != pair.to.law.soft()) {
      const Case& rigid = pair.from.law.soft() ? pair.to : pair.from;
      CauseName& normal = pair.differences.front().words;
      (pair.from.law.soft() ? normal.to : normal.from) +=
          fmt::format(" (e_n = {:.3g}, mean over kinds of pairs)", rigid.law.en);
    }
    for (Difference<Case>& difference : undeclaredIn(pair.to, pair.causes.b)) {
      difference.take(pair.to);
      difference.words.declared = false;
      pair.differences.push_back(std::move(difference));
    }
    static_cast<Causes&>(pair.causes) = causesOf(pair.differences);
    std::ranges::copy_if(pair.causes.differences, std::back_inserter(pair.causes.undeclared),
                         [](const CauseName& one) { return !one.declared; });
    pair.causes.remainder =
        pair.from.law.soft() && pair.to.law.soft() ? "implementation" : "solver";
    if (pair.differences.size() > mostMixed) pair.causes.mixtures = Mixtures::bothEnds;
  }

  /// Those that are run: where laws do not differ none, but for a neutral campaign's reference.
  std::set<Mixture> mixturesOf(const Pair& pair) const {
    if (pair.differences.empty() && !campaign_.isNeutral()) return {};
    return studies::mixturesOf(pair.differences.size(), mostMixed);
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

  /// Takes the verdicts' own runs for mixtures that are the in-house engine's law, or a mirror's.
  void takeVerdictsRuns() {
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e) {
      const EngineEntry& entry = campaign_.engines()[e];
      if ((entry.name != inHouseName() && entry.mirrors.empty()) || !campaign_.effective(e))
        continue;
      try {
        auto& there = there_[fingerprintOf(asRun(entry.name))];
        for (const FlowRun* run : finishedRuns(campaign_.runs(), entry.name))
          there.emplace(run->packing, run);
      } catch (const UnsupportedScene&) {
        // They stand for no other.
      }
    }
  }

  const std::string& fingerprint(const Pair& pair, Mixture mixture) {
    Case setup = mixed(pair.from, pair.to, pair.differences, mixture);
    return cases_.try_emplace(fingerprintOf(setup), std::move(setup)).first->first;
  }

  /// Runs that are to be made, by mixture.
  struct Block {
    std::map<std::string, PlannedRuns> lists;
    double seconds = 0.0;  ///< 0: all are finished
  };

  /// Of these mixtures on the first packings, all but what is there. Seconds are those that runs so
  /// far took step by step, before any by a timing, times what such a prediction was wrong by.
  Block blockOf(const Pair& pair, const std::set<Mixture>& mixtures, int packings) {
    Block block;
    double wall = 0.0, steps = 0.0;
    for (const auto& [law, runs] : there_)
      for (const auto& [packing, run] : runs) {
        if (!run->finished() || !run->stats) continue;
        wall += run->stats->wallSeconds;
        steps += static_cast<double>(run->stats->steps);
      }
    for (const Mixture mixture : mixtures) {
      const std::string& law = fingerprint(pair, mixture);
      int first = 0;
      while (there_[law].contains(first)) ++first;
      if (first >= packings || block.lists.contains(law)) continue;
      const Case& setup = cases_.at(law);
      const PlannedRuns list{{{indexOf(inHouseName()), "", &setup, "mixture-" + law}},
                             {first, packings}};
      const auto missing = static_cast<double>(campaign_.missingRuns(list));
      const double dt = std::get<double>(setup.engines.at(inHouseName()).at("dt"));
      const double each = steps > 0.0 ? wall / steps * flowDuration(setup_) / dt
                                      : campaign_.secondsOf({list}) / std::max(missing, 1.0);
      block.seconds += missing * each * pace_ / std::max(command_.jobs, 1);
      block.lists.emplace(law, list);
    }
    return block;
  }

  void run(const Block& block) {
    if (block.lists.empty()) return;
    std::vector<PlannedRuns> lists;
    int packings = 0;
    for (const auto& [law, list] : block.lists) {
      lists.push_back(list);
      packings = std::max(packings, list.packings.to);
    }
    campaign_.preparePackings(packings);
    const double before = campaign_.elapsed();
    ran_.merge(campaign_.runSome(lists, "measuring causes of differences"));
    if (block.seconds > 0.0) pace_ *= std::max(1.0, (campaign_.elapsed() - before) / block.seconds);
    for (const auto& [law, list] : block.lists)
      for (int k = list.packings.from; k < packings; ++k)
        there_[law].emplace(k, &ran_.at({inHouseName(), "mixture-" + law, k}));
  }

  void advance(Pair& pair, int look) {
    const int packings = std::min(look, pair.available);
    if (pair.causes.missing || !pair.causes.reason.empty() || packings <= pair.measured) return;
    guarded(pair, [&] {
      const auto mixtures = mixturesOf(pair);
      const Block block = blockOf(pair, mixtures, packings);
      if (block.seconds > 0.0 && campaign_.elapsed() + block.seconds > until_) {
        pair.causes.missing = blockOf(pair, mixtures, pair.available).seconds;
        return;
      }
      run(block);
      pair.measured = packings;
    });
  }

  // Numbers.

  /// Finished ones of a mixture on the packings that were measured.
  Runs runsOf(const Pair& pair, Mixture mixture) {
    run(blockOf(pair, {mixture}, pair.measured));
    Runs runs;
    for (const auto& [packing, run] : there_[fingerprint(pair, mixture)])
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
    const auto packings = static_cast<std::size_t>(pair.measured);
    const Runs a = campaign_.isNeutral() ? runsOf(pair, Mixture{0}) : runsOf(pair, pair.causes.a),
               b = runsOf(pair, pair.causes.b);
    AttributionPlan plan{pair.differences.size(), mostMixed, false};
    for (const EndpointRow* row : pair.rows)
      plan.units.insert(plan.units.end(), packings, testOf(pair, *row, a, a).sample.margin);
    const auto parts = attribute(plan, [&](Mixture mixture) -> std::optional<Numbers> {
      if (pair.differences.empty()) return Numbers(plan.units.size(), 0.0);
      const Runs runs = runsOf(pair, mixture);
      Numbers numbers;
      for (const EndpointRow* row : pair.rows)
        std::ranges::copy(testOf(pair, *row, a, runs).sample.other, std::back_inserter(numbers));
      return numbers;
    });
    pair.causes.mixtures = parts->mixtures;
    for (std::size_t r = 0; r < pair.rows.size(); ++r)
      if (auto own = endpointCauses(pair, *pair.rows[r], testOf(pair, *pair.rows[r], a, b), *parts,
                                    r * packings))
        pair.causes.endpoints.push_back(std::move(*own));
    sumUp(pair);
  }

  /// Says how many runs it took, and why nothing came out.
  void sumUp(Pair& pair) {
    std::string failure = "no packing has a value under all mixtures of both laws";
    std::set<std::string> names;
    for (const Mixture mixture : mixturesOf(pair))
      names.insert("mixture-" + fingerprint(pair, mixture));
    for (const auto& [id, run] : ran_) {
      if (!names.contains(id.variant)) continue;
      ++pair.causes.runs;
      if (run.stats) pair.causes.cpuSeconds += run.stats->cpuSeconds;
      if (!run.finished()) failure = run.reason;
    }
    if (pair.causes.endpoints.empty()) pair.causes.reason = failure;
  }

  /// @param from  of the endpoint's numbers among all
  std::optional<EndpointCauses> endpointCauses(const Pair& pair, const EndpointRow& row,
                                               const PairedTest& test, const Attribution& found,
                                               std::size_t from) const {
    const std::size_t k = found.parts.size();
    std::vector<Numbers> values(k + 3);  // whole, parts, interaction, remainder
    for (std::size_t p = 0; p < static_cast<std::size_t>(pair.measured); ++p) {
      const auto &a = test.sample.reference[p], &b = test.sample.other[p];
      bool all = a && b && found.interaction[from + p];
      for (const Numbers& part : found.parts) all = all && part[from + p];
      if (!all) continue;
      double left = *b - *a;
      values[0].emplace_back(left);
      for (std::size_t i = 0; i <= k; ++i) {
        values[i + 1].push_back((i < k ? found.parts[i] : found.interaction)[from + p]);
        left -= *values[i + 1].back();
      }
      values[k + 2].emplace_back(left);
    }
    if (values[0].empty()) return std::nullopt;
    const double whole = ensembleMean(values[0])->mean;
    const double factor = !test.logarithmic ? 1.0
                          : whole == 0.0    ? std::abs(test.reference)
                                            : inUnit(test, whole) / whole;
    const auto part = [&](std::size_t i, double bound = 0.0) {
      const PairedSample sample{Numbers(values[i].size(), 0.0), values[i], 0.0, 0.0, {}};
      const auto mean = *comparePaired({&sample, 1}, 1.0 - level_).front();
      const auto made = [&](double value) { return i == 0 ? inUnit(test, value) : factor * value; };
      CausePart own{made(mean.difference), {}, {}};
      if (mean.low && (mean.packings >= fewestPackings || hasClosedForms(setup_))) {
        own.low = made(*mean.low - bound);
        own.high = made(*mean.high + bound);
      }
      return own;
    };
    const double bound = row.bound.value_or(0.0) * test.sample.margin;
    EndpointCauses own{row.endpoint,      row.unit, static_cast<int>(values[0].size()),
                       part(0, bound),    {},       part(k + 1),
                       part(k + 2, bound)};
    for (std::size_t i = 1; i <= k; ++i) own.parts.push_back(part(i));
    return own;
  }

  Campaign& campaign_;
  const Case& setup_;
  const RunCommand& command_;
  const EndpointFindings& found_;
  double until_;
  const UndeclaredTerms& undeclared_;
  std::vector<int> looks_;  ///< packings, in steps
  double level_ = 0.0;      ///< of intervals, at each
  std::vector<Pair> pairs_;
  std::map<std::string, Case> cases_;  ///< mixtures by their fingerprints
  RunsById ran_;
  /// All runs of the in-house engine, by the fingerprint of what it ran, and packing.
  std::map<std::string, std::map<int, const FlowRun*>> there_;
  double pace_ = 1.0;  ///< time that runs took, of what was predicted
};

}  // namespace

std::vector<PairCauses> causesOfPairs(Campaign& campaign, const Case& setup,
                                      const RunCommand& command, const EndpointFindings& found,
                                      double until, const UndeclaredTerms& undeclared) {
  return CausesOfPairs(campaign, setup, command, found, until, undeclared).result();
}

}  // namespace crossgrain::inline studies
