#include "studies/flow/causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "adapters/declared_law.hpp"
#include "averaging/fields.hpp"
#include "averaging/pocock.hpp"
#include "averaging/statistics.hpp"
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
/// Of more, runs of ensembles of packings take too long.
constexpr std::size_t mostMixedInFlows = 2;

/// The case for the in-house engine to run with a scene's laws, effects and time step.
template <int D>
Case caseAs(Case setup, const SceneOf<D>& scene) {
  setup.law = scene.law;
  if (!scene.materials)
    setup.materials.reset();
  else
    setup.materials->laws = scene.materials->laws;
  setup.bottom = scene.bottom;
  if (isAssembly(setup)) {
    assemblyIn<D>(setup).rotation = scene.rotation;
    assemblyIn<D>(setup).gravity = scene.gravity;
  } else {
    couetteIn(setup).particles.rotation = scene.rotation;
  }
  Settings& settings = setup.engines[engineRegistry().front().name];
  settings.erase("stiffness");
  settings["dt"] = scene.dt;
  setup.run.keepSnapshots = 0;
  return setup;
}

}  // namespace

template <int D>
SceneOf<D> sceneAsRun(const Case& setup, double dt, const EngineEntry& entry,
                      const Capabilities& can, const EffectiveParameters& effective) {
  SceneOf<D> scene = sceneFor(can, entry, setup, unplacedScene<D>(setup, dt)).scene;
  if (effectsOf(unplacedScene<D>(caseAs<D>(setup, scene), dt)) != effectsOf(scene))
    throw UnsupportedScene(entry.name + " lacks an effect that no case can leave out");
  changeLaws(scene, [&](ContactLaw& law) {
    const auto declared = declaredLaw(can, law, effective);
    if (!declared)
      throw UnsupportedScene(entry.name +
                             " has another normal law, whose constants it does not report");
    law = *declared;
  });
  scene.dt = effective.dt;
  return scene;
}
template Scene sceneAsRun<2>(const Case&, double, const EngineEntry&, const Capabilities&,
                             const EffectiveParameters&);
template SpaceScene sceneAsRun<3>(const Case&, double, const EngineEntry&, const Capabilities&,
                                  const EffectiveParameters&);

namespace {

/// Two engines on their way to the causes of their differences.
template <int D>
struct PairOf {
  PairCauses causes;
  std::vector<const EndpointRow*> rows;  ///< those with a value
  double largest = 0.0;                  ///< of what is shown, in margins
  bool ofReference = false;
  int available = 0, measured = 0;  ///< packings
  SceneOf<D> from = {}, to = {};
  std::vector<DifferenceOf<D>> differences = {};
};

template <int D>
class CausesOfPairs {
  using Pair = PairOf<D>;

