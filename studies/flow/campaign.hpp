#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/flow.hpp"
#include "results/compare.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/run_store.hpp"
#include "studies/flow/file_runs.hpp"

namespace crossgrain::inline studies {

/// An engine of a campaign and what is known of it.
struct CampaignEngine {
  EngineEntry entry;
  std::string version = {};              ///< empty: it did not answer
  std::string refusal = {};              ///< why it does not take part, empty if it does
  std::vector<std::string> lacks = {};   ///< entries that may_differ needs, if that is all
  std::optional<Capabilities> can = {};  ///< from timeEngines(); absent where it failed
  std::optional<EffectiveParameters> effective = {};  ///< likewise
  double predicted = 1.0;                             ///< seconds of one run
  /// Of its first run, where that is a file, the disks' [m].
  std::vector<double> radii = {};
  /// That run, opened to be asked, until it is averaged: its beginning is read once.
  mutable std::optional<OpenRun> first = {};
  std::vector<std::string> copies = {};  ///< runs of files that were left out, a sentence each
};

/// One engine on every packing, with the case as it is or with something switched off.
struct Variant {
  std::size_t engine;   ///< index into Campaign::engines()
  std::string without;  ///< effect switched off, empty: none; "without" of its runs
  const Case* setup;
  std::string changed = {};  ///< "kn+10%": a constant that `setup` has otherwise than the case
};

/// Packings of a campaign by index, from one to before another.
struct PackingRange {
  int from = 0, to = 0;
};

/// Variants and the packings that each is to run.
struct PlannedRuns {
  std::vector<Variant> variants;
  PackingRange packings;
};

/// Runs by engine, what was switched off or changed, and packing.
using RunsById = std::map<RunId, FlowRun>;

/// Engines on the packings of one Couette case, side by side where `jobs` allows. Every finished
/// run is kept in out/runs at once and loaded by the next campaign there; a failed one ends by
/// itself and is reported.
///
///   askEngines ── preparePackings ── timeEngines ── run ── study
class Campaign {
 public:
  /// @param store  of the case, opened with soleCase()
  /// @throws BadInput for a packing file without a time step
  Campaign(const Case& setup, const RunCommand& command, std::vector<EngineEntry> engines,
           RunStore& store);

  /// Asks every engine, before anything is computed, whether it can run the case. One that cannot
  /// is refused for itself; the first that can is the first of engines() and so the reference.
  /// @throws AllRefused where fewer than `fewest` can of those that are no mirrors or are named,
  /// and any is refused: why, and what would let all of them run
  void askEngines(std::size_t fewest = 1);
  /// With the first of them, the campaign begins: its folder is its own. @throws BadInput
  void preparePackings() { preparePackings(packingCount()); }
  /// As many as are missing to that number of them, or were only looked for.
  void preparePackings(int count);
  int packingCount() const { return flowPackings(setup_); }
  /// Times some steps of every engine on the first packing, so that the longest runs start first.
  void timeEngines();
  /// The in-house engine, asked and timed; where it takes no part it is added for runs that
  /// belong to no pair, and later results name it. @throws UnsupportedScene, EngineFailure,
  /// BadInput
  std::size_t inHouse();
  /// Seconds that an engine's run of a case takes, by a timing of some steps on the first packing,
  /// which it prepares. @throws UnsupportedScene, EngineFailure, BadInput
  double predictedSeconds(std::size_t engine, const Case& setup);
  /// Every engine with the case as it is.
  std::vector<Variant> wholeCase() const;
  /// On all packings that are prepared.
  void run(const std::vector<Variant>& variants);
  /// On some of them, all side by side; keeps none in runs().
  RunsById runSome(const std::vector<PlannedRuns>& lists, const std::string& stage);
  /// Runs that are to be in results, whoever did them: by engine as they take part, then by
  /// packing.
  void add(RunsById runs);
  const std::vector<FlowRun>& runs() const { return runs_; }
  double elapsed() const;  ///< since the campaign was made [s]
  /// Seconds of one core that preparing up to so many packings still takes, by those so far.
  double secondsOfPreparing(int count) const;
  /// Seconds until those of them that are not finished would be, by the brief timing of each
  /// engine.
  double secondsOf(const std::vector<PlannedRuns>& lists) const;
  /// Runs of the list that the store does not have, whether or not their packings are prepared.
  std::size_t missingRuns(const PlannedRuns& list) const;

  /// In place of preparePackings(), where no run of the further packings is missing: which they
  /// are.
  void lookForPackings(int count);
  /// Of a dry run, in place of preparePackings() and timeEngines(). @throws BadInput likewise
  void lookForPackings();
  /// The work of `run`, engine by engine, those that refuse too.
  std::vector<PlannedWork> plan(const std::vector<Variant>& variants) const;
  /// Whether runs of files take part, which are what they are: no more of them can be asked for.
  bool hasFiles() const;
  /// Whether anything is to be run from the case's packings.
  bool runsEngines() const;
  /// Runs of the engine: as many as its files hold, or packings.
  int runsOf(std::size_t engine) const;

  /// No engine is the reference: each is compared with the median of the others.
  void beNeutral() { neutral_ = true; }
  bool isNeutral() const { return neutral_; }

  /// "compare of quick: 4 packings, 3 of them prepared already"
  std::string planHead() const;

  /// Results as far as they do not depend on what the runs are for.
  FlowStudy study(std::string_view kind) const;

  auto engines() const { return engines_ | std::views::transform(&CampaignEngine::entry); }
  /// As of CampaignEngine.
  const std::string& refusal(std::size_t engine) const { return engines_[engine].refusal; }
  const std::string& version(std::size_t engine) const { return engines_[engine].version; }
  const std::optional<Capabilities>& capabilities(std::size_t engine) const {
    return engines_[engine].can;
  }
  const std::optional<EffectiveParameters>& effective(std::size_t engine) const {
    return engines_[engine].effective;
  }
  const std::vector<Packing>& packings() const { return packings_; }
  double dt() const { return dt_; }  ///< the case's [s]
  RunStore& store() const { return store_; }
  Progress& progress() { return progress_; }

  /// Keys of a result of this engine on this packing besides the case.
  /// @param part  what is switched off, or which part of the campaign the result is
  CaseKeys keyOf(std::size_t engine, int packing, const std::string& part) const;

 private:
  /// Asks engines that have not refused, side by side, each for itself; refusals and failures are
  /// reported in the order of engines. @throws AllRefused as askEngines(); BadInput, the
  /// first engine's
  void forEachEngine(const std::function<void(CampaignEngine&)>& work, std::size_t fewest = 1);
  /// @throws AllRefused likewise
  void requireAble(std::size_t fewest) const;
  void timeEngine(CampaignEngine& own, const Case& setup);
  std::vector<CachedTask<FlowRun>> tasksOf(const PlannedRuns& list) const;
  FlowRun runOfFiles(const CampaignEngine& own, int run,
                     const std::function<void(double)>& progress) const;
  CachedTask<FlowRun>::Outcome runOne(const Variant& variant, int packing,
                                      const std::function<void(double)>& progress) const;
  std::vector<EngineRow> engineRows() const;

  const Case& setup_;
  const RunCommand& command_;
  std::vector<CampaignEngine> engines_;
  double dt_;
  bool neutral_ = false;
  RunStore& store_;
  Progress progress_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::vector<Packing> packings_;
  std::vector<double> preparedIn_;  ///< of those that the cache did not have [s]
  std::vector<FlowRun> runs_;       ///< variant by variant, packing by packing
};

}  // namespace crossgrain::inline studies
