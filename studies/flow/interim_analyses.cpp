#include "studies/flow/interim_analyses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "cases/flow.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/flow/surrogates.hpp"

namespace crossgrain::inline studies {

namespace {

bool isOpen(const EndpointRow& row) {
  return row.verdict == Verdict::undecided || row.verdict == Verdict::borderline;
}

/// Of files a further look would see the same again.
InterimPlan planOf(const Case& setup, const Campaign& campaign) {
  if (!campaign.hasFiles()) return interimPlanOf(setup);
  int first = campaign.runsEngines() ? flowPackings(setup) : 1;
  for (std::size_t e = 0; !campaign.runsEngines() && e < campaign.engines().size(); ++e)
    first = std::max(first, campaign.runsOf(e));
  return interimPlanAt(first, 1, 1.0 - setup.averaging.confidence);
}

/// Interim analyses in sequence, see runWithInterims().
class Sequence {
 public:
  Sequence(const Case& setup, Campaign& campaign, const RunCommand& command, double budget)
      : setup_(setup), campaign_(campaign), command_(command), plan_(planOf(setup, campaign)) {
    findings_.looks.budget = budget;
    findings_.looks.agreeAlpha = plan_.agreeAlpha;
    for (std::size_t k = 0; k < plan_.packings.size(); ++k)
      findings_.looks.planned.push_back({plan_.packings[k], plan_.alpha[k]});
    for (std::size_t e = 0; e < campaign.engines().size(); ++e)
      if (campaign.refusal(e).empty()) open_.insert(e);
  }

  void useSurrogates(std::vector<SurrogateEngine> surrogates) {
    findings_.surrogates = std::move(surrogates);
  }

  EndpointFindings run() {
    firstAnalysis();
    if (hasClosedForms(setup_)) return closedForms();
    InterimFindings& looks = findings_.looks;
    while (looks.ended.empty()) {
      ++looks.taken;
      judge();
      close();
      looks.ended = reasonToStop();
      if (looks.ended.empty()) runNext();
    }
    for (const auto& [name, packings] : stopped_)
      looks.ended +=
          fmt::format("; {} went no further than {} packings, as the budget of {:g} s ended", name,
                      packings, looks.budget);
    return std::move(findings_);
  }

 private:
  /// Of one start: a further look would see the same again.
  EndpointFindings closedForms() {
    std::vector<std::string> engines;
    for (std::size_t e = 0; e < campaign_.engines().size(); ++e)
      if (const EngineEntry& entry = campaign_.engines()[e];
          campaign_.refusal(e).empty() &&
          (entry.mirrors.empty() || isNamed(command_.engines, entry)))
        engines.push_back(entry.name);
    findings_.looks = {};
    findings_.looks.ended = "the case has one start";
    findings_.rows =
        closedFormRows(setup_, campaign_.runs(), engines, pairsOf(campaign_, command_.engines, {}));
    return std::move(findings_);
  }

  /// Everyone runs the first packings, but those that mirrors may carry, which run one. Beside them
  /// runs what tells how averages respond, which is asked for where there are such.
  void firstAnalysis() {
    std::vector<Variant> whole, spotChecked, changed;
    for (const std::size_t e : open_)
      (mayUseSurrogate(e) ? spotChecked : whole).push_back({e, "", &setup_});
    std::vector<std::size_t> responding;
    if (!spotChecked.empty()) responding = respondingEngines();
    std::vector<ChangedCase> cases;
    if (!responding.empty()) {
      cases = changedCases(setup_);
      changed = changedOf(responding.front(), cases);
    }
    const int packings = plan_.packings.front();
    const std::vector<PlannedRuns> all = {
        {whole, {0, packings}}, {spotChecked, {0, 1}}, {changed, {0, packings}}};
    // The followed run of a spot check takes as long as the averaged one.
    warnIfBeyondBudget(campaign_.secondsOf(all) + campaign_.secondsOf({{spotChecked, {0, 1}}}));
    RunsById runs = campaign_.runSome(all, "running engines"), ofChanged;
    for (auto next = runs.begin(); next != runs.end();)
      if (const auto run = next++; !run->first.variant.empty()) ofChanged.insert(runs.extract(run));
    campaign_.add(std::move(runs));
    if (spotChecked.empty()) return;
    if (!cases.empty()) respond(responding, cases, std::move(ofChanged));
    judgeSpotChecks(setup_, campaign_, findings_.responses, findings_.surrogates);
    followOwnRuns(spotChecked);
    std::vector<Variant> themselves;
    for (const Variant& variant : spotChecked)
      if (!surrogateOf(findings_.surrogates, nameOf(variant.engine))) themselves.push_back(variant);
    if (!themselves.empty() && packings > 1)
      campaign_.add(campaign_.runSome({{themselves, {1, packings}}},
                                      "running engines without a mirror in their place"));
  }

