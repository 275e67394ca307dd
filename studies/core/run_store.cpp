#include "studies/core/run_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/registry.hpp"
#include "results/schema.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* marker = ".crossgrain";
constexpr const char* earlier = "earlier";
constexpr const char* versionKey = "engine version";
constexpr const char* wayOut = "take another folder, or --fresh, which sets aside what is there";

/// Content of a folder's marker.
struct Marker {
  std::string command, program;
  std::map<std::string, CaseKeys> cases;
};

void fields(auto& io, Marker& said) {
  FIELDS(io, said.command, said.program, said.cases);
}

/// @throws BadInput where it says what none does
Marker markerIn(const fs::path& folder) {
  const fs::path file = folder / marker;
  const auto document = readJsonFile(file);
  return understood(file, [&] { return document ? readAs<Marker>(*document) : Marker(); });
}

/// A file of a finished run.
struct KeptRun {
  CaseKeys key;
  std::optional<json> run;
};

void fields(auto& io, KeptRun& kept) {
  FIELDS(io, kept.key, kept.run);
}

/// Files that are not of any crossgrain. The marker is looked for last: whoever makes the folder at
/// this moment makes it first.
bool holdsStrangers(const fs::path& folder) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    // Marker, lock, and either while it is being written.
    const bool ours = entry.path().filename().string().starts_with(marker);
    if (!ours) return !fs::exists(folder / marker, none);
  }
  return false;
}

bool holdsAny(const fs::path& folder) {
  std::error_code none;
  return fs::directory_iterator(folder, none) != fs::directory_iterator();
}

}  // namespace

bool holdsWork(const fs::path& out) {
  return holdsAny(out / "runs") || holdsAny(out / "unfinished");
}

RunStore::RunStore(const RunCommand& command, std::string name,
                   std::map<std::string, CaseKeys> cases)
    : out_(command.out),
      name_(std::move(name)),
      cases_(std::move(cases)),
      dry_(command.dryRun),
      fresh_(command.fresh),
      shard_(command.dryRun ? std::nullopt : command.shard) {
  if (holdsStrangers(out_))
    throw BadInput(
        fmt::format("--out {}: the folder is not empty and not of an earlier run; take a "
                    "new one",
                    out_.string()));
  if (dry_)
    elsewhere_.emplace();
  else
    open();
  if (!fresh_) checkBefore();
  std::error_code ignored;
  if (!dry_) fs::remove_all(ownScratch(), ignored);
}

RunStore::~RunStore() {
  std::error_code ignored;
  if (begun_) {
    for (const auto& entry : fs::directory_iterator(ownScratch(), ignored))
      if (!failed_.contains(entry.path().filename().string()))
        fs::remove_all(entry.path(), ignored);
    for (const fs::path& folder : {ownScratch(), out_ / "scratch", claims()})
      fs::remove(folder, ignored);  // if it is empty
  }
  if (begun_ || !made_ || shard_) return;
  for (const char* own : {"scratch", marker}) fs::remove_all(out_ / own, ignored);
  lock_.reset();
  fs::remove(out_, ignored);
}

void RunStore::open() {
  std::error_code ignored;
  made_ = !fs::exists(out_, ignored);
  makeDirectory(out_);
  if (!shard_) {
    lock_.emplace(out_, name_);
  } else if (auto first = FolderLock::attempt(out_ / FolderLock::name, name_)) {
    // Claims of an earlier command's shards are of no use.
    for (const fs::path& old : {claims(), out_ / "scratch"}) fs::remove_all(old, ignored);
    first->share();
    lock_.emplace(*std::move(first));
  } else {
    lock_.emplace(FolderLock::shared(out_, name_));
  }
  if (!fs::exists(out_ / marker, ignored)) writeFile(out_ / marker, "{}\n");
}

void RunStore::checkBefore() const {
  const auto refuse = [&](const std::string& why) {
    throw BadInput(fmt::format("--out {}: {}; {}", out_.string(), why, wayOut));
  };
  const Marker before = markerIn(out_);
  const std::string& owner = before.command;
  if ((holdsRuns() || holdsResults()) && owner != name_)
    refuse(owner.empty()
               ? "its results are of an earlier version of crossgrain"
               : fmt::format("its results are of 'crossgrain {}', not of '{}'", owner, name_));
  if (!holdsRuns()) return;
  if (before.program != thisProgram())
    refuse(fmt::format("its runs are of another build of crossgrain: {} → {}", before.program,
                       thisProgram()));
  for (const auto& [name, keys] : cases_) {
    const auto known = before.cases.find(name);
    if (known == before.cases.end()) continue;
    const auto changed = changes(known->second, keys);
    if (!changed.empty())
      refuse(fmt::format("its runs are of {} that has changed: {}",
                         name.empty() ? "a case" : "a case, " + name + ",",
                         describeChanges(changed)));
  }
}

bool RunStore::holdsRuns() const {
  return holdsWork(out_);
}

bool RunStore::holdsResults() const {
  std::error_code ignored;
  return fs::exists(out_ / "results.json", ignored);
}

void RunStore::begin() {
  if (dry_ || begun_) return;
  begun_ = true;
  if (fresh_ && (holdsRuns() || holdsResults())) setAside();
  Marker now{name_, thisProgram(), cases_};
  // Cases of earlier commands stay, for as long as something of them is there.
  if (holdsRuns()) now.cases.merge(markerIn(out_).cases);
  json document = jsonOf(now);
  document["about"] = "Made by crossgrain: see docs/files.md.";
  writeFile(out_ / marker, toText(document));
}

