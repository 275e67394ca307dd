#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/case_keys.hpp"
#include "results/schema.hpp"
#include "support/folder_lock.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

/// One of several processes that share an output folder, on one machine or on many: what another
/// has begun is left to it, and its result taken. The first writes the results.
struct Shard {
  int number = 1, of = 1;
  bool writes() const { return number == 1; }
};

/// Command line of every command that runs engines.
struct RunCommand {
  std::vector<std::string> engines;  ///< names, "all" allowed
  std::filesystem::path out;
  int jobs = 1;         ///< engines side by side
  bool fresh = false;   ///< set aside what an earlier command left in `out`, and begin anew
  bool dryRun = false;  ///< say what would run; write and hold nothing
  bool quiet = false;
  std::optional<Shard> shard;
  std::string commandLine;  ///< for the report
};

extern const char* const programVersion;

/// The source that this was built from, as far as git could tell when it was configured: runs of
/// another build are not loaded.
extern const char* const programBuild;

/// "0.3.0 (7902f0e)"
std::string thisProgram();

/// Whether a folder has runs that are finished or under way, which the same command goes on from.
bool holdsWork(const std::filesystem::path& out);

/// The output folder of one command, with a file for each finished run, so that nothing computed is
/// ever lost. A folder belongs to one command, one build of the program and one version of each
/// case; what is finished there is loaded, and nothing else may be put on top of it.
///
///   RunStore ── begin ── find, keep …      locked against other processes for as long as it lives
class RunStore {
 public:
  /// Opens the folder, which is made if need be; what is there stays. Of a dry run nothing is made
  /// and nothing locked.
  /// @param name   the command's: "compare"
  /// @param cases  what it is about to run, by name; none for commands that keep no runs
  /// @throws OutputError if it cannot be written to
  /// @throws BadInput, saying what differs, if it holds another command's results, or finished runs
  ///         of another build or of cases that have changed; if another process holds it; if it
  ///         holds files of others. `command.fresh` lifts the first two.
  RunStore(const RunCommand& command, std::string name, std::map<std::string, CaseKeys> cases);
  /// Scratch files go but for those of failed(). A folder that was made for a command that could
  /// not begin goes with it.
  ~RunStore();

  /// Called once it is known that the command can begin; by each of its parts. Sets aside what an
  /// earlier one left, if that is wanted, and says where on standard error.
  void begin();

  /// The finished run of that name.
  /// @param key  everything it depends on, what all runs of the folder have in common left out
  /// @throws BadInput saying what differs if it was made with another key
  std::optional<nlohmann::json> find(const std::string& name, const CaseKeys& key) const;
  /// As the struct that was kept. @throws BadInput also where the file holds another one
  template <typename Result>
  std::optional<Result> findAs(const std::string& name, const CaseKeys& key) const {
    const auto kept = find(name, key);
    if (!kept) return std::nullopt;
    return understood(file(name), [&] { return std::optional(readAs<Result>(*kept)); });
  }
  /// @param finished  else it is kept for the other shards of this command alone
  void keep(const std::string& name, const CaseKeys& key, const nlohmann::json& run,
            bool finished = true) const;

  bool isShared() const { return shard_.has_value(); }
  /// Holds the run of that name against the other shards; absent while one of them has it.
  std::optional<FolderLock> claim(const std::string& name) const;

  const std::filesystem::path& folder() const { return out_; }
  /// The run of that name failed: what its engine wrote stays until the next command begins.
  void failed(const std::string& name) const;
  /// Of a worker; gone with the store, but for those of failed().
  std::filesystem::path scratch(const std::string& name) const;
  std::filesystem::path snapshots(const std::string& name) const;
  /// Files of a run that is under way; gone once it is finished.
  std::filesystem::path unfinished(const std::string& name) const;

 private:
  void open();
  void checkBefore() const;
  bool holdsRuns() const;
  bool holdsResults() const;
  void setAside();
  std::filesystem::path file(const std::string& name) const;
  std::filesystem::path claims() const { return out_ / "claims"; }
  std::filesystem::path ownScratch() const;

  std::filesystem::path out_;
  std::string name_;
  std::map<std::string, CaseKeys> cases_;
  bool dry_, fresh_, made_ = false, begun_ = false;
  std::optional<Shard> shard_;
  mutable std::mutex mutex_;
  mutable std::set<std::string> failed_;
  std::optional<FolderLock> lock_;
  std::optional<ScratchFolder> elsewhere_;  ///< scratch of a dry run
};

/// The program, thisProgram(), that an output folder's runs are of; empty where it does not say.
std::string programOf(const std::filesystem::path& folder);

/// The keys of a case that its runs depend on: not how many there are to be, nor how they are
/// judged, nor which engines may take part. Settings of engines are left to runKey().
/// @param resolvedToml  of the case
CaseKeys resultAffectingKeys(const std::string& resolvedToml);

/// The case of a command that runs one: another one there is that case changed.
std::map<std::string, CaseKeys> soleCase(const Case& setup);

/// "quick", or "quick without-friction" of a variant.
std::string fullName(const Case& setup);

/// Cases of a command that runs many: by fullName().
std::map<std::string, CaseKeys> keysOfEach(const std::vector<Case>& cases);

/// Further keys of a run: the engine, its version (empty: it did not answer) and settings, and
/// whatever more the caller adds.
CaseKeys runKey(const Case& setup, const std::string& engine, const std::string& version);

}  // namespace crossgrain::inline studies