  /// Only of those whose averaged run raised no alarm: the others run all packings anyway.
  void followOwnRuns(const std::vector<Variant>& spotChecked) {
    std::vector<std::size_t> engines;
    for (const Variant& variant : spotChecked)
      if (surrogateOf(findings_.surrogates, nameOf(variant.engine)))
        engines.push_back(variant.engine);
    std::vector<LateWindows> late = lateWindowsOf(campaign_, setup_, command_, engines);
    for (std::size_t k = 0; k < engines.size(); ++k)
      judgeLateWindows(
          setup_, findings_.responses, std::move(late[k]),
          *std::ranges::find(findings_.surrogates, nameOf(engines[k]), &SurrogateEngine::engine));
  }

  /// Without the first look there is no answer at all, so it is taken even so: who cannot wait is
  /// to know at once.
  void warnIfBeyondBudget(double seconds) {
    if (const double end = campaign_.elapsed() + seconds; end > findings_.looks.budget)
      campaign_.progress().say(
          fmt::format("the first analysis, at {} packings, is likely to end after {:.2g} s, by a "
                      "timing of some "
                      "steps: beyond the budget of {:g} s, which limits only further ones",
                      plan_.packings.front(), end, findings_.looks.budget));
  }

  static std::vector<Variant> changedOf(std::size_t e, const std::vector<ChangedCase>& cases) {
    std::vector<Variant> variants;
    for (const ChangedCase& one : cases) variants.push_back({e, "", &one.setup, one.name});
    return variants;
  }

  /// How averages respond, by the first of these engines that finished its runs.
  /// @param ofChanged  the very first one's runs of the changed cases
  void respond(const std::vector<std::size_t>& engines, const std::vector<ChangedCase>& cases,
               RunsById ofChanged) {
    const int packings = plan_.packings.front();
    for (const std::size_t e : engines) {
      if (finishedIn(nameOf(e)) == 0) continue;
      if (e != engines.front())
        ofChanged = campaign_.runSome({{changedOf(e, cases), {0, packings}}},
                                      fmt::format("running changed cases by {}", nameOf(e)));
      findings_.responses =
          endpointResponses(setup_, campaign_, nameOf(e), cases, ofChanged, packings);
      return;
    }
  }

  /// Runs of the next analysis: of all engines that are open and have no surrogate.
  PlannedRuns next() const {
    const std::size_t taken = findings_.looks.taken;
    PlannedRuns list{{}, {plan_.packings[taken - 1], plan_.packings[taken]}};
    for (const std::size_t e : open_)
      if (!surrogateOf(findings_.surrogates, nameOf(e))) list.variants.push_back({e, "", &setup_});
    return list;
  }

  void runNext() {
    const PlannedRuns list = next();
    const auto [from, to] = list.packings;
    // Preparing takes time, and finished runs need no packing.
    if (campaign_.missingRuns(list) == 0)
      campaign_.lookForPackings(to);
    else
      campaign_.preparePackings(to);
    campaign_.add(
        campaign_.runSome({list}, fmt::format("running engines, packings {} to {}", from, to - 1)));
  }

  void judge() {
    const auto pairs = pairsOf(campaign_, command_.engines, findings_.surrogates);
    findings_.rows = endpointRows(setup_, campaign_.runs(), pairs, plan_,
                                  plan_.packings[findings_.looks.taken - 1], findings_, stopped_);
  }

  /// Engines with nothing left to decide, or that finish nothing, run no more.
  void close() {
    std::set<std::string> wanted;
    for (const EndpointRow& row : findings_.rows)
      if (isOpen(row)) {
        if (row.a == medianName)  // which takes all of them
          for (const std::size_t e : open_) wanted.insert(nameOf(e));
        wanted.insert(row.surrogateA.empty() ? row.a : row.surrogateA);
        wanted.insert(row.surrogateB.empty() ? row.b : row.surrogateB);
      }
    std::erase_if(open_, [&](std::size_t e) {
      return !wanted.contains(nameOf(e)) || finishedIn(nameOf(e)) == 0;
    });
  }

  std::string reasonToStop() {
    const std::size_t taken = findings_.looks.taken;
    if (open_.empty()) return reasonNoneIsOpen();
    if (open_.size() < 2) return "no two engines are left that finish their runs";
    if (campaign_.hasFiles()) return "files hold no further runs";
    if (taken == plan_.packings.size())
      return fmt::format("{} packings are the most", plan_.packings.back());
    // A run that an earlier command has finished costs nothing: a smaller budget takes no verdict
    // back.
    if (campaign_.missingRuns(next()) > 0 &&
        campaign_.elapsed() + secondsOfNext() > findings_.looks.budget && !finishedGoOn())
      return fmt::format(
          "the next analysis, at {} packings, would have ended after the budget of {:g} s",
          plan_.packings[taken], findings_.looks.budget);
    return {};
  }