 public:
  CausesOfPairs(Campaign& campaign, const Case& setup, const RunCommand& command,
                const EndpointFindings& found, double until, const UndeclaredTerms& undeclared,
                std::string field)
      : campaign_(campaign),
        setup_(setup),
        command_(command),
        found_(found),
        until_(until),
        undeclared_(undeclared),
        field_(std::move(field)) {
    const double alpha = 1.0 - setup.averaging.confidence;
    for (const InterimRow& look : found.looks.planned) looks_.push_back(look.packings);
    if (hasClosedForms(setup)) {
      looks_ = {closedFormRuns};
      mostMixed_ = AttributionPlan().mostMixed;
    }
    level_ = found.looks.agreeAlpha.value_or(alpha);
    if (looks_.front() > fewestPackings) {
      looks_.insert(looks_.begin(), fewestPackings);
      level_ = pocockLevel(static_cast<int>(looks_.size()), alpha);
    }
    partsLevel_ = 2.0 * pocockLevel(static_cast<int>(looks_.size()), 0.5 * alpha);
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
    std::erase_if(pairs_, [&](const Pair& pair) {
      return pair.largest == 0.0 && (field_.empty() || !pair.ofReference);
    });
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

  /// In what lockstep found an engine's law to be another than that of the scene as it declares to
  /// run it.
  std::vector<AppliedChangeOf<D>> undeclaredIn(const SceneOf<D>& own, const std::string& engine) {
    const auto term = undeclared_.find(engine);
    auto changes = changesNamed<D>(term == undeclared_.end() ? nullptr : &term->second, own,
                                   engineRegistry().front().make()->capabilities());
    std::erase_if(changes, [&](const AppliedChangeOf<D>& one) {
      return lawDifferences<D>(own.law, withChanges<D>(own, {one}).law).empty();
    });
    return changes;
  }

  /// Laws of both and in what they differ.
  void describe(Pair& pair) {
    if (std::ranges::any_of(pair.rows, [](const auto* row) { return row->unpaired.has_value(); }))
      throw UnsupportedScene("runs of files have no law that could be mixed with another");
    pair.from = asRun(pair.causes.a);
    pair.from = withChanges(pair.from, undeclaredIn(pair.from, pair.causes.a));
    const SceneOf<D> declared = asRun(pair.causes.b);
    auto behaviour = behaviourOf<D>(pair.from, declared, undeclaredIn(declared, pair.causes.b));
    pair.to = std::move(behaviour.scene);
    pair.differences = std::move(behaviour.differences);
    static_cast<Causes&>(pair.causes) = std::move(behaviour.causes);
    if (pair.from.law.soft() != pair.to.law.soft()) {
      const bool toRigid = pair.from.law.soft();
      CauseName& normal = pair.causes.differences.front();
      (toRigid ? normal.to : normal.from) += fmt::format(
          " (e_n = {:.3g}, mean over kinds of pairs)", (toRigid ? pair.to : pair.from).law.en);
    }
    pair.causes.remainder =
        pair.from.law.soft() && pair.to.law.soft() ? "implementation" : "solver";
    if (pair.differences.size() > mostMixed_) pair.causes.mixtures = Mixtures::bothEnds;
  }

  /// Those that are run: where laws do not differ none, but for a neutral campaign's reference.
  std::set<Mixture> mixturesOf(const Pair& pair) const {
    if (pair.differences.empty() && !campaign_.isNeutral()) return {};
    return studies::mixturesOf(pair.differences.size(), mostMixed_);
  }

  static const std::string& inHouseName() { return engineRegistry().front().name; }

  std::size_t indexOf(const std::string& name) {
    const auto engines = campaign_.engines();
    for (std::size_t e = 0; e < engines.size(); ++e)
      if (engines[e].name == name && campaign_.effective(e)) return e;
    if (name == inHouseName()) return campaign_.inHouse();
    throw EngineFailure(name + " could not be asked what it runs");
  }

  SceneOf<D> asRun(const std::string& name) {
    const std::size_t e = indexOf(name);
    return sceneAsRun<D>(setup_, campaign_.dt(), campaign_.engines()[e], *campaign_.capabilities(e),
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
        auto& there = there_[fingerprintOf<D>(asRun(entry.name))];
        for (const FlowRun* run : finishedRuns(campaign_.runs(), entry.name))
          there.emplace(run->packing, run);
      } catch (const UnsupportedScene&) {
        // They stand for no other.
      }
    }
  }

  const std::string& fingerprint(const Pair& pair, Mixture mixture) {
    const SceneOf<D> scene = mixed<D>(pair.from, pair.to, pair.differences, mixture);
    return cases_.try_emplace(fingerprintOf<D>(scene), caseAs<D>(setup_, scene)).first->first;
  }

  /// Runs that are to be made, by mixture.
  struct Block {
    std::map<std::string, PlannedRuns> lists;
    double seconds = 0.0;  ///< 0: all are finished
  };

  /// Of one run of a mixture [s]: what its runs so far took, before any by a timing of its steps,
  /// as laws may take some hundred times as long as others (rigid ones in a dense cell).
  double secondsOf(const std::string& law, const Case& setup) {
    std::vector<double> took;
    for (const auto& [packing, run] : there_[law])
      if (run->finished() && run->stats) took.push_back(run->stats->wallSeconds);
    if (!took.empty()) return estimateMean(took).mean;
    const auto [at, isNew] = timed_.try_emplace(law, 0.0);
    if (isNew) at->second = campaign_.predictedSeconds(indexOf(inHouseName()), setup);
    return at->second;
  }