/// Entry by entry into a folder of its own; both folders say whose they are, so that whatever
/// happens in between, each can be gone on with. The folder itself stays, as it may be a mount
/// point.
void RunStore::setAside() {
  std::error_code ignored;
  int number = 1;
  while (fs::exists(out_ / earlier / std::to_string(number), ignored)) ++number;
  const fs::path aside = out_ / earlier / std::to_string(number);
  makeDirectory(aside);
  writeFile(aside / marker, readFile(out_ / marker).value_or("{}"));
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(out_)) entries.push_back(entry.path().filename());
  for (const char* stays : {marker, FolderLock::name, earlier, "scratch", "claims"})
    std::erase(entries, stays);
  for (const fs::path& entry : entries) {
    std::error_code error;
    fs::rename(out_ / entry, aside / entry, error);
    if (error) throw OutputError(aside / entry, error.value());
  }
  fmt::print(stderr, "what was there is now in {}\n", aside.string());
}

std::optional<json> RunStore::find(const std::string& name, const CaseKeys& key) const {
  if (dry_ && fresh_) return std::nullopt;
  auto content = readFile(file(name));
  if (!content && shard_) content = readFile(claims() / (name + ".failed"));
  const auto text = content ? unpacked(*content) : std::nullopt;
  if (!text) return std::nullopt;  // half a file, too: the run is done again
  KeptRun stored;
  try {
    stored = understood(file(name), [&] { return readAs<KeptRun>(parseJson(*text)); });
  } catch (const NotJson&) {
    // As of half a file.
  }
  if (!stored.run) return std::nullopt;
  CaseKeys before = stored.key, now = key;
  // An engine that does not answer, or did not, is not known to be another.
  if (before[versionKey].empty() || now[versionKey].empty())
    for (CaseKeys* side : {&before, &now}) side->erase(versionKey);
  const auto changed = changes(before, now);
  if (!changed.empty())
    throw BadInput(fmt::format("--out {}: its run {} depends on what has changed: {}; {}",
                               out_.string(), name, describeChanges(changed), wayOut));
  return std::move(stored.run);
}

std::optional<FolderLock> RunStore::claim(const std::string& name) const {
  makeDirectory(claims());
  return FolderLock::attempt(claims() / name, name_);
}

void RunStore::keep(const std::string& name, const CaseKeys& key, const json& run,
                    bool finished) const {
  if (!finished && !shard_) return;
  makeDirectory(out_ / "runs");
  writeFile(finished ? file(name) : claims() / (name + ".failed"),
            packed(toText({{"key", key}, {"run", run}})));
  if (!finished) return;
  std::error_code ignored;
  fs::remove_all(unfinished(name), ignored);
}

void RunStore::failed(const std::string& name) const {
  const std::scoped_lock lock(mutex_);
  failed_.insert(name);
}

fs::path RunStore::ownScratch() const {
  const fs::path scratch = out_ / "scratch";
  return shard_ ? scratch / fmt::format("shard-{}", shard_->number) : scratch;
}

fs::path RunStore::scratch(const std::string& name) const {
  return (elsewhere_ ? elsewhere_->path : ownScratch()) / name;
}

fs::path RunStore::snapshots(const std::string& name) const {
  return out_ / "snapshots" / (name + ".h5");
}

fs::path RunStore::unfinished(const std::string& name) const {
  return out_ / "unfinished" / name;
}

fs::path RunStore::file(const std::string& name) const {
  return out_ / "runs" / (name + ".json.gz");
}

std::string programOf(const fs::path& folder) {
  return markerIn(folder).program;
}

CaseKeys resultAffectingKeys(const std::string& resolvedToml) {
  // Which runs there are: more or fewer of them leave the others as they are. What a worker may
  // take, and what an engine may differ in, decides whether it runs, not what comes out.
  static const std::vector<std::string> which = {"preparation.packings",
                                                 "run.mirrors",
                                                 "run.may_differ",
                                                 "run.timeout",
                                                 "cost.kinds",
                                                 "cost.knobs",
                                                 "cost.settings",
                                                 "cost.collision_steps",
                                                 "cost.trajectory_steps",
                                                 "cost.average_steps",
                                                 "cost.rigid_steps",
                                                 "cost.iterations",
                                                 "cost.tangential",
                                                 "cost.disks",
                                                 "cost.threads",
                                                 "looks"};
  // How they are judged, all together, when all are there.
  static const std::vector<std::string> judged = {"averaging.margins", "averaging.endpoints",
                                                  "averaging.confidence"};
  CaseKeys keys = caseKeys(resolvedToml);
  std::erase_if(keys, [](const auto& entry) {
    const auto holds = [&](const std::string& section) { return isIn(section, entry.first); };
    return std::ranges::any_of(which, holds) || std::ranges::any_of(judged, holds) ||
           holds("engines");
  });
  return keys;
}

std::map<std::string, CaseKeys> soleCase(const Case& setup) {
  return {{"", resultAffectingKeys(setup.resolvedToml)}};
}

std::map<std::string, CaseKeys> keysOfEach(const std::vector<Case>& cases) {
  std::map<std::string, CaseKeys> keys;
  for (const Case& setup : cases) keys[fullName(setup)] = resultAffectingKeys(setup.resolvedToml);
  return keys;
}

std::string fullName(const Case& setup) {
  return setup.variant.empty() ? setup.name : setup.name + " " + setup.variant;
}

CaseKeys runKey(const Case& setup, const std::string& engine, const std::string& version) {
  CaseKeys key = {{"engine", engine}, {versionKey, version}};
  // A mirror takes its peer's step.
  const EngineEntry* const entry = findEngine(engine);
  const std::string peer = entry && !entry->mirrors.empty() ? entry->mirrors : engine;
  for (const auto& [name, value] : caseKeys(setup.resolvedToml))
    if (isIn("engines." + engine, name) || isIn("engines." + peer, name)) key[name] = value;
  return key;
}

}  // namespace crossgrain::inline studies