  /// Engines whose next runs an earlier command has finished go on without the others, so that one
  /// engine more takes no verdict of theirs back. @returns whether there are two such
  bool finishedGoOn() {
    const PlannedRuns all = next();
    std::set<std::size_t> finished;
    std::set<std::string> names;
    for (const Variant& variant : all.variants)
      if (campaign_.missingRuns({{variant}, all.packings}) == 0) {
        finished.insert(variant.engine);
        names.insert(nameOf(variant.engine));
      }
    for (const std::size_t e : open_)
      if (const SurrogateEngine* const own = surrogateOf(findings_.surrogates, nameOf(e));
          own && names.contains(own->mirror))
        finished.insert(e);
    if (finished.size() < 2) return false;
    for (const std::size_t e : open_)
      if (!finished.contains(e)) stopped_[nameOf(e)] = all.packings.from;
    open_ = finished;
    return true;
  }

  /// Decided is what was compared and came out, nothing else.
  std::string reasonNoneIsOpen() const {
    if (std::ranges::find(findings_.rows, PairKind::peer, &EndpointRow::kind) ==
        findings_.rows.end())
      return "there was nothing to compare between two engines that were named";
    return std::ranges::any_of(findings_.rows, isOpen)
               ? "no engine is left that finishes its runs"
               : "every endpoint that was compared is decided";
  }

  /// Seconds that the next analysis takes, by the runs so far.
  double secondsOfNext() const {
    const PlannedRuns list = next();
    double seconds = campaign_.secondsOfPreparing(list.packings.to);
    for (const Variant& variant : list.variants) {
      const std::string name = nameOf(variant.engine);
      double sum = 0.0;
      for (const FlowRun& run : campaign_.runs())
        if (run.engine == name && run.finished() && run.stats) sum += run.stats->wallSeconds;
      const auto missing = static_cast<double>(campaign_.missingRuns({{variant}, list.packings}));
      if (const int runs = finishedIn(name)) seconds += missing * sum / runs;
    }
    return seconds / std::max(command_.jobs, 1);
  }

  int finishedIn(const std::string& engine) const {
    return static_cast<int>(std::ranges::count_if(campaign_.runs(), [&](const FlowRun& run) {
      return run.engine == engine && run.finished();
    }));
  }

  bool mayUseSurrogate(std::size_t e) const {
    return std::ranges::find(findings_.surrogates, nameOf(e), &SurrogateEngine::engine) !=
           findings_.surrogates.end();
  }

  /// Those that run all packings by the case's own normal law.
  std::vector<std::size_t> respondingEngines() const {
    std::vector<std::size_t> engines;
    for (const std::size_t e : open_) {
      const auto& can = campaign_.capabilities(e);
      if (can && !mayUseSurrogate(e) && hasNormalLaw(*can, setup_.law)) engines.push_back(e);
    }
    return engines;
  }

  std::string nameOf(std::size_t e) const { return campaign_.engines()[e].name; }

  const Case& setup_;
  Campaign& campaign_;
  const RunCommand& command_;
  InterimPlan plan_;
  std::set<std::size_t> open_;          ///< engines that still run
  std::map<std::string, int> stopped_;  ///< after how many packings the budget ended for an engine
  EndpointFindings findings_;
};

}  // namespace

std::vector<ComparedPair> pairsOf(const Campaign& campaign, const std::vector<std::string>& names,
                                  const std::vector<SurrogateEngine>& surrogates) {
  const auto engines = campaign.engines();
  const auto named = [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(names, entry);
  };
  const auto ofFiles = [&](std::size_t a, std::size_t b) {
    return engines[a].ofFiles() || engines[b].ofFiles();
  };
  std::vector<ComparedPair> pairs;
  if (campaign.isNeutral())
    for (const EngineEntry& own : engines) {
      if (!named(own)) continue;
      ComparedPair pair{medianName, own.name};
      for (const EngineEntry& other : engines)
        if (named(other) && other.name != own.name) pair.others.push_back(other.name);
      pairs.push_back(std::move(pair));
    }
  for (std::size_t a = 0; a < engines.size(); ++a)
    for (std::size_t b = a + 1; b < engines.size(); ++b)
      if (named(engines[a]) && named(engines[b]))
        pairs.push_back({engines[a].name, engines[b].name, PairKind::peer, {}, ofFiles(a, b)});
  for (const EngineEntry& mirror : engines) {
    if (named(mirror) || surrogateBy(surrogates, mirror.name)) continue;
    const std::string reference = engines.front().name;
    if (!campaign.isNeutral() && reference != mirror.mirrors)
      pairs.push_back({reference, mirror.name, PairKind::mirrorModel});
    pairs.push_back({mirror.name, mirror.mirrors, PairKind::mirrorImplementation});
  }
  return pairs;
}

EndpointFindings runWithInterims(const Case& setup, Campaign& campaign, const RunCommand& command,
                                 const LockstepFindings& lockstep, double budget) {
  Sequence sequence(setup, campaign, command, budget);
  if (!hasClosedForms(setup))  // where every engine answers for itself
    sequence.useSurrogates(surrogateEngines(campaign, command.engines, lockstep));
  return sequence.run();
}

}  // namespace crossgrain::inline studies