  /// Of these mixtures on the first packings, all but what is there. Seconds are times what such a
  /// prediction was wrong by.
  Block blockOf(const Pair& pair, const std::set<Mixture>& mixtures, int packings) {
    Block block;
    for (const Mixture mixture : mixtures) {
      const std::string& law = fingerprint(pair, mixture);
      int first = 0;
      while (there_[law].contains(first)) ++first;
      if (first >= packings || block.lists.contains(law)) continue;
      const Case& setup = cases_.at(law);
      const PlannedRuns list{{{indexOf(inHouseName()), "", &setup, "mixture-" + law}},
                             {first, packings}};
      const auto missing = static_cast<double>(campaign_.missingRuns(list));
      if (missing > 0.0)
        block.seconds += missing * secondsOf(law, setup) * pace_ / std::max(command_.jobs, 1);
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

  /// A number of a run whose difference is taken apart.
  struct Quantity {
    std::string name, unit;
    std::optional<std::size_t> bin;  ///< of a field
    double bound;                    ///< of what a mirror in an engine's place may hide, in margins
    std::function<PairedTest(const Runs& a, const Runs& b)> test;
  };

  std::vector<Quantity> quantitiesOf(const Pair& pair, const Runs& a) const {
    const auto packings = static_cast<std::size_t>(pair.measured);
    std::vector<Quantity> all;
    for (const EndpointRow* row : pair.rows)
      all.push_back({row->endpoint,
                     row->unit,
                     {},
                     row->bound.value_or(0.0),
                     [this, row, packings](const Runs& one, const Runs& other) {
                       const Endpoint& endpoint = endpointNamed(setup_, row->endpoint);
                       return testedEndpoint(endpoint, setup_.averaging.endpoints.at(row->endpoint),
                                             endpointByPacking(endpoint, setup_, one, packings),
                                             endpointByPacking(endpoint, setup_, other, packings));
                     }});
    const auto valuesIn = [=, this](const Runs& runs) {
      return fieldByRing(runs, setup_.averaging.methods.front(), field_, packings);
    };
    for (std::size_t bin = 0; bin < valuesIn(a).size(); ++bin)
      all.push_back({field_, std::string(findField(field_)->unit), bin, 0.0,
                     [=](const Runs& one, const Runs& other) {
                       const auto ours = valuesIn(one), theirs = valuesIn(other);
                       const Numbers none(packings);
                       return PairedTest{{bin < ours.size() ? ours[bin] : none,
                                          bin < theirs.size() ? theirs[bin] : none,
                                          0.0,
                                          0.0,
                                          {}}};
                     }});
    return all;
  }

  void measure(Pair& pair) {
    const auto packings = static_cast<std::size_t>(pair.measured);
    const Runs a = campaign_.isNeutral() ? runsOf(pair, Mixture{0}) : runsOf(pair, pair.causes.a),
               b = runsOf(pair, pair.causes.b);
    const std::vector<Quantity> quantities = quantitiesOf(pair, a);
    Causes found = pair.causes;  // what interacts on one packing is chaos
    const auto parts =
        attribute(found, {mostMixed_, false}, [&](Mixture mixture) -> std::optional<Numbers> {
          if (pair.differences.empty()) return Numbers(quantities.size() * packings, 0.0);
          const Runs runs = runsOf(pair, mixture);
          Numbers numbers;
          for (const Quantity& one : quantities)
            std::ranges::copy(one.test(a, runs).sample.other, std::back_inserter(numbers));
          return numbers;
        });
    pair.causes.mixtures = found.mixtures;
    std::vector<Parts> endpoints, bins;
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      Parts own{&quantities[q], quantities[q].test(a, b), {}};
      own.values = valuesOf(own.test, *parts, q * packings);
      if (!own.values.front().empty())
        (quantities[q].bin ? bins : endpoints).push_back(std::move(own));
    }
    pair.causes.endpoints = withIntervals(endpoints, found.mixtures);
    pair.causes.profile = withIntervals(bins, found.mixtures);
    sumUp(pair);
  }

  /// A quantity's whole difference, its parts, interaction and remainder, on the scale of its test,
  /// by packings that have all of them.
  struct Parts {
    const Quantity* of;
    PairedTest test;
    std::vector<Numbers> values;
  };

  /// @param from  of the quantity's numbers among all
  static std::vector<Numbers> valuesOf(const PairedTest& test, const Attribution& found,
                                       std::size_t from) {
    std::vector<const Numbers*> parts;
    for (const Numbers& part : found.parts) parts.push_back(&part);
    parts.push_back(&found.interaction);
    std::vector<Numbers> values(parts.size() + 2);
    for (std::size_t p = 0; p < test.sample.reference.size(); ++p) {
      const auto &a = test.sample.reference[p], &b = test.sample.other[p];
      if (!a || !b || std::ranges::any_of(parts, [&](auto* part) { return !(*part)[from + p]; }))
        continue;
      double left = *b - *a;
      values.front().emplace_back(left);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        values[i + 1].push_back((*parts[i])[from + p]);
        left -= *values[i + 1].back();
      }
      values.back().emplace_back(left);
    }
    return values;
  }

