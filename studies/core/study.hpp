#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "adapters/effects.hpp"
#include "adapters/engine_entry.hpp"
#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"
#include "cases/loader.hpp"
#include "results/head.hpp"
#include "results/scene_picture.hpp"
#include "studies/core/run_store.hpp"

namespace crossgrain::inline studies {

/// Exit statuses, as design and README promise them.
enum ExitStatus {
  exitPassed = 0,
  exitFailed = 1,
  exitBadInput = 2,
  exitEngineFailed = 3,  ///< or the machine: no room on the disk
  exitInterrupted = 130
};

/// The options that studies share; a study's own are its Options.
struct CommandLine {
  RunCommand run;
  /// Case files, or result folders; of files that are averaged the case, then the files.
  std::vector<std::filesystem::path> inputs;
  std::vector<std::string> overrides;  ///< --set, then what other options stand for
  std::optional<std::int64_t> seed;    ///< --seed: preparation.seed
  std::optional<std::string> only;     ///< -k: part of the cases
  bool quick = false;
  bool verbose = false;  ///< -v: all that is known, not a summary
  bool json = false;
};

/// Choice of the shared options that a study takes.
struct SharedOptions {
  enum class Input { oneCase, anyCases, none, files } input = Input::oneCase;
  const char* inputIs = "case file";
  bool selection = false;  ///< -k
  bool engines = true;     ///< --engines and what goes with running them
  bool jobs = true;        ///< --jobs; without: one engine at a time
  bool packings = false;   ///< --seed, --quick
  bool shards = true;      ///< --shard; not of times, which are of one machine
};

/// Option of one study alone.
struct StudyOption {
  std::string name, what;
  std::variant<bool*, std::optional<std::string>*, std::optional<double>*> value;
  std::string type = "TEXT";  ///< how the value is called
};

/// Two options of which only one may be given.
using Exclusion = std::pair<std::string, std::string>;

/// Outcome of results, for scripts.
struct Outcome {
  ExitStatus status = exitPassed;
  std::vector<std::string> failures = {};         ///< runs that failed, engines that refused
  std::optional<std::string> nothingJudged = {};  ///< why; absent: something was
  std::vector<std::string> fails = {};            ///< reasons for status 1, a clause each
};

/// The cases of a study and where it keeps what is finished.
struct StudyWork {
  const CommandLine& line;
  const std::vector<Case>& cases;
  RunStore& store;

  const Case& setup() const { return cases.front(); }
};

/// Input::files: all but the case.
inline std::vector<std::filesystem::path> filesOf(const CommandLine& line) {
  return {line.inputs.begin() + 1, line.inputs.end()};
}

/// Keys of finished runs in a study's output folder.
enum class Keeps { nothing, oneCase, eachCase };

/// A study as data: from the options of its command to its outcome. All else is the same for all
/// studies (cli/studies.cpp): cases are loaded once; finished runs in the output folder are loaded,
/// the others are run; results are written, reported and printed; the exit status is the outcome's.
///
///   options ── cases ── plan (--dry-run) | run: tasks (executor.hpp) → results ── outcome
template <typename Options, typename Results>
struct Study {
  const char* name;  ///< of its command
  SharedOptions takes;
  Keeps keeps;
  std::vector<StudyOption> (*options)(Options&, CommandLine&);
  /// Checks the options and loads what is to be run. @throws BadInput
  std::vector<Case> (*cases)(const CommandLine&, Options&);
  /// The work of run(), for people; nothing is computed. Null: the study has no --dry-run.
  std::string (*plan)(const StudyWork&, const Options&);
  Results (*run)(const StudyWork&, const Options&);
  Outcome (*outcome)(const Results&, const CommandLine&, const Options&);
  std::vector<Exclusion> exclusions = {};
};

/// Outcome of results with nothing judged: no success, unless the request left nothing to judge.
Outcome notJudged(std::string why, bool byRequest = false);

/// Why engines that the user named did not run, one line each.
std::vector<std::string> refusals(const std::vector<EngineRow>& engines,
                                  const std::vector<std::string>& named);

/// A row for an engine as it came with the program. @param version  empty: it did not answer
EngineRow engineRow(const EngineEntry& entry, const std::string& version);

/// Does the work of a command that loads finished runs from its folder. If the user interrupts it
/// or the disk is full, the exception says how to continue.
/// @returns what the work returns
/// @throws Interrupted, OutputError; what else the work throws
int resumably(const RunCommand& command, const std::function<int()>& work);

/// An option's value that must be whole. @throws BadInput
double wholeNumberOf(const std::string& option, double value, double least, double most);

/// The value of --budget, "90s", "10m", "1h" [s]. @throws BadInput
double secondsOf(const std::string& budget);

/// The value of --want: "1%" or "1e-3" as a share, 0.01 or 0.001; "0.5" in margins as it is.
/// @throws BadInput
double accuracyOf(const std::string& target, bool inMargins);

/// Now, as ISO 8601 in UTC.
std::string timeStamp();

/// Head of all results.
ResultsHead headOf(std::string_view kind, const Case& setup, const std::string& command);

/// Data of the report's pictures from one snapshot: disks with the place they started from (scene),
/// planes, and contacts with their normal force. @param rotation  of the wheel so far
ScenePicture scenePicture(const Scene& scene, const Snapshot& now, double rotation);

/// The same in space, seen along y from the middle of the box, or of all spheres: spheres whose
/// centres lie behind that cut. Of convex bodies, and spheres beside them, what the cut is. It has
/// no contacts.
ScenePicture scenePicture(const SpaceScene& scene, const SpaceSnapshot& now, double rotation);

/// What a command does with the flow that it is given.
struct FlowUse {
  const char* command;             ///< its name in messages
  Starts starts = Starts::made;    ///< notMade: it has files; so has one whose engines are files
  bool notesKeys = true;           ///< else the case is taken as it is, for what comes after
  bool beginsFromGrain = false;    ///< from states of the in-house engine's
  bool sharesConventions = false;  ///< of the engines that run
};

/// The one flow that a command was given, without variants; shortened by --quick.
/// @throws BadInput
Case onlyFlow(const CommandLine& line, const FlowUse& use);

/// Changes by --quick of a flow: nothing becomes longer than the case has it.
/// @param rotations  averaged
std::vector<std::string> quickOverrides(const Case& setup, double rotations = 0.1);

/// Keys and sections that the case says and that mean nothing to a command, settings of engines
/// that it does not know among them; else none for `check`, which reads all of it.
std::vector<std::string> keysWithoutUse(const Case& setup, std::string_view command);

/// One line with them, if there are any: nothing that a user said is ignored in silence. On stdout
/// a comment, so that what is printed to be pasted loads. It waits for printNotes().
void reportKeysWithoutUse(const Case& setup, std::string_view command, std::FILE* to);
/// The same of many cases, once for each file.
void reportKeysWithoutUse(const std::vector<Case>& cases, std::string_view command, std::FILE* to);

/// Prints those lines, once it is known that the command can begin: a refusal stands alone.
void printNotes();

/// Warns of what loads but is hardly meant, one line each on standard error.
void printWarnings(const Case& setup);

}  // namespace crossgrain::inline studies