  /// Means over packings with intervals: of wholes those of the verdicts, of all parts those of one
  /// family. Several parts of several quantities are as many chances to name one by accident, as
  /// several endpoints are to find two engines different, and so have the same cure.
  std::vector<EndpointCauses> withIntervals(const std::vector<Parts>& all,
                                            Mixtures mixtures) const {
    std::vector<PairedSample> wholes, parts;
    for (const Parts& own : all)
      for (std::size_t i = 0; i < own.values.size(); ++i) {
        const bool none = i + 2 == own.values.size() && mixtures == Mixtures::all;  // interaction
        const Numbers& values = own.values[i];
        (i == 0 ? wholes : parts)
            .push_back({none ? Numbers() : Numbers(values.size(), 0.0),
                        none ? Numbers() : values,
                        0.0,
                        0.0,
                        {}});
      }
    const double confidence = 1.0 - partsLevel_;
    const auto foundWholes = comparePaired(wholes, 1.0 - level_),
               foundParts = comparePaired(parts, confidence);
    const auto halves = smallestSignificant(foundParts, confidence);
    std::vector<EndpointCauses> causes;
    std::size_t next = 0;  // of the parts
    for (std::size_t q = 0; q < all.size(); ++q) {
      const auto& [quantity, test, values] = all[q];
      const double whole = foundWholes[q]->difference;
      const double factor = !test.logarithmic ? 1.0
                            : whole == 0.0    ? std::abs(test.reference)
                                              : inUnit(test, whole) / whole;
      const auto part = [&](const std::optional<PairedComparison>& found,
                            std::optional<double> half, double bound, const auto& made) {
        if (!found) return CausePart{0.0, 0.0, 0.0};  // no interaction
        CausePart own{made(found->difference), {}, {}};
        if (!half && found->low && hasClosedForms(setup_)) half = found->difference - *found->low;
        if (half) own.low = made(found->difference - *half - bound);
        if (half) own.high = made(found->difference + *half + bound);
        return own;
      };
      const auto nextPart = [&](double bound = 0.0) {
        const std::size_t k = next++;
        return part(foundParts[k], halves[k], bound, [=](double value) { return factor * value; });
      };
      std::optional<double> half;
      if (foundWholes[q]->packings >= fewestPackings) half = whole - *foundWholes[q]->low;
      const double bound = quantity->bound * test.sample.margin;
      EndpointCauses& own = causes.emplace_back();
      own.endpoint = quantity->name;
      own.unit = quantity->unit;
      own.bin = quantity->bin;
      own.packings = foundWholes[q]->packings;
      own.whole =
          part(foundWholes[q], half, bound, [&](double value) { return inUnit(test, value); });
      for (std::size_t i = 0; i + 3 < values.size(); ++i) own.parts.push_back(nextPart());
      own.interaction = nextPart();
      own.remainder = nextPart(bound);
    }
    return causes;
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

  Campaign& campaign_;
  const Case& setup_;
  const RunCommand& command_;
  const EndpointFindings& found_;
  double until_;
  const UndeclaredTerms& undeclared_;
  std::string field_;       ///< to be taken apart bin by bin; empty: none
  std::vector<int> looks_;  ///< packings, in steps
  std::size_t mostMixed_ = mostMixedInFlows;
  /// At each, of one tail of wholes' intervals and of both tails of all parts together.
  double level_ = 0.0, partsLevel_ = 0.0;
  std::vector<Pair> pairs_;
  std::map<std::string, Case> cases_;  ///< mixtures by their fingerprints
  RunsById ran_;
  /// All runs of the in-house engine, by the fingerprint of what it ran, and packing.
  std::map<std::string, std::map<int, const FlowRun*>> there_;
  std::map<std::string, double> timed_;  ///< seconds of a run, by the fingerprint of what it runs
  double pace_ = 1.0;                    ///< time that runs took, of what was predicted
};

}  // namespace

std::vector<PairCauses> causesOfPairs(Campaign& campaign, const Case& setup,
                                      const RunCommand& command, const EndpointFindings& found,
                                      double until, const UndeclaredTerms& undeclared,
                                      const std::string& field) {
  return inDimensionOf(setup, [&]<int D>() {
    return CausesOfPairs<D>(campaign, setup, command, found, until, undeclared, field).result();
  });
}

}  // namespace crossgrain::inline studies
